// SPDX-License-Identifier: MIT
// Outlines that stand for a sphere on the image, each a convex polygon: how much more than the sphere's disc each covers, and
// how much of the disc it misses. Exact geometry in double, no device. Method book, sections 4.1 and 4.4.
#pragma once

#include "core/chart/chart.hpp"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace mote::app {

struct Outline2d {
  std::string name{};
  bool baseline{};
  std::vector<glm::dvec2> corners{}; // on the plane z = 1, counter-clockwise or clockwise
};
// Of a sphere around `center` (view space, wholly before the eye) with radius r.
std::vector<Outline2d> outlines(const glm::dvec3& center, double r);

struct Covered {
  double missing{}, overdraw{}; // part of the sphere's image outside the outline; outline's area / image's area
};
Covered covered(const Outline2d& outline, const glm::dvec3& center, double r, int steps = 500);

// Spheres at distance / radius 1.5, 3 and 10, `degrees` off the axis.
chart::Panel outline_panel(double degrees);

} // namespace mote::app
