// SPDX-License-Identifier: MIT
#include "passes/over.hpp"

#include "passes/states.hpp"
#include "shaders/embedded.hpp"

#include <stdexcept>

namespace mote::passes {
namespace {
constexpr std::uint32_t push_bytes = 16;
constexpr std::uint32_t texture_bindings = 3; // there, and two of the shader's own
constexpr const char* saturated = "saturated";
constexpr const char* with_lists = "exact";
} // namespace

gpu::ColorAttachment ColorTarget::attachment() {
  const gpu::LoadOp load = clear ? gpu::LoadOp::Clear : gpu::LoadOp::Load;
  clear = false;
  return {.view = &view, .load = load, .clear = value};
}

Over::Over(gpu::Device device, const gpu::BindGroupLayout* lists) : device_(std::move(device)) {
  std::array<gpu::BindGroupLayoutEntry, texture_bindings> entries;
  for (std::uint32_t i = 0; i < texture_bindings; ++i)
    entries[i] = {.binding = i, .visibility = gpu::ShaderStage::Fragment, .type = gpu::BindingType::SampledTexture, .sample_type = gpu::SampleType::UnfilterableFloat};
  textures_layout_ = device_.create_bind_group_layout({.label = "over", .entries = entries});
  const std::array<const gpu::BindGroupLayout*, 2> groups{&textures_layout_, lists};
  layout_ = device_.create_pipeline_layout({.label = "over", .bind_group_layouts = std::span(groups).first(1)});
  if (lists)
    lists_layout_ = device_.create_pipeline_layout({.label = "over.lists", .bind_group_layouts = groups, .push_constant_size = push_bytes});
  nothing_ = device_.create_texture({.label = "over.nothing", .format = gpu::TextureFormat::RGBA8Unorm, .usage = gpu::TextureUsage::Sampled}).create_view();
}

gpu::ShaderModule Over::module(const std::string& key) {
  const auto words = shaders::spirv(key);
  if (words.empty()) throw std::logic_error("no shipped shader '" + key + "'");
  return device_.create_shader_module({.label = key, .spirv = words});
}

const gpu::RenderPipeline& Over::pipeline(const PipelineKey& key) {
  if (auto it = pipelines_.find(key); it != pipelines_.end()) return it->second;
  const gpu::ShaderModule vertex = module("post/fullscreen.vert");
  const gpu::ShaderModule fragment = module("post/" + key.name + ".frag");
  const std::array constants{gpu::spec(0, key.copied)};
  const std::array targets{gpu::ColorTargetState{.format = key.format}};
  std::array blending = targets;
  blending[0].blend = blend_over_premultiplied();
  gpu::RenderPipelineDescriptor descriptor{.label = key.name};
  descriptor.layout = key.name == with_lists ? &lists_layout_ : &layout_;
  descriptor.vertex = {.module = &vertex};
  descriptor.fragment = gpu::ProgrammableStage{.module = &fragment};
  if (key.name == saturated) {
    descriptor.depth = gpu::DepthState{.format = gpu::TextureFormat::Depth32Float, .write = true, .compare = gpu::CompareFunction::Always};
  } else {
    descriptor.fragment->constants = constants;
    descriptor.targets = key.copied || key.copying ? targets : blending;
  }
  return pipelines_.emplace(key, device_.create_render_pipeline(descriptor)).first->second;
}

gpu::BindGroup Over::group(const gpu::TextureView& there, std::span<const gpu::TextureView> textures) {
  std::array<gpu::BindGroupEntry, texture_bindings> entries;
  for (std::uint32_t i = 0; i < texture_bindings; ++i) {
    const gpu::TextureView* view = i == 0 ? &there : i - 1 < textures.size() ? &textures[i - 1] : &nothing_;
    entries[i] = {.binding = i, .texture = *view ? view : &nothing_};
  }
  return device_.create_bind_group({.label = "over", .layout = &textures_layout_, .entries = entries});
}

void Over::begin(gpu::CommandEncoder& encoder, ColorTarget& color, bool opaque, std::uint32_t width, std::uint32_t height) {
  copied_ = !opaque;
  if (opaque) return;
  const gpu::Extent3d size{width, height};
  if (!copy_ || !(copy_.size() == size))
    copy_ = device_.create_texture({.label = "over.copy", .size = size, .format = gpu::TextureFormat::RGBA32Float,
                                    .usage = gpu::TextureUsage::Sampled | gpu::TextureUsage::RenderAttachment});
  if (color.clear) { // nothing drawn yet: make what it starts from readable
    const std::array attachment{color.attachment()};
    encoder.begin_render_pass({.label = "over.clear", .colors = attachment}).end();
  }
  const gpu::TextureView view = copy_.create_view();
  const std::array attachment{gpu::ColorAttachment{.view = &view, .load = gpu::LoadOp::Clear}};
  gpu::RenderPass pass = encoder.begin_render_pass({.label = "over.copy", .colors = attachment});
  pass.set_pipeline(pipeline({.name = "layer", .format = gpu::TextureFormat::RGBA32Float, .copying = true}));
  pass.set_bind_group(0, group(nothing_, std::span(&color.view, 1)));
  pass.draw(3);
  pass.end();
}

void Over::apply(gpu::CommandEncoder& encoder, ColorTarget& color, const std::string& name, std::span<const gpu::TextureView> textures,
                 Rows rows, const gpu::BindGroup& lists, std::span<const std::byte> constants) {
  const std::array attachment{color.attachment()};
  const gpu::TextureView there = copied_ ? copy_.create_view() : gpu::TextureView();
  gpu::RenderPass pass = encoder.begin_render_pass({.label = "over." + name, .colors = attachment});
  pass.set_pipeline(pipeline({.name = name, .format = color.format, .copied = copied_}));
  pass.set_bind_group(0, group(there, textures));
  if (lists) pass.set_bind_group(1, lists);
  if (!constants.empty()) pass.set_push_constants(0, constants);
  pass.set_scissor(0, rows.begin, color.view.size().width, rows.end - rows.begin);
  pass.draw(3);
  pass.end();
}

void Over::mark_saturated(gpu::CommandEncoder& encoder, const gpu::TextureView& layer, const gpu::TextureView& depth) {
  gpu::RenderPass pass = encoder.begin_render_pass({.label = "over.saturated", .depth = gpu::DepthAttachment{.view = &depth, .load = gpu::LoadOp::Load}});
  pass.set_pipeline(pipeline({.name = saturated}));
  pass.set_bind_group(0, group(nothing_, std::span(&layer, 1)));
  pass.draw(3);
  pass.end();
}

} // namespace mote::passes
