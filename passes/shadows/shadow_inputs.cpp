// SPDX-License-Identifier: MIT
#include "passes/shadows/shadow_inputs.hpp"

#include "passes/particles/frame_uniform.hpp"
#include "passes/particles/particle_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace mote::passes {

void ShadowInputs::declare(std::vector<rg::Slot>& slots, rg::Params& params) {
  slots_.clear();
  const auto count = params.integer("shadows", 1, {.min = 0, .max = max_lights}, "how many inputs for shadow maps: shadow, shadow_2, ...");
  for (std::int64_t i = 1; i <= count; ++i) {
    slots_.push_back(i == 1 ? "shadow" : fmt::format("shadow_{}", i));
    slots.push_back({.name = slots_.back(), .access = rg::Access::Sampled, .summary = "map of a shadow_map pass", .optional = true});
  }
}

bool ShadowInputs::connected(const rg::PassContext& context) const {
  return std::any_of(slots_.begin(), slots_.end(), [&](const std::string& slot) { return context.connected(slot); });
}

std::vector<MappedLight> ShadowInputs::lights(const rg::PassContext& context) const {
  const ShadowMaps& maps = context.frame().get<ParticleStore>().shadow_maps();
  std::vector<MappedLight> out;
  for (const std::string& slot : slots_)
    if (const gpu::Texture map = context.connected(slot) ? context.whole_texture(slot) : gpu::Texture())
      if (const ShadowMapInfo* info = maps.find(map)) out.push_back({map, *info, maps.in_buffers(map)});
  return out;
}

void draw_textures(std::vector<MappedLight>& lights, gpu::CommandEncoder& encoder, const MapInBuffers::Mark& mark) {
  for (MappedLight& light : lights)
    if (light.buffers) light.map = std::exchange(light.buffers, nullptr)->draw_texture(encoder, mark);
}

} // namespace mote::passes
