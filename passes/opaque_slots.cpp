// SPDX-License-Identifier: MIT
#include "passes/opaque_slots.hpp"

#include "core/scene/scene.hpp"
#include "passes/particles/pipelines.hpp"

#include <array>
#include <limits>
#include <string>

namespace mote::passes {
namespace {

using gpu::TextureFormat;

struct AovSlot {
  std::string_view name;
  TextureFormat format;
  AovBits bit;
  std::string_view summary;
};
constexpr std::array<AovSlot, 3> aov_slots{{
    {"aov_depth", TextureFormat::R32Float, aov_depth_bit, "distance along the view axis, +inf where nothing is"},
    {"aov_id", TextureFormat::R32Uint, aov_id_bit, "particle id, 4294967295 where nothing is"},
    {"aov_normal", TextureFormat::RGBA32Float, aov_normal_bit, "unit normal in world space, turned to the eye"},
}};

} // namespace

void declare_opaque_slots(std::vector<rg::Slot>& slots) {
  slots.push_back({.name = "color", .access = rg::Access::ColorWrite, .summary = "scene-linear color over the background",
                   .makes = rg::TextureSpec{.format = TextureFormat::RGBA16Float}, .copied_into = true});
  slots.push_back({.name = "depth", .access = rg::Access::DepthWrite, .summary = "n / z, reverse-Z",
                   .makes = rg::TextureSpec{.format = TextureFormat::Depth32Float}, .copied_into = true});
  for (const AovSlot& aov : aov_slots)
    slots.push_back({.name = std::string(aov.name), .access = rg::Access::ColorWrite, .summary = std::string(aov.summary),
                     .makes = rg::TextureSpec{.format = aov.format}, .optional = true, .copied_into = true});
}

std::uint32_t connected_aovs(const rg::PassContext& context) {
  std::uint32_t bits = 0;
  for (const AovSlot& aov : aov_slots)
    if (context.connected(aov.name)) bits |= aov.bit;
  return bits;
}

gpu::Color opaque_clear_value(std::string_view slot, const DrawStates& states, const rg::FrameInput& frame) {
  if (slot == "aov_depth") return {std::numeric_limits<double>::infinity(), 0, 0, 0};
  if (slot == "depth") return {cleared_depth(states), 0, 0, 0};
  if (slot == "aov_id") return {4294967295.0, 0, 0, 0};
  if (slot != "color") return {0, 0, 0, 0};
  const glm::dvec4 b = frame.get<Scene>().background;
  return {b.r, b.g, b.b, b.a};
}

} // namespace mote::passes
