// SPDX-License-Identifier: MIT
#include "passes/sampling/accumulator.hpp"

#include "passes/full_screen.hpp"
#include "passes/scratch.hpp"

#include <array>

namespace mote::passes {

using gpu::TextureFormat;

Accumulator::Accumulator(gpu::Device device, std::uint32_t samples) : device_(std::move(device)) {
  const std::array entries{gpu::BindGroupLayoutEntry{.binding = 0, .visibility = gpu::ShaderStage::Fragment, .type = gpu::BindingType::SampledTexture,
                                                     .sample_type = gpu::SampleType::UnfilterableFloat}};
  layout_ = device_.create_bind_group_layout({.label = "samples", .entries = entries});
  const std::array<const gpu::BindGroupLayout*, 1> layouts{&layout_};
  pipeline_layout_ = device_.create_pipeline_layout({.label = "samples", .bind_group_layouts = layouts});
  const std::array constants{gpu::spec(0, 1.0f / static_cast<float>(samples))};
  const gpu::BlendComponent sum{gpu::BlendFactor::One, gpu::BlendFactor::One, gpu::BlendOperation::Add};
  const std::array targets{gpu::ColorTargetState{.format = TextureFormat::RGBA32Float, .blend = gpu::BlendState{sum, sum}}};
  add_ = full_screen_pipeline(device_, {.label = "samples.add", .layout = &pipeline_layout_, .fragment = "post/accumulate.frag",
                                        .constants = constants, .targets = targets});
}

void Accumulator::update(std::uint32_t width, std::uint32_t height) {
  const gpu::Extent3d size{width, height, 1};
  const auto group = [&](const gpu::TextureView& view) {
    const std::array entries{gpu::BindGroupEntry{.binding = 0, .texture = &view}};
    return device_.create_bind_group({.label = "samples", .layout = &layout_, .entries = entries});
  };
  if (make_scratch(device_, picture_, "samples.picture", size, TextureFormat::RGBA16Float)) {
    picture_view_ = picture_.create_view();
    picture_group_ = group(picture_view_);
  }
  if (make_scratch(device_, depth_, "samples.depth", size, TextureFormat::Depth32Float)) depth_view_ = depth_.create_view();
  if (make_scratch(device_, sum_, "samples.sum", size, TextureFormat::RGBA32Float)) {
    sum_view_ = sum_.create_view();
    sum_group_ = group(sum_view_);
  }
}

void Accumulator::add(gpu::CommandEncoder& encoder, bool first) {
  const std::array colors{gpu::ColorAttachment{.view = &sum_view_, .load = first ? gpu::LoadOp::Clear : gpu::LoadOp::Load, .clear = {0, 0, 0, 0}}};
  gpu::RenderPass pass = encoder.begin_render_pass({.label = "samples.add", .colors = colors});
  pass.set_pipeline(add_);
  pass.set_bind_group(0, picture_group_);
  pass.draw(3);
  pass.end();
}

void Accumulator::resolve(gpu::CommandEncoder& encoder, const gpu::TextureView& target) {
  if (!resolve_ || target_ != target.format()) {
    target_ = target.format();
    const std::array targets{gpu::ColorTargetState{.format = target_}};
    resolve_ = full_screen_pipeline(device_, {.label = "samples.resolve", .layout = &pipeline_layout_, .fragment = "post/straight_alpha.frag",
                                              .constants = {}, .targets = targets});
  }
  const std::array colors{gpu::ColorAttachment{.view = &target, .load = gpu::LoadOp::DontCare}};
  gpu::RenderPass pass = encoder.begin_render_pass({.label = "samples.resolve", .colors = colors});
  pass.set_pipeline(resolve_);
  pass.set_bind_group(0, sum_group_);
  pass.draw(3);
  pass.end();
}

} // namespace mote::passes
