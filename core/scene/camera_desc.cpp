// SPDX-License-Identifier: MIT
// Completes a camera of which the user gave some numbers, so that the data is in view.
#include "core/math/fit.hpp"
#include "core/scene/realize.hpp"

#include <algorithm>
#include <cmath>

namespace mote {
namespace {

// From the front, a little from the right and from above, whichever axis is up: (0.25, -1, 0.15) for z up.
glm::dvec3 default_direction(const glm::dvec3& up_given) {
  const glm::dvec3 up = glm::normalize(up_given);
  const glm::dvec3 side = std::abs(up.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(side - up * glm::dot(side, up));
  return glm::normalize(0.25 * right + glm::cross(right, up) + 0.15 * up);
}

} // namespace

Camera complete_camera(const CameraDesc& desc, const Bounds& bounds, Size2d size) {
  Bounds b = bounds;
  if (b.empty()) b.add(glm::dvec3(0), 0.5);
  const bool untouched = !desc.eye && !desc.target && !desc.up && !desc.fov_y && desc.projection == Projection::Perspective;
  Camera c = untouched ? frame(b, size) : Camera{};
  c.projection = desc.projection;
  c.near = desc.near;
  c.far = desc.far;
  if (untouched) return c;

  c.fov_y = desc.fov_y.value_or(30.0);
  c.target = desc.target.value_or(b.center());
  c.up = desc.up.value_or(glm::dvec3(0, 0, 1));
  if (!desc.up && desc.eye) { // looking along z: y is up
    const glm::dvec3 v = *desc.eye - c.target;
    if (glm::length(glm::cross(v, c.up)) <= 1e-6 * glm::length(v)) c.up = {0, 1, 0};
  }
  const double up_length = glm::length(c.up);
  const glm::dvec3 toward_eye = desc.eye && *desc.eye != c.target ? glm::normalize(*desc.eye - c.target)
                                : up_length > 0.0                 ? default_direction(c.up)
                                                                  : glm::dvec3(0, -1, 0);
  if (!(glm::length(glm::cross(toward_eye, c.up)) > 1e-9 * up_length)) { // check() says what is wrong
    c.eye = desc.eye.value_or(c.target + toward_eye);
    return c;
  }
  const Extent e = extent_of(b, c, toward_eye, size);
  const double least = 1e-12 * (1.0 + glm::length(c.target));
  c.height = desc.height.value_or(std::max(1.02 * e.height, least));
  const double distance = c.projection == Projection::Perspective ? 1.02 * e.distance : 1.02 * e.depth + 0.5 * e.height;
  c.eye = desc.eye.value_or(c.target + toward_eye * std::max(distance, least));
  return c;
}

} // namespace mote
