// SPDX-License-Identifier: MIT
// Codes of the messages of core/compare.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace mote::compare_codes {

inline constexpr std::string_view unknown_limit = "K001";  // a limit of a name that no measure has
inline constexpr std::string_view bad_limit = "K002";      // not "name=number", or a negative number
inline constexpr std::string_view twice = "K003";          // the same limit given twice
inline constexpr std::string_view sizes_differ = "K004";   // pictures of two sizes
inline constexpr std::string_view nothing_common = "K005"; // no AOV or color that both have
inline constexpr std::string_view not_measured = "K006";   // a limit on what the two do not both have
inline constexpr std::string_view wrong_length = "K007";   // an array that does not fit the picture's size
inline constexpr std::string_view cameras_differ = "K008"; // pictures that say they are of two cameras

inline constexpr std::array<std::pair<std::string_view, std::string_view>, 8> table{{
    {unknown_limit, "error: a limit of a name that no measure has"},
    {bad_limit, "error: not name=number, or a negative number"},
    {twice, "error: the same limit given twice"},
    {sizes_differ, "error: pictures of two sizes"},
    {nothing_common, "error: no AOV or color that both have"},
    {not_measured, "error: a limit on what the two do not both have"},
    {wrong_length, "error: an array that does not fit the picture's size"},
    {cameras_differ, "error: pictures that say they are of two cameras"},
}};

} // namespace mote::compare_codes
