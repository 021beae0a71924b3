// SPDX-License-Identifier: MIT
#include "passes/shadows/tile_shadows.hpp"

#include "passes/scratch.hpp"

#include <algorithm>

namespace mote::passes {

TileShadows::TileShadows(gpu::Device device) : device_(std::move(device)) {
  std::vector<gpu::BindGroupLayoutEntry> entries{{.binding = 0, .visibility = gpu::ShaderStage::Compute, .type = gpu::BindingType::UniformBuffer,
                                                  .min_binding_size = sizeof(ShadowBlock) * most_maps}};
  for (std::uint32_t k = 0; k < most_maps; ++k)
    entries.push_back({.binding = k + 1, .visibility = gpu::ShaderStage::Compute, .type = gpu::BindingType::SampledTexture,
                       .sample_type = gpu::SampleType::Uint, .view_dimension = gpu::TextureViewDimension::D2Array});
  layout_ = device_.create_bind_group_layout({.label = "tiles.shadows", .entries = entries});
  blocks_ = device_.create_buffer({.label = "tiles.shadows", .size = sizeof(ShadowBlock) * most_maps, .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
  make_scratch(device_, none_, "tiles.no_map", {1, 1, 2}, gpu::TextureFormat::RGBA32Uint);
}

bool TileShadows::can_hold(const std::vector<MappedLight>& lights) {
  return lights.size() <= most_maps && std::all_of(lights.begin(), lights.end(), [](const MappedLight& light) {
           return light.info.ids && std::all_of(light.info.types.begin(), light.info.types.end(), [](const std::string& type) { return type == "sphere"; });
         });
}

void TileShadows::update(const std::vector<MappedLight>& lights, const View& camera) {
  std::array<ShadowBlock, most_maps> blocks{};
  std::array<gpu::Texture, most_maps> maps{none_, none_, none_, none_};
  key_ = {.maps = static_cast<std::uint32_t>(lights.size())};
  for (std::size_t k = 0; k < lights.size(); ++k) {
    blocks[k] = shadow_block(lights[k].info, camera);
    maps[k] = lights[k].map;
    key_.lights[k] = static_cast<std::uint32_t>(lights[k].info.light);
    if (lights[k].info.view.projection == Projection::Orthographic) key_.orthographic |= 1u << k;
  }
  device_.queue().write_buffer(blocks_, 0, std::as_bytes(std::span(blocks)));
  if (group_ && bound_ == maps) return;
  bound_ = maps;
  std::vector<gpu::TextureView> views;
  for (const gpu::Texture& map : maps) views.push_back(map.create_view({.dimension = gpu::TextureViewDimension::D2Array}));
  std::vector<gpu::BindGroupEntry> entries{{.binding = 0, .buffer = {&blocks_}}};
  for (std::uint32_t k = 0; k < most_maps; ++k) entries.push_back({.binding = k + 1, .texture = &views[k]});
  group_ = device_.create_bind_group({.label = "tiles.shadows", .layout = &layout_, .entries = entries});
}

} // namespace mote::passes
