// SPDX-License-Identifier: MIT
// Analytic edges by tiles: particles thinner than a pixel are widened so that none is missed, casts keep each pixel's particle
// (winners.glsl), and at the end pixels at outlines are listed (outlines.comp) and composited of what those around them truly
// cover (edges.comp). TileRenderer is the one that calls this.
//
// AOVs of such a picture would be those of widened particles; a pass draws them without edges.
#pragma once

#include "core/gpu/gpu.hpp"
#include "passes/particles/tiles/tile_blocks.hpp"
#include "passes/particles/tiles/tile_kernels.hpp"

#include <map>
#include <string>

namespace mote::passes {

class TileEdges {
public:
  // Pixels: the least radius that particles are drawn with, so that each has a pixel center (half a diagonal and rounding).
  static constexpr float slack = 0.7075f;
  static constexpr double margin = 0.71; // of placing

  TileEdges(gpu::Device device, const gpu::BindGroupLayout& frame);
  // A picture of `pixels`; before recording.
  void reserve(std::uint64_t pixels);
  [[nodiscard]] const gpu::Buffer& colors() const { return colors_; } // bound by casts
  // What casts have left, and what pixels at outlines are written to, in the layout of tiles: words of a pixel 1, or 2 and 4.
  struct Buffers {
    const gpu::Buffer& names;
    const gpu::Buffer& payloads;
    const gpu::Buffer& narrow;
    const gpu::Buffer& wide;
  };
  void clear(gpu::CommandEncoder& encoder, const gpu::Buffer& names);
  // After all casts. `block`: width and height. `map`: may be null; its shader is compiled now (P002) or comes from the cache.
  void record(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame_group, StepBlock block, gpu::Color background, const CastKey& key, const Buffers& buffers,
              const rg::PixelMap* map, const std::string& cache_directory);

private:
  const gpu::ComputePipeline& pipeline(const CastKey& key, const rg::PixelMap* map, const std::string& cache_directory);

  gpu::Device device_;
  gpu::BindGroupLayout frame_, layout_;
  gpu::PipelineLayout pipelines_layout_;
  gpu::ComputePipeline outlines_;
  gpu::Buffer colors_, listed_, arguments_, indirect_;
  std::map<CastKey, gpu::ComputePipeline> pipelines_;
};

} // namespace mote::passes
