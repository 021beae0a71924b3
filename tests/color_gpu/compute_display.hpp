// SPDX-License-Identifier: MIT
// Runs the GLSL of a DisplayTransform over an array of colors in a compute shader, the tables bound
// as the display pass binds them. For tests and for measuring.
#pragma once

#include "core/color/display_transform.hpp"
#include "core/gpu/gpu.hpp"
#include "core/gpu/shader_compiler.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <ctime>
#include <span>
#include <string>
#include <vector>

namespace mote::test {

class ComputeDisplay {
public:
  // `call` is the GLSL expression of the result, with `c` the input color.
  ComputeDisplay(gpu::Device device, const DisplayTransform& transform,
                 const std::string& call = "mote_display(c)")
      : device_(std::move(device)) {
    const DisplayGlsl glsl = transform.glsl({.set = 1, .first_binding = 2});
    const std::string text =
        "#version 450\nlayout(local_size_x = 64) in;\n"
        "layout(set = 0, binding = 0, std430) readonly buffer In { vec4 from[]; };\n"
        "layout(set = 0, binding = 1, std430) buffer Out { vec4 to[]; };\n" +
        glsl.text +
        "void main() {\n  uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 32768u;\n"
        "  if (i >= from.length()) return;\n  vec4 c = from[i];\n  to[i] = " +
        call + ";\n}\n";
    const gpu::CompiledShader shader =
        gpu::compile_glsl(gpu::ShaderStage::Compute, {.name = "display.comp", .text = text});
    for (const auto& message : shader.messages) ADD_FAILURE() << to_string(message);
    if (!shader) throw std::runtime_error("the GLSL does not compile:\n" + text);
    upload(glsl.luts);
    make_pipeline(shader.spirv, glsl.luts);
  }

  // Straight RGBA in, display RGBA out.
  std::vector<float> operator()(std::span<const float> rgba) {
    using gpu::BufferUsage;
    const std::span bytes = std::as_bytes(rgba);
    const gpu::Buffer in = device_.create_buffer(
        {.label = "in", .size = bytes.size(), .usage = BufferUsage::Storage, .contents = bytes});
    const gpu::Buffer out = device_.create_buffer(
        {.label = "out", .size = bytes.size(), .usage = BufferUsage::Storage | BufferUsage::CopySrc});
    const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {.buffer = &in}},
                             gpu::BindGroupEntry{.binding = 1, .buffer = {.buffer = &out}}};
    const gpu::BindGroup group =
        device_.create_bind_group({.label = "colors", .layout = &color_layout_, .entries = entries});
    const auto groups = static_cast<std::uint32_t>((rgba.size() / 4 + 63) / 64);
    const double start = processor_time();
    gpu::CommandEncoder encoder = device_.create_command_encoder("display");
    gpu::ComputePass pass = encoder.begin_compute_pass();
    pass.set_pipeline(pipeline_);
    pass.set_bind_group(0, group);
    if (lut_group_) pass.set_bind_group(1, lut_group_);
    pass.dispatch(std::min(groups, 512u), (groups + 511) / 512);
    pass.end();
    gpu::Queue queue = device_.queue();
    queue.wait(queue.submit(encoder.finish()));
    milliseconds = processor_time() - start;
    const std::vector<std::byte> read = device_.read_buffer(out);
    std::vector<float> result(rgba.size());
    std::memcpy(result.data(), read.data(), read.size());
    return result;
  }

  // Processor time of this process for the last call, all threads: on lavapipe that is the shader's
  // cost, and it does not depend on what else the machine does. Two cores take about half of it.
  double milliseconds{};

private:
  static double processor_time() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
  }

  void upload(const std::vector<DisplayLut>& luts) {
    for (const DisplayLut& lut : luts) {
      const bool rg = lut.format == DisplayLut::Format::RG32Float;
      const gpu::Extent3d size{lut.width, lut.height, lut.depth};
      textures_.push_back(device_.create_texture(
          {.label = lut.name,
           .size = size,
           .format = rg ? gpu::TextureFormat::RG32Float : gpu::TextureFormat::RGBA32Float,
           .usage = gpu::TextureUsage::Sampled | gpu::TextureUsage::CopyDst,
           .dimension = lut.volume ? gpu::TextureDimension::D3 : gpu::TextureDimension::D2}));
      device_.queue().write_texture({.texture = &textures_.back()}, std::as_bytes(std::span(lut.data)),
                                    lut.width * (rg ? 8 : 16), lut.height, size);
      views_.push_back(textures_.back().create_view());
      const auto filter = lut.linear ? gpu::FilterMode::Linear : gpu::FilterMode::Nearest;
      samplers_.push_back(
          device_.create_sampler({.label = lut.name, .mag_filter = filter, .min_filter = filter}));
    }
  }

  void make_pipeline(const std::vector<std::uint32_t>& spirv, const std::vector<DisplayLut>& luts) {
    using gpu::BindingType;
    constexpr auto visible = gpu::ShaderStage::Compute;
    const std::array colors{
        gpu::BindGroupLayoutEntry{
            .binding = 0, .visibility = visible, .type = BindingType::ReadOnlyStorageBuffer},
        gpu::BindGroupLayoutEntry{.binding = 1, .visibility = visible, .type = BindingType::StorageBuffer}};
    color_layout_ = device_.create_bind_group_layout({.label = "colors", .entries = colors});
    std::vector<gpu::BindGroupLayoutEntry> places;
    std::vector<gpu::BindGroupEntry> entries;
    for (std::size_t i = 0; i < luts.size(); ++i) {
      places.push_back(
          {.binding = luts[i].texture_binding,
           .visibility = visible,
           .type = BindingType::SampledTexture,
           .sample_type = luts[i].linear ? gpu::SampleType::Float : gpu::SampleType::UnfilterableFloat,
           .view_dimension = luts[i].volume ? gpu::TextureViewDimension::D3 : gpu::TextureViewDimension::D2});
      places.push_back(
          {.binding = luts[i].sampler_binding, .visibility = visible, .type = BindingType::Sampler});
      entries.push_back({.binding = luts[i].texture_binding, .texture = &views_[i]});
      entries.push_back({.binding = luts[i].sampler_binding, .sampler = &samplers_[i]});
    }
    std::vector<const gpu::BindGroupLayout*> layouts{&color_layout_};
    const gpu::BindGroupLayout lut_layout =
        luts.empty() ? gpu::BindGroupLayout{}
                     : device_.create_bind_group_layout({.label = "luts", .entries = places});
    if (!luts.empty()) {
      layouts.push_back(&lut_layout);
      lut_group_ = device_.create_bind_group({.label = "luts", .layout = &lut_layout, .entries = entries});
    }
    const gpu::PipelineLayout layout =
        device_.create_pipeline_layout({.label = "display", .bind_group_layouts = layouts});
    const gpu::ShaderModule module = device_.create_shader_module({.label = "display", .spirv = spirv});
    pipeline_ = device_.create_compute_pipeline(
        {.label = "display", .layout = &layout, .compute = {.module = &module}});
  }

  gpu::Device device_;
  std::vector<gpu::Texture> textures_;
  std::vector<gpu::TextureView> views_;
  std::vector<gpu::Sampler> samplers_;
  gpu::BindGroupLayout color_layout_;
  gpu::BindGroup lut_group_;
  gpu::ComputePipeline pipeline_;
};

} // namespace mote::test
