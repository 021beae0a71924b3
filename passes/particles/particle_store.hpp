// SPDX-License-Identifier: MIT
// The particles of a scene on the device, shared by all passes. Chunk sets are uploaded once and
// kept while a scene uses them; buffers beyond the device's binding limit are split into slices.
//
// place() brings the origin of every (chunk, instance) that a view may see into its view space, in
// double on the CPU, each frame (contracts, "Placement"): shaders see view-space numbers only. What
// comes back are draws, ready to record in scene order.
//
// Called from Pass::update(); one thread.
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/scene/scene.hpp"
#include "passes/particles/tiles/tile_blocks.hpp"
#include "passes/shadows/shadow_maps.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace mote::passes {

// Push constants of a draw; mirrors BatchBlock of shaders/particles/particle.glsl.
struct BatchBlock {
  glm::vec4 linear0_scale{1, 0, 0, 1}, linear1{0, 1, 0, 0}, linear2{0, 0, 1, 0};
  glm::vec4 color{1}, material{1, 1, 0, 32};
  std::uint32_t id_base{}, first_placement{}, first_near{};
  std::array<float, 6> axes{}; // affine draws: see shaders/particles/own_space.glsl
  std::array<float, 3> turn{};
};
static_assert(sizeof(BatchBlock) == 128); // what every device holds
// What all draws of an instance share; where its placements start is left at 0.
BatchBlock batch_block(const Batch& batch, std::size_t instance, const View& view);

struct ParticleDraw {
  const Batch* batch{};
  gpu::BindGroup group{};     // set 1
  BatchBlock block{};
  std::uint32_t particles{};  // places to expand: 64 a placed chunk
  bool sprites{};             // may be drawn as points
  bool near_eye{};            // placed in double on the CPU: shaders with NEAR_EYE
  bool affine{};              // placed by no similarity, so that spheres are ellipsoids: shaders with AFFINE
};

// One view's draws and the buffer that their placements live in.
struct PlacedView {
  std::vector<ParticleDraw> draws{};
  std::uint64_t chunks_placed{}, chunks_total{};
};

// Buffers of one slice: a run of chunks of one set.
struct SliceBuffers {
  gpu::Buffer records{}, rows{};
  gpu::Buffer colors{};        // one a record, or the palette
  gpu::Buffer color_indices{}; // of a palette: a byte a record
  bool paletted{};
};
// One view for the compute expansion: what tiles serve, and what they do not, as draws.
struct TiledView {
  std::vector<TileChunk> chunks{};   // in no order
  std::vector<TileDraw> draws{};
  std::vector<glm::vec4> materials{}; // different ones
  std::vector<SliceBuffers> slices{};
  std::uint32_t flags{};             // (instance, chunk) pairs of the scene
  std::uint64_t ids{};               // no particle of it has this one or a greater one
  PlacedView rest{};
};

// How tiles are to be placed.
struct TilePlacing {
  bool exact{};    // depth or normals are asked for
  double margin{}; // pixels by which particles may be widened
  bool splats{};   // chunks of small particles may be drawn by splats
  bool whole{};    // chunks that the far cut passes through are drawn whole: what lies beyond it does not matter
  std::function<std::uint32_t(const Batch&)> material{}; // a batch's number, where it is not that of TiledView::materials
};

class ParticleStore {
public:
  explicit ParticleStore(gpu::Device device);
  // `largest_binding`: bytes that a buffer of records may have at most, for tests; else what the device can bind.
  ParticleStore(gpu::Device device, std::uint64_t largest_binding);
  ~ParticleStore();
  ParticleStore(const ParticleStore&) = delete;
  ParticleStore& operator=(const ParticleStore&) = delete;

  // Uploads what is new in the scene and lets go of what no batch uses any more.
  void upload(const Scene& scene);
  // Needs upload() of the same scene. `slot` names a buffer of placements that is reused every frame:
  // one for each view that is alive at the same time (camera, lights). Const: placements are a cache.
  // With a `largest_point` (the device's limit, in pixels) chunks that may be drawn as points are draws of their own.
  PlacedView place(const Scene& scene, const View& view, std::uint32_t slot = 0, double largest_point = 0) const;
  // The same for the compute expansion; `out` keeps its memory between frames. Tiles hold one particle type; batches of
  // others are among the rest.
  void place_tiles(const Scene& scene, const View& view, std::string_view type, const TilePlacing& placing, TiledView& out, std::uint32_t slot = 0) const;

  [[nodiscard]] const gpu::BindGroupLayout& layout() const; // of set 1
  // What this frame's shadow maps were drawn from.
  [[nodiscard]] ShadowMaps& shadow_maps() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace mote::passes
