// SPDX-License-Identifier: MIT
#include "passes/shadows/shadow_maps.hpp"

namespace mote::passes {

std::uint32_t ShadowMaps::number_of(const gpu::Texture& map) {
  for (std::size_t i = 0; i < entries_.size(); ++i)
    if (entries_[i].texture.lock() == map.impl()) return static_cast<std::uint32_t>(i);
  std::size_t free = 0;
  while (free < entries_.size() && !entries_[free].texture.expired()) ++free;
  if (free == entries_.size()) entries_.emplace_back();
  entries_[free] = {.texture = map.impl()};
  return static_cast<std::uint32_t>(free);
}

void ShadowMaps::publish(const gpu::Texture& map, const ShadowMapInfo& info, MapInBuffers* buffers) {
  Entry& entry = entries_[number_of(map)];
  entry.info = info;
  entry.valid = true;
  entry.buffers = buffers;
}

void ShadowMaps::withdraw(const gpu::Texture& map) { entries_[number_of(map)].valid = false; }

const ShadowMapInfo* ShadowMaps::find(const gpu::Texture& map) const {
  for (const Entry& entry : entries_)
    if (entry.valid && entry.texture.lock() == map.impl()) return &entry.info;
  return nullptr;
}

MapInBuffers* ShadowMaps::in_buffers(const gpu::Texture& map) const {
  for (const Entry& entry : entries_)
    if (entry.valid && entry.texture.lock() == map.impl()) return entry.buffers;
  return nullptr;
}

} // namespace mote::passes
