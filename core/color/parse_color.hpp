// SPDX-License-Identifier: MIT
// Colors as people write them: "#rgb", "#rrggbb", "#rrggbbaa", one of the 16 basic CSS names (plus
// gray/grey, orange, cyan, magenta, transparent), or three or four numbers. Values stay encoded as
// they were written; ColorConfig::to_working() brings them into the working space, because only the
// caller knows whether a `color_space` stands beside them.
#pragma once

#include "core/base/diagnostic.hpp"

#include <array>
#include <span>
#include <string_view>

namespace mote {

struct ParsedColor {
  std::array<double, 3> rgb{}; // as written; text gives n/255 of 0..1
  double alpha{1.0};           // 0..1, straight
  bool has_alpha{};            // written out by the user
  bool operator==(const ParsedColor&) const = default;
};

// Throws Failure(BadInput) C008 that shows the forms there are.
ParsedColor parse_color(std::string_view text, const SourceLoc& loc = {});
// [r, g, b] or [r, g, b, a]: finite, r g b >= 0 (lights may exceed 1), a in 0..1. C009.
ParsedColor parse_color(std::span<const double> numbers, const SourceLoc& loc = {});

} // namespace mote
