// SPDX-License-Identifier: MIT
#include "app/charts/display_kernel.hpp"

#include "app/codes.hpp"
#include "core/gpu/shader_compiler.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>

namespace mote::app {

DisplayKernel::DisplayKernel(DrawingDevice& device, const DisplayGlsl& glsl) : device_(device) {
  const std::string text = "#version 450\nlayout(local_size_x = 64) in;\n"
                           "layout(set = 0, binding = 0, std430) readonly buffer In { vec4 from[]; };\n"
                           "layout(set = 0, binding = 1, std430) buffer Out { vec4 to[]; };\n" +
                           glsl.text +
                           "void main() {\n  uint i = gl_GlobalInvocationID.x;\n  if (i < from.length()) to[i] = mote_display(from[i]);\n}\n";
  const gpu::CompiledShader shader = gpu::SpirvCache(cache_directory()).compile(gpu::ShaderStage::Compute, {.name = "display.comp", .text = text});
  if (!shader) fail(Exit::Failed, code::device_failed, {}, "the display transform does not compile", {shader.messages.empty() ? "" : to_string(shader.messages.front())});
  upload(glsl.luts);
  make_pipeline(shader.spirv, glsl.luts);
  device.check();
}

void DisplayKernel::upload(const std::vector<DisplayLut>& luts) {
  gpu::Device& device = device_.device();
  for (const DisplayLut& lut : luts) {
    const bool rg = lut.format == DisplayLut::Format::RG32Float;
    const gpu::Extent3d size{lut.width, lut.height, lut.depth};
    textures_.push_back(device.create_texture({.label = lut.name,
                                               .size = size,
                                               .format = rg ? gpu::TextureFormat::RG32Float : gpu::TextureFormat::RGBA32Float,
                                               .usage = gpu::TextureUsage::Sampled | gpu::TextureUsage::CopyDst,
                                               .dimension = lut.volume ? gpu::TextureDimension::D3 : gpu::TextureDimension::D2}));
    device.queue().write_texture({.texture = &textures_.back()}, std::as_bytes(std::span(lut.data)), lut.width * (rg ? 8 : 16), lut.height, size);
    views_.push_back(textures_.back().create_view());
    const auto filter = lut.linear ? gpu::FilterMode::Linear : gpu::FilterMode::Nearest;
    samplers_.push_back(device.create_sampler({.label = lut.name, .mag_filter = filter, .min_filter = filter}));
  }
}

void DisplayKernel::make_pipeline(const std::vector<std::uint32_t>& spirv, const std::vector<DisplayLut>& luts) {
  using gpu::BindingType;
  gpu::Device& device = device_.device();
  constexpr auto visible = gpu::ShaderStage::Compute;
  const std::array colors{gpu::BindGroupLayoutEntry{.binding = 0, .visibility = visible, .type = BindingType::ReadOnlyStorageBuffer},
                          gpu::BindGroupLayoutEntry{.binding = 1, .visibility = visible, .type = BindingType::StorageBuffer}};
  color_layout_ = device.create_bind_group_layout({.label = "colors", .entries = colors});
  std::vector<gpu::BindGroupLayoutEntry> places;
  std::vector<gpu::BindGroupEntry> entries;
  for (std::size_t i = 0; i < luts.size(); ++i) {
    places.push_back({.binding = luts[i].texture_binding,
                      .visibility = visible,
                      .type = BindingType::SampledTexture,
                      .sample_type = luts[i].linear ? gpu::SampleType::Float : gpu::SampleType::UnfilterableFloat,
                      .view_dimension = luts[i].volume ? gpu::TextureViewDimension::D3 : gpu::TextureViewDimension::D2});
    places.push_back({.binding = luts[i].sampler_binding, .visibility = visible, .type = BindingType::Sampler});
    entries.push_back({.binding = luts[i].texture_binding, .texture = &views_[i]});
    entries.push_back({.binding = luts[i].sampler_binding, .sampler = &samplers_[i]});
  }
  std::vector<const gpu::BindGroupLayout*> layouts{&color_layout_};
  gpu::BindGroupLayout lut_layout;
  if (!luts.empty()) {
    lut_layout = device.create_bind_group_layout({.label = "luts", .entries = places});
    layouts.push_back(&lut_layout);
    lut_group_ = device.create_bind_group({.label = "luts", .layout = &lut_layout, .entries = entries});
  }
  const gpu::PipelineLayout layout = device.create_pipeline_layout({.label = "display", .bind_group_layouts = layouts});
  const gpu::ShaderModule module = device.create_shader_module({.label = "display", .spirv = spirv});
  pipeline_ = device.create_compute_pipeline({.label = "display", .layout = &layout, .compute = {.module = &module}});
}

gpu::BindGroup DisplayKernel::bind(std::span<const float> rgba) {
  gpu::Device& device = device_.device();
  in_ = device.create_buffer({.label = "in", .size = rgba.size_bytes(), .usage = gpu::BufferUsage::Storage, .contents = std::as_bytes(rgba)});
  out_ = device.create_buffer({.label = "out", .size = rgba.size_bytes(), .usage = gpu::BufferUsage::Storage | gpu::BufferUsage::CopySrc});
  const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {.buffer = &in_}}, gpu::BindGroupEntry{.binding = 1, .buffer = {.buffer = &out_}}};
  return device.create_bind_group({.label = "colors", .layout = &color_layout_, .entries = entries});
}

double DisplayKernel::milliseconds(const gpu::BindGroup& group, std::size_t colors) {
  gpu::CommandEncoder encoder = device_.device().create_command_encoder("display");
  gpu::ComputePass pass = encoder.begin_compute_pass();
  pass.set_pipeline(pipeline_);
  pass.set_bind_group(0, group);
  if (lut_group_) pass.set_bind_group(1, lut_group_);
  pass.dispatch(static_cast<std::uint32_t>((colors + 63) / 64));
  pass.end();
  const gpu::CommandBuffer commands = encoder.finish();
  gpu::Queue queue = device_.device().queue();
  const auto start = std::chrono::steady_clock::now();
  queue.wait(queue.submit(commands));
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::vector<float> DisplayKernel::run(std::span<const float> rgba) {
  milliseconds(bind(rgba), rgba.size() / 4);
  const std::vector<std::byte> bytes = device_.device().read_buffer(out_);
  device_.check();
  std::vector<float> out(rgba.size());
  std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

double DisplayKernel::nanoseconds(std::span<const float> rgba) {
  const gpu::BindGroup group = bind(rgba);
  double least = INFINITY;
  for (int k = 0; k < 6; ++k) least = std::min(least, milliseconds(group, rgba.size() / 4));
  return least * 1e6 / (static_cast<double>(rgba.size()) / 4.0);
}

} // namespace mote::app
