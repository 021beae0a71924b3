// SPDX-License-Identifier: MIT
// Pipelines and layouts of the compute expansion's kernels, made when first asked for and kept.
//
// Sets: 0 the frame block; 1 the records of a slice (place) or what casting reads and writes (cast); 2 the
// buffers of binning (cull, sift, place, splat, allocate, scatter, far). resolve_splats and splat_far have a set 1 of their own.
#pragma once

#include "core/gpu/gpu.hpp"
#include "passes/particles/pipelines.hpp"
#include "passes/shadows/tile_shadows.hpp"
#include "render_graph/pass.hpp"

#include <compare>
#include <map>
#include <string>
#include <vector>

namespace mote::passes {

struct CastKey {
  ParticlePipelineKey drawing{}; // type, phase, aovs, projection, lights, model, colors, slack; the rest of it is not looked at
  bool one_material{}, want_depth{}, display_only{};
  bool keep_layers{};            // with drawing.edges: tiles are cast several times with different particles (layers.glsl)
  bool by_id{};                  // phase Shadow: as PlaceKey says
  std::uint32_t color_words{2};  // of a pixel: 1 rgba8unorm, 2 rgba16float, 4 rgba32float; 0: no color
  std::string pixel_map{};       // id of the map that is applied to the color; empty: none
  TileShadows::Key shadows{};
  auto operator<=>(const CastKey&) const = default;
};

struct PlaceKey {
  ParticlePipelineKey drawing{};
  bool untested{};    // by the depth so far
  bool first_slice{};
  bool by_id{};       // a shadow map's casters are kept by their ids
  auto operator<=>(const PlaceKey&) const = default;
};

class TileKernels {
public:
  TileKernels(gpu::Device device, const gpu::BindGroupLayout& frame);
  // Invocations of a workgroup that casts: the widest variant that no subgroup of the device is narrower than; 0: the
  // device has no subgroup operations, or narrower ones than any variant.
  [[nodiscard]] static std::uint32_t lanes(const gpu::Device& device);
  // Whether small particles of a type are drawn by splats: needs atomic minima of 64 bits.
  [[nodiscard]] static bool splats(const gpu::Device& device, const std::string& type);

  [[nodiscard]] const gpu::ComputePipeline& kernel(const std::string& name); // "cull", "allocate", "scatter", "far"
  [[nodiscard]] const gpu::ComputePipeline& place(const PlaceKey& key);
  [[nodiscard]] const gpu::ComputePipeline& sift(const ParticlePipelineKey& key);
  // What a cast takes in besides, each may be null: the map that key.pixel_map names, the shadows of key.shadows. Their
  // shader is compiled now (P002) or comes from the cache.
  struct Besides {
    const rg::PixelMap* map{};
    const TileShadows* shadows{};
    std::string cache_directory{};
    [[nodiscard]] std::uint32_t shadow_set() const { return map && map->layout ? rg::PixelMap::set + 1 : 2; }
  };
  [[nodiscard]] const gpu::ComputePipeline& cast(const CastKey& key, const Besides& besides) { return shading(key, besides, Shading::Cast); }
  // `side`: pixels, 1 to splat_sides. `alone`: nothing is cast in this frame, and there is one slice.
  [[nodiscard]] const gpu::ComputePipeline& splat(const ParticlePipelineKey& key, std::uint32_t side);
  [[nodiscard]] const gpu::ComputePipeline& splat_far(bool orthographic, bool alone);
  [[nodiscard]] const gpu::ComputePipeline& resolve_splats(const CastKey& key, const Besides& besides, bool alone) {
    return shading(key, besides, alone ? Shading::SplatsAlone : Shading::Splats);
  }
  [[nodiscard]] const gpu::BindGroupLayout& slice_layout() const { return slice_; }
  [[nodiscard]] const gpu::BindGroupLayout& binning_layout() const { return binning_; }
  [[nodiscard]] const gpu::BindGroupLayout& cast_layout() const { return cast_; }
  [[nodiscard]] const gpu::BindGroupLayout& splat_far_layout() const { return splat_far_; }
  [[nodiscard]] const gpu::BindGroupLayout& resolve_layout() const { return resolve_; } // of splats, a group for each slice

private:
  enum class Shading { Cast, Splats, SplatsAlone };
  const gpu::ComputePipeline& shading(const CastKey& key, const Besides& besides, Shading what);
  gpu::ComputePipeline make(const std::string& shader, const gpu::PipelineLayout& layout, std::span<const gpu::SpecializationConstant> constants,
                            std::span<const std::uint32_t> words = {});

  gpu::Device device_;
  std::string words_; // "int64": buffers are read two words at a time, which needs the feature; else "int32"
  gpu::BindGroupLayout frame_, slice_, binning_, cast_, resolve_, splat_far_;
  gpu::PipelineLayout binning_pipelines_, cast_pipelines_, resolve_pipelines_, far_pipelines_;
  std::map<std::string, gpu::ComputePipeline> kernels_;
  std::map<PlaceKey, gpu::ComputePipeline> places_;
  std::map<ParticlePipelineKey, gpu::ComputePipeline> sifts_;
  std::map<std::pair<ParticlePipelineKey, std::uint32_t>, gpu::ComputePipeline> splats_;
  std::map<std::pair<bool, bool>, gpu::ComputePipeline> splat_fars_;
  std::map<std::pair<CastKey, Shading>, gpu::ComputePipeline> shadings_;
};

} // namespace mote::passes
