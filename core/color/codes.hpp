// SPDX-License-Identifier: MIT
// Every code that core/color reports, one line each. docs/errors.md prints this table; tests check
// that each code can be provoked. Codes are never reused for another meaning.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace mote {

inline constexpr std::array<std::pair<std::string_view, std::string_view>, 9> color_codes{{
    {"C001", "the color config cannot be read"},
    {"C002", "the color config is not understood by OpenColorIO"},
    {"C003", "the color config has no such display"},
    {"C004", "the display has no such view transform"},
    {"C005", "the color config has no such color space"},
    {"C006", "the color config has neither a Linear Rec.709 space nor a scene_linear role"},
    {"C007", "OpenColorIO cannot build the transform"},
    {"C008", "a color is neither a hexadecimal number nor a known name"},
    {"C009", "a color component is not a finite number, or is outside its range"},
}};

} // namespace mote
