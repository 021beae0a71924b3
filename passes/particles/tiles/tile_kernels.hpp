// SPDX-License-Identifier: MIT
// Pipelines and layouts of the compute expansion's kernels, made when first asked for and kept.
//
// Sets: 0 the frame block; 1 the records of a slice (place) or what casting reads and writes (cast); 2 the
// buffers of binning (cull, place, allocate, scatter, far).
#pragma once

#include "core/gpu/gpu.hpp"
#include "passes/particles/pipelines.hpp"
#include "passes/shadows/tile_shadows.hpp"
#include "render_graph/pass.hpp"

#include <compare>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace mote::passes {

struct CastKey {
  ParticlePipelineKey drawing{}; // type, phase, aovs, projection, lights, model, colors, slack; the rest of it is not looked at
  bool one_material{}, want_depth{}, display_only{};
  std::uint32_t color_words{2};  // of a pixel: 1 rgba8unorm, 2 rgba16float, 4 rgba32float; 0: no color
  std::string pixel_map{};       // id of the map that is applied to the color; empty: none
  TileShadows::Key shadows{};
  auto operator<=>(const CastKey&) const = default;
};

class TileKernels {
public:
  TileKernels(gpu::Device device, const gpu::BindGroupLayout& frame);
  // Invocations of a workgroup that casts: the widest variant that no subgroup of the device is narrower than; 0: the
  // device has no subgroup operations, or narrower ones than any variant.
  [[nodiscard]] static std::uint32_t lanes(const gpu::Device& device);

  [[nodiscard]] const gpu::ComputePipeline& kernel(const std::string& name); // "cull", "allocate", "scatter", "far"
  [[nodiscard]] const gpu::ComputePipeline& place(const ParticlePipelineKey& key, bool first_round, bool first_slice);
  // What a cast takes in besides, each may be null: the map that key.pixel_map names, the shadows of key.shadows. Their
  // shader is compiled now (P002) or comes from the cache.
  struct Besides {
    const rg::PixelMap* map{};
    const TileShadows* shadows{};
    std::string cache_directory{};
    [[nodiscard]] std::uint32_t shadow_set() const { return map && map->layout ? rg::PixelMap::set + 1 : 2; }
  };
  [[nodiscard]] const gpu::ComputePipeline& cast(const CastKey& key, const Besides& besides);
  [[nodiscard]] const gpu::BindGroupLayout& slice_layout() const { return slice_; }
  [[nodiscard]] const gpu::BindGroupLayout& binning_layout() const { return binning_; }
  [[nodiscard]] const gpu::BindGroupLayout& cast_layout() const { return cast_; }

private:
  gpu::ComputePipeline make(const std::string& shader, const gpu::PipelineLayout& layout, std::span<const gpu::SpecializationConstant> constants,
                            std::span<const std::uint32_t> words = {});

  gpu::Device device_;
  std::string words_; // "int64": buffers are read two words at a time, which needs the feature; else "int32"
  gpu::BindGroupLayout frame_, slice_, binning_, cast_;
  gpu::PipelineLayout binning_pipelines_, cast_pipelines_;
  std::map<std::string, gpu::ComputePipeline> kernels_;
  std::map<std::tuple<ParticlePipelineKey, bool, bool>, gpu::ComputePipeline> places_;
  std::map<CastKey, gpu::ComputePipeline> casts_;
};

} // namespace mote::passes
