// SPDX-License-Identifier: MIT
// Codes of the messages of core/reference.
#pragma once

#include <string_view>

namespace mote::reference_codes {

inline constexpr std::string_view unknown_type = "R001"; // a particle type without a double intersector
inline constexpr std::string_view not_affine = "R002";   // an instance matrix that cannot be inverted
inline constexpr std::string_view too_many_ids = "R003"; // ids asked for, more than 2^32 - 2 particles

} // namespace mote::reference_codes
