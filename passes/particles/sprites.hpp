// SPDX-License-Identifier: MIT
// Which chunks the `point` expansion may draw as sprites: pure, no device. A point is discarded as a whole
// where its center leaves the clip volume, cut to the device's largest size, and square. None of the three
// can happen to a chunk that fits here: its box lies inside of the image, and no particle's rectangle is
// larger than the largest point. The sprite is as large as the longer side of that rectangle, so that the
// long ellipses off the axis are covered, too.
#pragma once

#include "passes/particles/placement.hpp"

namespace mote::passes {

class SpriteRule {
public:
  // `largest_point`: the device's limit in pixels.
  SpriteRule(const View& view, double largest_point);
  // `radius`: of the chunk's largest particle, in view space.
  [[nodiscard]] bool fits(const PlacedBox& box, double radius) const;

private:
  bool perspective_;
  glm::dvec2 half_; // of the image, in tangents (orthographic: view space)
  double focal_, least_z_, largest_;
};

} // namespace mote::passes
