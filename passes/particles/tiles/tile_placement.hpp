// SPDX-License-Identifier: MIT
// Chunks as the compute expansion needs them: their origin in view space, their nearest depth and the tiles they may
// cover. Pure; double precision, rounded outwards once.
//
// Tiles serve chunks that lie wholly behind the eye's and the near plane and not beyond the far cut, and so far from the
// eye that float32 placement is exact enough; the others (few in any view) are given back, to be drawn by a raster expansion.
#pragma once

#include "passes/particles/placement.hpp"
#include "passes/particles/tiles/tile_blocks.hpp"

namespace mote::passes {

struct PlacedForTiles {
  std::vector<TileChunk> tiled{};
  PlacedChunks rest{};
};

// Appends those of the chunks [first, first + count) of an instance that the view may see. `draw` goes into TileChunk.
void place_for_tiles(const ChunkSet& set, std::uint64_t first, std::uint64_t count, const Instance& instance, const View& view,
                     const ViewCuller& culler, std::uint32_t draw, PlacedForTiles& out);

} // namespace mote::passes
