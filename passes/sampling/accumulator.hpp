// SPDX-License-Identifier: MIT
// Averages pictures of one pass drawn at several sample offsets, in scene-linear light with
// premultiplied alpha: what a display transform makes of the average is right at edges, an average of
// displayed pictures is not. Owned by a drawing pass with more than one sample a pixel.
//
//   accumulator.update(size);
//   for each offset: draw into accumulator.picture() (and depth()), then accumulator.add(encoder, first)
//   accumulator.resolve(encoder, color view of the pass, its format)
#pragma once

#include "core/gpu/gpu.hpp"

#include <cstdint>

namespace mote::passes {

class Accumulator {
public:
  Accumulator(gpu::Device device, std::uint32_t samples);

  void update(std::uint32_t width, std::uint32_t height); // Throws Failure G071
  [[nodiscard]] const gpu::TextureView& picture() const { return picture_view_; } // rgba16float, straight alpha
  [[nodiscard]] const gpu::Texture& texture() const { return picture_; }           // of picture(); may be copied to
  [[nodiscard]] const gpu::TextureView& depth() const { return depth_view_; }     // depth32float
  void add(gpu::CommandEncoder& encoder, bool first);
  void resolve(gpu::CommandEncoder& encoder, const gpu::TextureView& target);

private:

  gpu::Device device_;
  gpu::Texture picture_, depth_, sum_;
  gpu::TextureView picture_view_, depth_view_, sum_view_;
  gpu::BindGroupLayout layout_;
  gpu::PipelineLayout pipeline_layout_;
  gpu::RenderPipeline add_, resolve_;
  gpu::TextureFormat target_{};
  gpu::BindGroup picture_group_, sum_group_;
};

} // namespace mote::passes
