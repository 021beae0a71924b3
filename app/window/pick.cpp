// SPDX-License-Identifier: MIT
#include "app/window/pick.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace mote::window {

View pick_view(const View& view, double x, double y, std::uint32_t radius) {
  const auto range = [radius](double place, std::uint32_t length) {
    const double pixel = std::clamp(std::floor(place), 0.0, static_cast<double>(length) - 1.0);
    const auto middle = static_cast<std::uint32_t>(pixel);
    const std::uint32_t low = middle > radius ? middle - radius : 0;
    return std::pair(low, std::min(middle + radius + 1, length));
  };
  const auto [left, right] = range(x, view.size.width);
  const auto [top, bottom] = range(y, view.size.height);
  View part = view;
  part.picture = view.whole();
  part.panel_origin = view.panel_origin + glm::uvec2(left, top);
  part.size = {right - left, bottom - top};
  return part;
}

std::optional<Pick> nearest_particle(const PickArea& area, double x, double y, const View& view) {
  std::optional<Pick> best;
  double best_distance = 0.0;
  for (std::uint32_t row = 0; row < area.size.height; ++row)
    for (std::uint32_t column = 0; column < area.size.width; ++column) {
      const std::size_t i = std::size_t{row} * area.size.width + column;
      if (i >= area.ids.size() || area.ids[i] == no_particle) continue;
      const glm::uvec2 pixel = area.origin + glm::uvec2(column, row);
      // To the nearest point of the pixel, so that the one under the mouse is at distance 0.
      const double dx = std::max({pixel.x - x, x - (pixel.x + 1.0), 0.0}), dy = std::max({pixel.y - y, y - (pixel.y + 1.0), 0.0});
      const double distance = dx * dx + dy * dy, depth = i < area.depths.size() ? double{area.depths[i]} : 0.0;
      if (best && std::tie(best_distance, best->depth) <= std::tie(distance, depth)) continue;
      best_distance = distance;
      best = Pick{area.ids[i], pixel, depth};
    }
  if (!best) return best;
  const glm::dvec3 in_view = view.ray_origin(best->pixel.x, best->pixel.y) + view.ray_direction(best->pixel.x, best->pixel.y) * best->depth;
  best->surface = view.eye + glm::transpose(view.rotation) * in_view;
  return best;
}

std::optional<double> angle_at(const glm::dvec3& a, const glm::dvec3& corner, const glm::dvec3& b) {
  const glm::dvec3 u = a - corner, v = b - corner;
  if (!(glm::length(u) > 0.0) || !(glm::length(v) > 0.0)) return std::nullopt;
  return glm::degrees(std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v))); // sharp at 0 and 180, too
}

} // namespace mote::window
