// SPDX-License-Identifier: MIT
// A made-up picture with every AOV: a square of two particles before nothing, for the tests of
// core/compare. 20 x 10 pixels; ids 7 (columns 5 to 9) and 9 (10 to 14) in rows 2 to 7.
#pragma once

#include "core/compare/compare.hpp"

#include <limits>

namespace mote::test {

inline compare::CompareInput made_up() {
  compare::CompareInput p;
  p.name = "made_up";
  p.width = 20;
  p.height = 10;
  for (std::uint32_t y = 0; y < p.height; ++y)
    for (std::uint32_t x = 0; x < p.width; ++x) {
      const bool hit = x >= 5 && x < 15 && y >= 2 && y < 8;
      p.id.push_back(!hit ? compare::no_id : x < 10 ? 7u : 9u);
      p.depth.push_back(hit ? 100.0 + x : std::numeric_limits<double>::infinity());
      p.normal.push_back(hit ? glm::vec3(0, 0.6f, -0.8f) : glm::vec3(0));
      p.color.push_back(hit ? glm::vec4(0.2f, 0.4f, 0.6f, 1.0f) : glm::vec4(1));
    }
  return p;
}
constexpr std::size_t on_seven = 4 * 20 + 6, on_nine = 4 * 20 + 12, on_nothing = 0;
constexpr std::size_t particles = 60, all_pixels = 200;

} // namespace mote::test
