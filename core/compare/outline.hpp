// SPDX-License-Identifier: MIT
// How far outlines lie apart, from what each pixel shows. An element is a pair of neighboring pixels that show different
// things; curves where two particles meet count like outlines. Private to core/compare.
#pragma once

#include "core/compare/compare.hpp"

#include <cstdint>
#include <span>

namespace mote::compare {

// Both spans hold width * height values, row 0 on top.
OutlineDifference compare_outlines(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, std::uint32_t width, std::uint32_t height);

} // namespace mote::compare
