// SPDX-License-Identifier: MIT
#include "passes/particles/placement.hpp"

#include <bit>

namespace mote::passes {

ViewCuller::ViewCuller(const View& view) {
  // One pixel of slack: sample offsets, proxy margins and rounding never matter.
  const double hx = (0.5 * view.size.width + 1.0) / view.focal, hy = (0.5 * view.size.height + 1.0) / view.focal;
  auto add = [&](glm::dvec3 normal, double offset) {
    const double length = glm::length(normal);
    planes_[count_] = normal / length;
    offsets_[count_++] = offset / length;
  };
  const bool perspective = view.projection == Projection::Perspective;
  for (const double side : {-1.0, 1.0}) {
    add(perspective ? glm::dvec3(side, 0, hx) : glm::dvec3(side, 0, 0), perspective ? 0.0 : hx);
    add(perspective ? glm::dvec3(0, side, hy) : glm::dvec3(0, side, 0), perspective ? 0.0 : hy);
  }
  add({0, 0, 1}, -view.near_cut);
  if (view.far_cut > 0) add({0, 0, -1}, view.far_cut);
}

bool ViewCuller::may_see(const glm::dvec3& center, const glm::dmat3& m, const glm::dvec3& half) const {
  for (int i = 0; i < count_; ++i) {
    const glm::dvec3 normal = planes_[i] * m; // in data space, per axis
    const double reach = glm::dot(glm::abs(normal), half);
    const double distance = glm::dot(planes_[i], center) + offsets_[i];
    if (distance < -reach * (1.0 + 1e-6) - 1e-6 * glm::length(center)) return false;
  }
  return true;
}

void place_chunks(const ChunkSet& set, std::uint64_t first, std::uint64_t count, const Instance& instance,
                  const View& view, const ViewCuller& culler, std::vector<PlacedChunk>& out) {
  const glm::dmat3 linear = view.rotation * glm::dmat3(instance.world_from_data);
  const glm::dvec3 translation = glm::dvec3(instance.world_from_data[3]) - view.eye;
  const glm::dmat3 instance_linear(instance.world_from_data);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Chunk& chunk = set.chunks[first + i];
    // Subtract the eye before anything is rotated or rounded.
    const glm::dvec3 origin = view.rotation * (instance_linear * chunk.origin + translation);
    const glm::dvec3 lo(chunk.box_min), hi(chunk.box_max);
    if (!culler.may_see(origin + linear * ((lo + hi) * 0.5), linear, (hi - lo) * 0.5)) continue;
    const glm::vec3 o(origin);
    out.push_back({glm::uvec4(std::bit_cast<std::uint32_t>(o.x), std::bit_cast<std::uint32_t>(o.y),
                              std::bit_cast<std::uint32_t>(o.z), static_cast<std::uint32_t>(i))});
  }
}

} // namespace mote::passes
