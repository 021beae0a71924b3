// SPDX-License-Identifier: MIT
// The rows of a frame in another order or fewer of them: columns, bonds. What series are put in order with,
// and what selections are made of. Values only.
#pragma once

#include "core/data/dataset.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace mote::data {

// Row i of the result is row rows[i] of the frame; no row twice. Bonds to rows that are left out go.
void take_rows(Frame& frame, std::span<const std::uint32_t> rows);

// The ids of the rows; empty when there are none or one of them is not whole.
std::vector<std::int64_t> ids_of(const Frame& frame);

} // namespace mote::data
