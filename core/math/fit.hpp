// SPDX-License-Identifier: MIT
// How far away, or how large, a camera must see so that a box is in its picture: pure. Cameras that a scene leaves open are
// completed with it, and the window frames with it.
#pragma once

#include "core/math/camera.hpp"

namespace mote {

struct Extent {         // of a box around a camera's target, seen along -toward_eye
  double distance{};    // the least at which all corners are in the frustum (perspective)
  double height{};      // that shows all corners (orthographic)
  double depth{};       // of the nearest corner before the target
};
// Uses target, up and fov_y of the camera; `toward_eye` is a unit vector that is not parallel to up.
Extent extent_of(const Bounds& bounds, const Camera& camera, const glm::dvec3& toward_eye, Size2d size);

} // namespace mote
