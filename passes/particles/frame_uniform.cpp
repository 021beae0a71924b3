// SPDX-License-Identifier: MIT
#include "passes/particles/frame_uniform.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mote::passes {
namespace {

LightBlock light_block(const Light& light, const View& view) {
  LightBlock block;
  const bool local = light.kind == LightKind::Point || light.kind == LightKind::Spot;
  if (local) block.position = glm::vec4(glm::vec3(view.to_view(light.position)), 1.0f);
  if (light.kind == LightKind::Headlight) block.position = {0, 0, -1, 0};
  if (light.kind == LightKind::Directional)
    block.position = glm::vec4(glm::vec3(view.rotation * -glm::normalize(light.direction)), 0.0f);
  block.strength = glm::vec4(glm::vec3(light.color * light.intensity), 0.0f);
  if (local) block.attenuation = glm::vec4(glm::vec3(light.attenuation), 0.0f);
  if (light.kind == LightKind::Spot) {
    block.axis = glm::vec4(glm::vec3(view.rotation * glm::normalize(light.direction)), 0.0f);
    const double outer = std::cos(light.outer_angle), inner = std::cos(light.inner_angle);
    block.cone = glm::vec4(static_cast<float>(outer), static_cast<float>(1.0 / std::max(inner - outer, 1e-9)), 0, 0);
  }
  return block;
}

// 1 / focal to so few bits that its product with any pixel's distance from the axis, a half-integer, is exact in a
// float: 12 bits up to 4096 pixels, fewer for larger pictures. The same for all panels of a picture.
double exact_part(double inverse, const Size2d& picture) {
  const std::uint32_t farthest = std::max({picture.width, picture.height, 1u}) - 1; // in half pixels
  const int bits = std::clamp(24 - static_cast<int>(std::bit_width(farthest)), 1, 12);
  const std::uint32_t mask = ~((1u << (24 - bits)) - 1u);
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(static_cast<float>(inverse)) & mask);
}

} // namespace

FrameBlock frame_block(const Scene& scene, const View& view) {
  FrameBlock block;
  const double w = view.size.width, h = view.size.height;
  const double inverse = 1.0 / view.focal, inverse_high = exact_part(inverse, view.whole());
  const glm::dvec2 center = view.center();
  block.viewport = glm::vec4(glm::dvec4(w, h, view.focal, inverse_high));
  block.sample_near_far = glm::vec4(glm::dvec4(view.sample_offset.x - center.x, view.sample_offset.y - center.y, view.near_cut,
                                               view.far_cut > 0 ? std::min(view.far_cut, 3e38) : 3e38));
  block.depth_near.x = static_cast<float>(view.depth_near);
  block.depth_near.y = static_cast<float>(inverse - inverse_high);
  const glm::dmat3 world_from_view = glm::transpose(view.rotation);
  for (int i = 0; i < 3; ++i) block.world_from_view[i] = glm::vec4(glm::vec3(world_from_view[i]), 0.0f);
  block.ambient = glm::vec4(glm::vec3(scene.ambient), 0.0f);
  const std::size_t count = std::min<std::size_t>(scene.lights.size(), max_lights);
  for (std::size_t i = 0; i < count; ++i) block.lights[i] = light_block(scene.lights[i], view);
  return block;
}

} // namespace mote::passes
