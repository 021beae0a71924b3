// SPDX-License-Identifier: MIT
#include "core/math/camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote {

glm::dvec3 View::ray_origin(double x, double y) const {
  if (projection == Projection::Perspective) return glm::dvec3(0);
  return {(x + sample_offset.x - center().x) / focal, (y + sample_offset.y - center().y) / focal, 0.0};
}

glm::dvec3 View::ray_direction(double x, double y) const {
  if (projection == Projection::Orthographic) return {0, 0, 1};
  return {(x + sample_offset.x - center().x) / focal, (y + sample_offset.y - center().y) / focal, 1.0};
}

namespace {
bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
} // namespace

std::string check(const Camera& c) {
  if (!finite(c.eye) || !finite(c.target) || !finite(c.up)) return "eye, target and up need finite numbers";
  const glm::dvec3 view = c.target - c.eye;
  if (glm::length(view) == 0.0) return "eye and target are the same point";
  const double sine = glm::length(glm::cross(glm::normalize(view), c.up));
  if (!(sine > 1e-9 * glm::length(c.up))) return "up lies along the view direction (or is zero)";
  if (c.projection == Projection::Perspective && !(c.fov_y > 0.0 && c.fov_y < 180.0))
    return fmt::format("fov_y is {} degrees; it must lie between 0 and 180", c.fov_y);
  if (c.projection == Projection::Orthographic && !(c.height > 0.0 && std::isfinite(c.height)))
    return fmt::format("height is {}; an orthographic camera needs a height above 0", c.height);
  if (c.near && !(*c.near > 0.0 && std::isfinite(*c.near))) return fmt::format("near is {}; it must be above 0", *c.near);
  if (c.far && !(*c.far > 0.0)) return fmt::format("far is {}; it must be above 0", *c.far);
  if (c.near && c.far && *c.near >= *c.far) return fmt::format("near ({}) must be less than far ({})", *c.near, *c.far);
  return {};
}

View make_view(const Camera& c, Size2d size, double scene_size) {
  View v;
  v.projection = c.projection;
  v.eye = c.eye;
  const glm::dvec3 forward = glm::normalize(c.target - c.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, c.up));
  const glm::dvec3 down = glm::cross(forward, right);
  v.rotation = glm::transpose(glm::dmat3(right, down, forward));
  v.size = size;
  v.focal = c.projection == Projection::Perspective ? size.height / (2.0 * std::tan(glm::radians(c.fov_y) * 0.5))
                                                    : size.height / c.height;
  v.near_cut = c.near.value_or(0.0);
  v.far_cut = c.far.value_or(0.0);
  // n/z in a float keeps its relative precision over 1e30; a small n means that nothing ties at depth 1.
  const double length = std::max({scene_size, glm::length(c.target - c.eye), 1e-20});
  v.depth_near = std::min(1e-6 * length, c.near.value_or(length));
  return v;
}

std::vector<View> panels(const View& view, std::uint32_t most) {
  const auto split = [most](std::uint32_t length) {
    std::vector<std::uint32_t> ends{0};
    const std::uint64_t parts = (std::uint64_t{length} + most - 1) / most;
    for (std::uint64_t i = 1; i <= parts; ++i) ends.push_back(static_cast<std::uint32_t>(length * i / parts));
    return ends;
  };
  const std::vector<std::uint32_t> x = split(view.size.width), y = split(view.size.height);
  if (x.size() == 2 && y.size() == 2) return {view};
  std::vector<View> out;
  for (std::size_t j = 1; j < y.size(); ++j)
    for (std::size_t i = 1; i < x.size(); ++i) {
      View& panel = out.emplace_back(view);
      panel.picture = view.whole();
      panel.panel_origin = view.panel_origin + glm::uvec2(x[i - 1], y[j - 1]);
      panel.size = {x[i] - x[i - 1], y[j] - y[j - 1]};
    }
  return out;
}

Camera frame(const Bounds& bounds, Size2d size) {
  Bounds b = bounds;
  if (b.empty()) b.add(glm::dvec3(0), 0.5);
  Camera c;
  c.up = {0, 0, 1};
  const glm::dvec3 toward_eye = glm::normalize(glm::dvec3(0.25, -1.0, 0.15));
  const glm::dvec3 right = glm::normalize(glm::cross(-toward_eye, c.up));
  const glm::dvec3 up = glm::cross(right, -toward_eye);
  const double half_y = std::tan(glm::radians(c.fov_y) * 0.5);
  const double half_x = half_y * (size.height ? double(size.width) / size.height : 1.0);
  // The least distance from the center at which each corner lies inside the frustum, and 2 % more.
  const glm::dvec3 half = glm::max((b.max - b.min) * 0.5, glm::dvec3(1e-12 * (1.0 + glm::length(b.center()))));
  double distance = 0.0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner = half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    const double side = std::max(std::abs(glm::dot(corner, up)) / half_y, std::abs(glm::dot(corner, right)) / half_x);
    distance = std::max(distance, glm::dot(corner, toward_eye) + side);
  }
  c.target = b.center();
  c.eye = c.target + toward_eye * (1.02 * distance);
  return c;
}

} // namespace mote
