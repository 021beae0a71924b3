// SPDX-License-Identifier: MIT
#include "app/charts/kernel.hpp"

#include "passes/runtime_shaders.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>

namespace mote::app {

Kernel::Kernel(DrawingDevice& device, const std::string& path, std::span<const gpu::ShaderDefine> defines) : device_(device) {
  gpu::Device& gpu_device = device.device();
  const std::vector<std::uint32_t> spirv = passes::compile_shader(path, {}, cache_directory(), defines);
  constexpr auto visible = gpu::ShaderStage::Compute;
  const std::array places{gpu::BindGroupLayoutEntry{.binding = 0, .visibility = visible, .type = gpu::BindingType::ReadOnlyStorageBuffer},
                          gpu::BindGroupLayoutEntry{.binding = 1, .visibility = visible, .type = gpu::BindingType::StorageBuffer}};
  layout_ = gpu_device.create_bind_group_layout({.label = path, .entries = places});
  const std::array layouts{static_cast<const gpu::BindGroupLayout*>(&layout_)};
  const gpu::PipelineLayout pipeline_layout = gpu_device.create_pipeline_layout({.label = path, .bind_group_layouts = layouts, .push_constant_size = 8});
  const gpu::ShaderModule module = gpu_device.create_shader_module({.label = path, .spirv = spirv});
  pipeline_ = gpu_device.create_compute_pipeline({.label = path, .layout = &pipeline_layout, .compute = {.module = &module}});
  device.check();
}

Kernel::Bound Kernel::bind(std::span<const float> given, std::uint32_t count, std::uint32_t vec4s_made) {
  gpu::Device& device = device_.device();
  Bound b;
  b.in = device.create_buffer({.label = "given", .size = given.size_bytes(), .usage = gpu::BufferUsage::Storage, .contents = std::as_bytes(given)});
  b.out = device.create_buffer({.label = "made", .size = std::uint64_t{16} * count * vec4s_made, .usage = gpu::BufferUsage::Storage | gpu::BufferUsage::CopySrc});
  const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {.buffer = &b.in}}, gpu::BindGroupEntry{.binding = 1, .buffer = {.buffer = &b.out}}};
  b.group = device.create_bind_group({.label = "kernel", .layout = &layout_, .entries = entries});
  return b;
}

double Kernel::milliseconds(const gpu::BindGroup& group, std::uint32_t count, std::uint32_t repeats) {
  const std::array<std::uint32_t, 2> push{count, repeats};
  gpu::CommandEncoder encoder = device_.device().create_command_encoder("kernel");
  gpu::ComputePass pass = encoder.begin_compute_pass({.label = "kernel"});
  pass.set_pipeline(pipeline_);
  pass.set_bind_group(0, group);
  pass.set_push_constants(0, std::as_bytes(std::span(push)));
  pass.dispatch((count + 63) / 64);
  pass.end();
  const gpu::CommandBuffer commands = encoder.finish();
  gpu::Queue queue = device_.device().queue();
  const auto start = std::chrono::steady_clock::now();
  queue.wait(queue.submit(commands));
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::vector<float> Kernel::run(std::span<const float> given, std::uint32_t count, std::uint32_t vec4s_made) {
  const Bound b = bind(given, count, vec4s_made);
  milliseconds(b.group, count, 1);
  const std::vector<std::byte> bytes = device_.device().read_buffer(b.out);
  device_.check();
  std::vector<float> out(bytes.size() / sizeof(float));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

double Kernel::nanoseconds(std::span<const float> given, std::uint32_t count, std::uint32_t vec4s_made) {
  constexpr std::uint32_t repeats = 129;
  const Bound b = bind(given, count, vec4s_made);
  double once = INFINITY, often = INFINITY;
  for (int k = 0; k < 9; ++k) {
    once = std::min(once, milliseconds(b.group, count, 1));
    often = std::min(often, milliseconds(b.group, count, repeats));
  }
  device_.check();
  return std::max(0.0, often - once) * 1e6 / (double(count) * (repeats - 1));
}

bool has_fused_fma(DrawingDevice& device) {
  const std::array<float, 4> given{1.0f + 0x1p-12f, 1.0f + 0x1p-12f, -(1.0f + 0x1p-11f), 0.0f};
  return Kernel(device, "charts/fused.comp").run(given, 1, 1)[0] > 0.0f;
}

} // namespace mote::app
