// SPDX-License-Identifier: MIT
// Codes of the messages of core/reference.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace mote::reference_codes {

inline constexpr std::string_view unknown_type = "R001"; // a particle type without a double intersector
inline constexpr std::string_view not_affine = "R002";   // an instance matrix that cannot be inverted
inline constexpr std::string_view too_many_ids = "R003"; // ids asked for, more than 2^32 - 2 particles

inline constexpr std::array<std::pair<std::string_view, std::string_view>, 3> table{{
    {unknown_type, "error: a particle type without a double intersector"},
    {not_affine, "error: an instance matrix that cannot be inverted"},
    {too_many_ids, "error: ids asked for, more than 2^32 - 2 particles"},
}};

} // namespace mote::reference_codes
