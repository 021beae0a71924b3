// SPDX-License-Identifier: MIT
#include "passes/shadows/shadow_masks.hpp"

#include "passes/full_screen.hpp"
#include "passes/particles/frame_uniform.hpp"
#include "passes/particles/particle_type.hpp"
#include "passes/scratch.hpp"
#include "shaders/embedded.hpp"

#include <algorithm>
#include <array>

namespace mote::passes {
namespace {

using gpu::BindingType, gpu::SampleType, gpu::ShaderStage, gpu::TextureFormat;

gpu::BindGroupLayoutEntry texture_entry(std::uint32_t binding, SampleType type, gpu::TextureViewDimension dimension = gpu::TextureViewDimension::D2) {
  return {.binding = binding, .visibility = ShaderStage::Fragment, .type = BindingType::SampledTexture, .sample_type = type, .view_dimension = dimension};
}

} // namespace

ShadowBlock shadow_block(const ShadowMapInfo& info, const View& camera) {
  ShadowBlock block;
  const glm::dmat3 turn = info.view.rotation * glm::transpose(camera.rotation);
  for (int i = 0; i < 3; ++i) block.light_from_view[static_cast<std::size_t>(i)] = glm::vec4(glm::vec3(turn[i]), 0.0f);
  block.offset = glm::vec4(glm::vec3(info.view.to_view(camera.eye)), 0.0f);
  block.map = glm::vec4(glm::dvec4(info.view.size.width, info.view.size.height, info.view.focal, info.view.depth_near));
  block.bias.x = static_cast<float>(info.normal_offset * (info.pcf + std::sqrt(0.5)));
  return block;
}

ShadowMasks::ShadowMasks(gpu::Device device, const gpu::BindGroupLayout& frame_layout) : device_(std::move(device)) {
  const std::array surface{texture_entry(0, SampleType::Uint), texture_entry(1, SampleType::UnfilterableFloat)};
  surface_layout_ = device_.create_bind_group_layout({.label = "shadow.surface", .entries = surface});
  const gpu::BindGroupLayoutEntry block{.binding = 0, .visibility = ShaderStage::Fragment, .type = BindingType::UniformBuffer,
                                        .min_binding_size = sizeof(ShadowBlock)};
  const std::array ids{block, texture_entry(1, SampleType::Uint, gpu::TextureViewDimension::D2Array)};
  const std::array depth{block, texture_entry(1, SampleType::Depth)};
  ids_layout_ = device_.create_bind_group_layout({.label = "shadow.ids", .entries = ids});
  depth_layout_ = device_.create_bind_group_layout({.label = "shadow.depth", .entries = depth});
  const std::array<const gpu::BindGroupLayout*, 3> for_ids{&frame_layout, &surface_layout_, &ids_layout_};
  const std::array<const gpu::BindGroupLayout*, 3> for_depth{&frame_layout, &surface_layout_, &depth_layout_};
  ids_pipeline_layout_ = device_.create_pipeline_layout({.label = "shadow.ids", .bind_group_layouts = for_ids});
  depth_pipeline_layout_ = device_.create_pipeline_layout({.label = "shadow.depth", .bind_group_layouts = for_depth});
}

void ShadowMasks::update(const std::vector<MappedLight>& lights, const View& camera) {
  const auto count = static_cast<std::uint32_t>(lights.size());
  const gpu::Extent3d size{camera.size.width, camera.size.height, count};
  if (make_scratch(device_, texture_, "shadow.masks", size, TextureFormat::R8Unorm)) {
    all_ = texture_.create_view({.dimension = gpu::TextureViewDimension::D2Array});
    layers_.assign(count, {});
    for (std::uint32_t i = 0; i < count; ++i)
      layers_[i].target = texture_.create_view({.dimension = gpu::TextureViewDimension::D2, .base_array_layer = i, .array_layer_count = 1});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    Layer& layer = layers_[i];
    const ShadowMapInfo& info = lights[i].info;
    const ShadowBlock block = shadow_block(info, camera);
    if (!layer.block)
      layer.block = device_.create_buffer({.label = "shadow.block", .size = sizeof block, .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
    device_.queue().write_buffer(layer.block, 0, std::as_bytes(std::span(&block, 1)));
    layer.orthographic = info.view.projection == Projection::Orthographic;
    layer.pcf = info.pcf;
    layer.types = info.types;
    if (layer.types.empty()) layer.types.emplace_back("sphere"); // nothing casts, and that is found
    if (layer.group && layer.map == lights[i].map && layer.ids == info.ids) continue;
    layer.map = lights[i].map;
    layer.ids = info.ids;
    const gpu::TextureView view = layer.map.create_view();
    const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {&layer.block}}, gpu::BindGroupEntry{.binding = 1, .texture = &view}};
    layer.group = device_.create_bind_group({.label = "shadow.map", .layout = info.ids ? &ids_layout_ : &depth_layout_, .entries = entries});
  }
}

const gpu::RenderPipeline& ShadowMasks::pipeline(const Key& key) {
  gpu::RenderPipeline& found = pipelines_[key];
  if (found) return found;
  std::vector constants{gpu::spec(0, key.orthographic), gpu::spec(16, key.light_orthographic), gpu::spec(17, key.pcf)};
  if (key.ids) constants.push_back(gpu::spec(18, number_of(*find_particle_type(key.type))));
  gpu::ColorTargetState target{.format = TextureFormat::R8Unorm};
  const gpu::BlendComponent product{gpu::BlendFactor::Dst, gpu::BlendFactor::Zero, gpu::BlendOperation::Add};
  if (key.further) target.blend = gpu::BlendState{product, product};
  const std::array targets{target};
  const std::string ids = key.type + "/shadow/mask.frag";
  found = full_screen_pipeline(device_, {.label = "shadow.mask",
                                         .layout = key.ids ? &ids_pipeline_layout_ : &depth_pipeline_layout_,
                                         .fragment = key.ids ? std::string_view(ids) : std::string_view("shadow/mask.frag/depth"),
                                         .constants = constants,
                                         .targets = targets});
  return found;
}

void ShadowMasks::record(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame, const gpu::TextureView& id, const gpu::TextureView& normal_t,
                         bool orthographic) {
  if (!surface_ || !(id_ == id) || !(normal_t_ == normal_t)) {
    id_ = id, normal_t_ = normal_t;
    const std::array entries{gpu::BindGroupEntry{.binding = 0, .texture = &id_}, gpu::BindGroupEntry{.binding = 1, .texture = &normal_t_}};
    surface_ = device_.create_bind_group({.label = "shadow.surface", .layout = &surface_layout_, .entries = entries});
  }
  for (const Layer& layer : layers_) {
    Key key{.ids = layer.ids, .orthographic = orthographic, .light_orthographic = layer.orthographic, .pcf = layer.ids ? 0u : layer.pcf};
    if (!layer.ids) draw(encoder, frame, layer, key);
    for (std::size_t i = 0; layer.ids && i < layer.types.size(); ++i) {
      key.type = layer.types[i];
      key.further = i > 0;
      draw(encoder, frame, layer, key);
    }
  }
}

void ShadowMasks::draw(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame, const Layer& layer, const Key& key) {
  const std::array colors{gpu::ColorAttachment{.view = &layer.target, .load = key.further ? gpu::LoadOp::Load : gpu::LoadOp::DontCare}};
  gpu::RenderPass pass = encoder.begin_render_pass({.label = "shadow.mask", .colors = colors});
  pass.set_pipeline(pipeline(key));
  pass.set_bind_group(0, frame);
  pass.set_bind_group(1, surface_);
  pass.set_bind_group(2, layer.group);
  pass.draw(3);
  pass.end();
}

} // namespace mote::passes
