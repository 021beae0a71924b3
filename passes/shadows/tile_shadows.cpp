// SPDX-License-Identifier: MIT
#include "passes/shadows/tile_shadows.hpp"

#include <algorithm>

namespace mote::passes {

TileShadows::TileShadows(gpu::Device device) : device_(std::move(device)) {
  constexpr std::uint64_t block = sizeof(ShadowBlock) * most_maps;
  std::vector<gpu::BindGroupLayoutEntry> entries{{.binding = 0, .visibility = gpu::ShaderStage::Compute, .type = gpu::BindingType::UniformBuffer, .min_binding_size = block}};
  for (std::uint32_t k = 1; k <= 2 * most_maps; ++k)
    entries.push_back({.binding = k, .visibility = gpu::ShaderStage::Compute, .type = gpu::BindingType::ReadOnlyStorageBuffer});
  layout_ = device_.create_bind_group_layout({.label = "tiles.shadows", .entries = entries});
  blocks_ = device_.create_buffer({.label = "tiles.shadows", .size = block, .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
  none_ = device_.create_buffer({.label = "tiles.no_map", .size = 16, .usage = gpu::BufferUsage::Storage});
}

bool TileShadows::can_hold(const std::vector<MappedLight>& lights) {
  return lights.size() <= most_maps && std::all_of(lights.begin(), lights.end(), [](const MappedLight& light) { return light.buffers != nullptr; });
}

void TileShadows::update(const std::vector<MappedLight>& lights, const View& camera) {
  std::array<ShadowBlock, most_maps> blocks{};
  std::array<MapInBuffers::Buffers, most_maps> maps;
  maps.fill({none_, none_, false});
  key_ = {.maps = static_cast<std::uint32_t>(lights.size())};
  for (std::size_t k = 0; k < lights.size(); ++k) {
    blocks[k] = shadow_block(lights[k].info, camera);
    maps[k] = lights[k].buffers->buffers();
    key_.lights[k] = static_cast<std::uint32_t>(lights[k].info.light);
    if (lights[k].info.view.projection == Projection::Orthographic) key_.orthographic |= 1u << k;
    if (maps[k].by_id) key_.by_id |= 1u << k;
  }
  device_.queue().write_buffer(blocks_, 0, std::as_bytes(std::span(blocks)));
  std::vector<gpu::BindGroupEntry> entries{{.binding = 0, .buffer = {&blocks_}}};
  for (std::uint32_t k = 0; k < most_maps; ++k) entries.push_back({.binding = 1 + k, .buffer = {&maps[k].casters}});
  for (std::uint32_t k = 0; k < most_maps; ++k) entries.push_back({.binding = 1 + static_cast<std::uint32_t>(most_maps) + k, .buffer = {&maps[k].ids}});
  group_ = device_.create_bind_group({.label = "tiles.shadows", .layout = &layout_, .entries = entries});
}

} // namespace mote::passes
