// SPDX-License-Identifier: MIT
// What a pass needs to draw by the compute expansion: places a scene's chunks for one view, and draws those that tiles serve.
// What they do not serve is left in rest(), for the pass to draw on top by a raster expansion.
//
//   if (drawing.place(device, store, frame_layout, wish))       // something is for tiles
//     drawing.record(encoder, frame_group, targets, mark);
//
// One placement may be recorded several times, for frame blocks whose sample offsets differ by no more than the margin.
//
// Whether tiles can draw the scene at all is asked before (expansion_choice.hpp).
#pragma once

#include "passes/particles/particle_store.hpp"
#include "passes/particles/selection.hpp"
#include "passes/particles/tiles/tile_renderer.hpp"

#include <memory>
#include <string>

namespace mote::passes {

struct TileWish {
  const Scene& scene;
  const View& view;
  const Selection& selection;
  Phase phase{Phase::Opaque};  // or Surface, Shadow
  std::string type{};          // that tiles are to hold; empty: the one of most particles
  std::uint32_t slot{};        // of the store's placements
  float slack{};               // phase Shadow: thinner casters, in pixels, are widened
  TilePlacing placing{};
  bool edges{};                // analytic ones: record() is told so, too
  bool alarm{};                // magenta where a type from files gives NaN
};

class TiledDrawing {
public:
  // False: nothing in view is for tiles; rest() then holds everything.
  bool place(gpu::Device device, const ParticleStore& store, const gpu::BindGroupLayout& frame, const TileWish& wish);
  void record(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame_group, const TileTargets& targets, const TileRenderer::Mark& mark);
  [[nodiscard]] MapInBuffers::Buffers casters() const { return tiles_->casters(); } // as TileRenderer says
  [[nodiscard]] const PlacedView& rest() const { return tiled_.rest; }
  [[nodiscard]] std::size_t chunks() const { return tiled_.chunks.size(); }

private:
  const Scene& selected(const Scene& scene, const Selection& selection);

  std::unique_ptr<TileRenderer> tiles_;
  TiledView tiled_;
  ParticlePipelineKey key_;
  Scene selected_; // alive while its draws are recorded
};

} // namespace mote::passes
