// SPDX-License-Identifier: MIT
#include "passes/particles/sprites.hpp"

#include <cmath>

namespace mote::passes {
namespace {
constexpr double margin = 4.0; // pixels: those of the shader's sprite and of widened proxies, sample offsets, rounding
}

SpriteRule::SpriteRule(const View& view, double largest_point)
    : perspective_(view.projection == Projection::Perspective),
      half_((0.5 * glm::dvec2(view.size.width, view.size.height) - margin) / view.focal), focal_(view.focal),
      least_z_(std::max(view.near_cut, view.depth_near) * (1.0 + 1e-5)), largest_(largest_point - margin) {}

bool SpriteRule::fits(const PlacedBox& box, double radius) const {
  const double z_min = box.center.z - box.extent.z, z_max = box.center.z + box.extent.z;
  if (box.near || !(z_min > least_z_)) return false;
  const glm::dvec2 reach = glm::max(glm::abs(glm::dvec2(box.center - box.extent)), glm::abs(glm::dvec2(box.center + box.extent)));
  const double z = perspective_ ? z_min : 1.0;
  if (reach.x > half_.x * z || reach.y > half_.y * z) return false;
  // A sphere's extent in tangents is 2 r sqrt(x^2 + z^2 - r^2) / (z^2 - r^2) (method book, 4.1), its nearest point not
  // before z_min.
  const double extent = perspective_ ? 2.0 * radius * std::hypot(std::max(reach.x, reach.y), z_max) / (z_min * (z_min + 2.0 * radius)) : 2.0 * radius;
  return extent * focal_ <= largest_;
}

} // namespace mote::passes
