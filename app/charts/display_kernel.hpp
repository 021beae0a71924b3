// SPDX-License-Identifier: MIT
// The GLSL of a display transform over an array of colors in a compute shader, its tables bound as the display pass binds them.
#pragma once

#include "app/library/device.hpp"
#include "core/color/display_transform.hpp"

#include <span>
#include <vector>

namespace mote::app {

class DisplayKernel {
public:
  // `glsl` made with set 1 and first binding 2. Throws Failure A007 where it does not compile or the device refuses it.
  DisplayKernel(DrawingDevice& device, const DisplayGlsl& glsl);
  std::vector<float> run(std::span<const float> rgba);
  double nanoseconds(std::span<const float> rgba); // a color, reading and writing it included; the least of five

private:
  void upload(const std::vector<DisplayLut>& luts);
  void make_pipeline(const std::vector<std::uint32_t>& spirv, const std::vector<DisplayLut>& luts);
  double milliseconds(const gpu::BindGroup& group, std::size_t colors);
  gpu::BindGroup bind(std::span<const float> rgba);

  DrawingDevice& device_;
  std::vector<gpu::Texture> textures_{};
  std::vector<gpu::TextureView> views_{};
  std::vector<gpu::Sampler> samplers_{};
  gpu::BindGroupLayout color_layout_{};
  gpu::BindGroup lut_group_{};
  gpu::ComputePipeline pipeline_{};
  gpu::Buffer in_{}, out_{};
};

} // namespace mote::app
