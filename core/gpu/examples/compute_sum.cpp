// SPDX-License-Identifier: MIT
// The smallest compute program: adds the numbers 1..n on the device and checks the sum.
// Links mote_gpu and mote_shader_compiler, nothing else of mote. Exit status 0 if the sum is right.
#include "core/gpu/gpu.hpp"
#include "core/gpu/shader_compiler.hpp"

#include <cstdio>
#include <cstring>
#include <numeric>

namespace gpu = mote::gpu;

const char* const shader_text = R"(#version 450
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer Numbers { uint numbers[]; };
layout(set = 0, binding = 1) buffer Sum { uint sum; };
layout(push_constant) uniform Push { uint count; };
void main() {
  if (gl_GlobalInvocationID.x < count) atomicAdd(sum, numbers[gl_GlobalInvocationID.x]);
}
)";

int main() {
  gpu::Error error;
  const gpu::Instance instance = gpu::Instance::create({.application = "compute_sum"}, error);
  const gpu::Adapter adapter = instance.request_adapter({}, error);
  gpu::Device device = adapter.request_device({}, error);
  if (!device) {
    std::fprintf(stderr, "%s\n", gpu::to_string(error).c_str());
    return 1;
  }
  const gpu::CompiledShader compiled = gpu::compile_glsl(gpu::ShaderStage::Compute, {"sum.comp", shader_text});
  const gpu::ShaderModule module = device.create_shader_module({.label = "sum", .spirv = compiled.spirv});

  const gpu::BindGroupLayoutEntry entries[] = {
      {.binding = 0, .visibility = gpu::ShaderStage::Compute, .type = gpu::BindingType::ReadOnlyStorageBuffer},
      {.binding = 1, .visibility = gpu::ShaderStage::Compute, .type = gpu::BindingType::StorageBuffer}};
  const gpu::BindGroupLayout group_layout = device.create_bind_group_layout({.label = "sum", .entries = entries});
  const gpu::BindGroupLayout* layouts[] = {&group_layout};
  const gpu::PipelineLayout layout = device.create_pipeline_layout({.bind_group_layouts = layouts, .push_constant_size = 4});
  const gpu::ComputePipeline pipeline = device.create_compute_pipeline({.label = "sum", .layout = &layout, .compute = {.module = &module}});

  std::vector<std::uint32_t> numbers(1000);
  std::iota(numbers.begin(), numbers.end(), 1u);
  const gpu::Buffer in = device.create_buffer({.label = "numbers",
                                               .size = numbers.size() * 4,
                                               .usage = gpu::BufferUsage::Storage,
                                               .contents = std::as_bytes(std::span(numbers))});
  const gpu::Buffer out = device.create_buffer(
      {.label = "sum", .size = 4, .usage = gpu::BufferUsage::Storage | gpu::BufferUsage::CopySrc | gpu::BufferUsage::CopyDst});
  const gpu::BindGroupEntry bindings[] = {{.binding = 0, .buffer = {.buffer = &in}}, {.binding = 1, .buffer = {.buffer = &out}}};
  const gpu::BindGroup group = device.create_bind_group({.label = "sum", .layout = &group_layout, .entries = bindings});

  gpu::CommandEncoder encoder = device.create_command_encoder("sum");
  encoder.clear_buffer(out);
  gpu::ComputePass pass = encoder.begin_compute_pass({.label = "sum"});
  pass.set_pipeline(pipeline);
  pass.set_bind_group(0, group);
  const auto count = static_cast<std::uint32_t>(numbers.size());
  pass.set_push_constants(0, std::as_bytes(std::span(&count, 1)));
  pass.dispatch((count + 63) / 64);
  pass.end();
  device.queue().submit(encoder.finish());

  std::uint32_t sum = 0;
  const auto bytes = device.read_buffer(out); // waits
  std::memcpy(&sum, bytes.data(), sizeof sum);
  std::printf("1 + 2 + ... + %u = %u on %s\n", count, sum, adapter.info().name.c_str());
  return sum == count * (count + 1) / 2 ? 0 : 1;
}
