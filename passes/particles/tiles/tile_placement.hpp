// SPDX-License-Identifier: MIT
// Chunks as the compute expansion needs them: their origin in view space, their nearest depth and the tiles they may
// cover. Pure; double precision, rounded outwards once.
//
// Tiles serve chunks that lie wholly behind the eye's and the near plane and do not cross the far cut. Of those near the eye,
// where float32 placement would show in the depth, the particles are placed here one by one, in double. What is so near that
// the intersection would need more than its plain form (nearer than the diameter of a particle) is given back with the rest,
// to be drawn by a raster expansion; few chunks are. Where depth or normals are asked for, and of particles that are more than
// a center and a radius, that is everything near.
#pragma once

#include "passes/particles/placement.hpp"
#include "passes/particles/tiles/tile_blocks.hpp"

namespace mote::passes {

struct PlacedForTiles {
  std::vector<TileChunk> tiled{};
  PlacedChunks rest{};
  // Chunks placed particle by particle: TileChunk::chunk counts them from the first in near_records, origin is 0.
  std::vector<TileChunk> near{};
  std::vector<glm::vec4> near_records{}; // 64 a chunk: view space, radius
  std::vector<std::uint32_t> near_rows{}, near_colors{};

  void clear();
  void add(const PlacedForTiles& later); // all but the rest
};

struct TilePlacement {
  std::uint32_t draw{};  // goes into TileChunk
  bool exact{};          // depth or normals are asked for
  double margin{};       // pixels by which particles may be widened
  bool splats{};         // chunks of small particles get a TileChunk::side
  bool whole{};          // chunks that the far cut passes through are served
};

// Appends those of the chunks [first + begin, first + end) of an instance that the view may see; indices count from `first`.
void place_for_tiles(const ChunkSet& set, std::uint64_t first, std::uint64_t begin, std::uint64_t end, const Instance& instance, const View& view,
                     const ViewCuller& culler, const TilePlacement& how, PlacedForTiles& out);

} // namespace mote::passes
