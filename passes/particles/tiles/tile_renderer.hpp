// SPDX-License-Identifier: MIT
// The compute expansion: draws one view's chunks by tiles of 8x8 pixels, in compute kernels, into buffers that are then
// copied into the pass's textures. shaders/particles/tiles/work.glsl tells how a frame runs; tile_plan.hpp how it is cut.
//
// Keeps which chunks were seen, from one frame to the next; nothing else. A stale memory (a camera cut, another scene)
// costs time and never changes the picture. Buffers grow with what is in view and are bounded by the plan.
#pragma once

#include "core/gpu/gpu.hpp"
#include "passes/particles/particle_store.hpp"
#include "passes/particles/tiles/tile_kernels.hpp"
#include "passes/particles/tiles/tile_plan.hpp"

#include <functional>
#include <string_view>
#include <vector>

namespace mote::passes {

// Where pictures go: textures that may be copied to; an invalid one is left out. All of the view's size.
// Phase Surface: color, id and normal are those of SurfaceShading. Phase Shadow: casters, or encoded_depth alone.
struct TileTargets {
  gpu::Texture color{}, encoded_depth{}, depth{}, id{}, normal{};
  gpu::Texture casters{};          // as shadows/shadow_maps.hpp says: payloads and ids, a layer each
  bool casters_stay{};             // instead, they are left in casters()
  gpu::Color background{};         // scene-linear
  const rg::PixelMap* map{};       // applied to colors and background; `color` is then what the map's pass would write
  bool edges{};                    // analytic ones, of color: nothing else is drawn then (layers.glsl)
  const TileShadows* shadows{};    // of lights; null: no light has a map
  std::string cache_directory{};   // of SPIR-V; empty: none
};

class TileRenderer {
public:
  TileRenderer(gpu::Device device, const gpu::BindGroupLayout& frame);
  // Whether this device can, with these targets' color format.
  [[nodiscard]] static bool works(const gpu::Device& device, gpu::TextureFormat color);

  // Uploads; before the encoder's passes. Sorts view.chunks by depth. `view` must live until record(). `gather`: TilePlan::gathered
  // where it can be.
  void update(TiledView& view, std::uint32_t width, std::uint32_t height, bool gather);
  // Records everything, the copies to the targets included. `key`: the scene's needs, with the phase.
  // `mark` is told the end of each stage.
  using Mark = std::function<void(std::string_view stage)>;
  void record(gpu::CommandEncoder& encoder, const TiledView& view, const gpu::BindGroup& frame_group, const ParticlePipelineKey& key,
              const TileTargets& targets, const Mark& mark);

  // With casters_stay, until the next record().
  [[nodiscard]] MapInBuffers::Buffers casters() const { return {by_id_ ? buffers_.casters : buffers_.normal, buffers_.id, by_id_}; }

private:
  struct Buffers {
    gpu::Buffer chunks{}, draws{}, materials{}, flags{}, lists{}, arguments{}, argument_template{}, indirect{}, payloads{}, colors{}, ids{}, tiles{},
        far{}, active{}, entries{}, nearest{}, back_colors{}, splats{}, splat_lists{}, color{}, unused_color{}, background{}, encoded{}, depth{}, id{}, normal{}, casters{};
  };
  bool reserve(gpu::Buffer& buffer, std::string_view label, std::uint64_t bytes, gpu::BufferUsage usage);
  void reserve_frame(const ParticlePipelineKey& key, const TileTargets& targets);
  void make_groups(const TiledView& view);
  void list_splats(const TiledView& view);
  void record_splats(gpu::CommandEncoder& encoder, const StepBlock& block, const gpu::BindGroup& frame_group, const ParticlePipelineKey& placed, const Mark& mark);
  void record_splat_far(gpu::CommandEncoder& encoder, const StepBlock& block, const gpu::BindGroup& frame_group, bool orthographic, const Mark& mark);
  void resolve_splats(gpu::CommandEncoder& encoder, const TiledView& view, const gpu::BindGroup& frame_group, CastKey key, const TileTargets& targets, const Mark& mark);
  void set_shading_groups(gpu::ComputePass& pass, const TileTargets& targets, const TileKernels::Besides& besides) const;
  void clear(gpu::CommandEncoder& encoder, const TileTargets& targets);
  void record_step(gpu::CommandEncoder& encoder, std::size_t index, const TiledView& view, const gpu::BindGroup& frame_group, const CastKey& key,
                   const TileTargets& targets, const Mark& mark);
  void copy_out(gpu::CommandEncoder& encoder, const TileTargets& targets);

  gpu::Device device_;
  TileKernels kernels_;
  TilePlan plan_{};
  Buffers buffers_{};
  std::vector<std::uint32_t> arguments_{}, regions_{}; // the template of all steps' arguments; where each step's start
  std::vector<TileChunk> scratch_{};
  StepBlock block_{};
  std::vector<gpu::BindGroup> slice_groups_{}, resolve_groups_{};
  std::vector<std::uint32_t> splats_{}; // chunks drawn by splats, for each slice and side
  std::uint64_t ids_{};                 // of the scene
  bool by_id_{};                        // casters that stay are kept by their ids
  bool splats_alone_{};                 // nothing is cast, and there is one slice
  gpu::BindGroup binning_group_{}, cast_group_{}, splat_far_group_{};
  std::vector<std::uint32_t> background_words_{};
  std::uint32_t color_words_{2};
  bool first_{}; // nothing was cast before in the frame that is being recorded
  bool flags_fresh_{}, tiles_fresh_{true};
  std::uint32_t anew_{}; // which chunks look anew at what is seen of them, of 8
  std::uint32_t tiles_of_{}; // how many tiles the buffer of tiles was laid out for: its parts lie elsewhere for another number
};

} // namespace mote::passes
