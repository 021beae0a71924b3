// SPDX-License-Identifier: MIT
// A method's arithmetic on the device: a compute kernel of shaders/charts over an array of items, its results and what an
// item costs. So the driver's arithmetic is what charts show. Shaders: shaders/charts/kernel.glsl.
#pragma once

#include "app/library/device.hpp"
#include "core/gpu/shader_compiler.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mote::app {

class Kernel {
public:
  // `path` below shaders/. Throws Failure P002 (does not compile), A007.
  Kernel(DrawingDevice& device, const std::string& path, std::span<const gpu::ShaderDefine> defines = {});

  // `count` items, of each `vec4s_made` results of four floats.
  std::vector<float> run(std::span<const float> given, std::uint32_t count, std::uint32_t vec4s_made);
  // Nanoseconds that one more repetition of an item costs: the least of nine, launch and memory taken out.
  double nanoseconds(std::span<const float> given, std::uint32_t count, std::uint32_t vec4s_made);

private:
  double milliseconds(const gpu::BindGroup& group, std::uint32_t count, std::uint32_t repeats);
  struct Bound {
    gpu::Buffer in{}, out{};
    gpu::BindGroup group{};
  };
  Bound bind(std::span<const float> given, std::uint32_t count, std::uint32_t vec4s_made);

  DrawingDevice& device_;
  gpu::BindGroupLayout layout_{};
  gpu::ComputePipeline pipeline_{};
};

// Whether fma() of this device is fused.
bool has_fused_fma(DrawingDevice& device);

} // namespace mote::app
