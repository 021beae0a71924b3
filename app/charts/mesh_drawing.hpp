// SPDX-License-Identifier: MIT
// Draws one unit mesh at many places, for charts only: mote draws exact surfaces.
#pragma once

#include "app/charts/icosphere.hpp"
#include "app/library/device.hpp"
#include "core/math/camera.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace mote::app {

struct DrawnMesh {
  Size2d size{};
  std::vector<std::uint32_t> index{}; // of the sphere seen at each pixel; 0xFFFFFFFF where nothing is
  double milliseconds{};              // the least of three draws after one
};
// `spheres`: centers in view space and radii; a perspective view.
DrawnMesh draw_meshes(DrawingDevice& device, std::span<const glm::vec4> spheres, const Icosphere& mesh, const View& view);

} // namespace mote::app
