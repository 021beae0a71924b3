// SPDX-License-Identifier: MIT
// The letters of legends, as outlines that are compiled in: no font file is looked for, and text of any size is
// sharp. ASCII, and what units need: Å ° µ · ² ³ ¹ × ± − and raised digits; everything else shows as '?'.
// License of the outlines: LICENSE.font.
#pragma once

#include "core/overlay/canvas.hpp"

#include <array>
#include <cstdint>
#include <string_view>

namespace mote::overlay {

struct Glyph {
  std::uint32_t code{}; // Unicode
  std::int16_t advance{};
  std::uint16_t first{}, count{}; // of its numbers in outline_numbers
};
extern const std::array<Glyph, 113> glyphs;
// Contours one behind the other: number of points, then 2 x + (1 if on the curve), y for each; quadratic splines.
extern const std::array<std::int16_t, 4752> outline_numbers;
inline constexpr double units_per_em = 2048.0, cap_height = 1493.0 / units_per_em; // height of 'H' for size 1

// In pixels for letters of `size` pixels per em.
[[nodiscard]] double text_width(std::string_view text, double size);
// Outlines of UTF-8 text whose baseline begins at (x, y), y down.
[[nodiscard]] Path text_path(std::string_view text, double size, double x, double y);

} // namespace mote::overlay
