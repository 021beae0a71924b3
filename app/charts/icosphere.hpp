// SPDX-License-Identifier: MIT
// The unit sphere as triangles: an icosahedron, each triangle cut into four `level` times. Method book, section 8.6. Pure.
#pragma once

#include "core/chart/chart.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace mote::app {

struct Icosphere {
  std::vector<glm::dvec3> corners{};      // unit; also the normals
  std::vector<std::uint32_t> triangles{}; // three corners each: 20 * 4^level
};
Icosphere icosphere(int level);

// The deepest that a triangle lies below the sphere, in radii: the outline's error.
double deficit(const Icosphere& mesh);

// Outline's error and normals' error over triangles.
chart::Panel sagitta_panel();

} // namespace mote::app
