// SPDX-License-Identifier: MIT
#include "core/math/fit.hpp"

#include <algorithm>
#include <cmath>

namespace mote {

Extent extent_of(const Bounds& b, const Camera& c, const glm::dvec3& toward_eye, Size2d size) {
  const glm::dvec3 right = glm::normalize(glm::cross(-toward_eye, c.up));
  const glm::dvec3 up = glm::cross(right, -toward_eye);
  const double aspect = size.height ? static_cast<double>(size.width) / size.height : 1.0;
  const double half_y = std::tan(glm::radians(c.fov_y) * 0.5);
  Extent e;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner = glm::dvec3(i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z) - c.target;
    const double x = std::abs(glm::dot(corner, right)) / aspect, y = std::abs(glm::dot(corner, up));
    const double nearness = glm::dot(corner, toward_eye);
    e.distance = std::max(e.distance, nearness + std::max(x, y) / half_y);
    e.height = std::max(e.height, 2.0 * std::max(x, y));
    e.depth = std::max(e.depth, nearness);
  }
  return e;
}

} // namespace mote
