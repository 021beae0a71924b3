// SPDX-License-Identifier: MIT
// Buffers of the kernels that choose chunks and file particles under tiles.
#ifndef MOTE_TILES_BINNING_GLSL
#define MOTE_TILES_BINNING_GLSL

#include "particles/tiles/work.glsl"

layout(std430, set = 2, binding = 0) readonly buffer Chunks { uint chunks[]; };
layout(std430, set = 2, binding = 1) readonly buffer Draws { uint draws[]; };
layout(std430, set = 2, binding = 2) buffer Flags { uint flags[]; };        // per (instance, chunk): seen in the last frame
layout(std430, set = 2, binding = 3) buffer Lists { uint lists[]; };        // placed chunks taken, by round and slice
layout(std430, set = 2, binding = 4) buffer Arguments { uint arguments[]; };
layout(std430, set = 2, binding = 5) buffer Payloads { PAIR payloads[]; };  // of the round's particles, 64 a chunk
layout(std430, set = 2, binding = 6) buffer Colors { PAIR placed_colors[]; }; // half floats: r g, b and the material's number
layout(std430, set = 2, binding = 7) buffer Ids { uint placed_ids[]; };
layout(std430, set = 2, binding = 8) buffer Tiles { uint tiles[]; };        // counts, cursors, ends: see tile_cursor()
layout(std430, set = 2, binding = 9) buffer Far { float far[]; };          // farthest depth of each tile, then of coarser cells
layout(std430, set = 2, binding = 10) buffer Active { uint active_tiles[]; };
layout(std430, set = 2, binding = 11) buffer Entries { uint entries[]; };   // tile_room a tile, then those of the list in tile order; then the
                                                                            // list itself, two words each: tile and place
layout(std430, set = 2, binding = 13) buffer SplatLists { uint splat_lists[]; }; // placed chunks taken, by slice and side

uint level_start(uint level) { return level == 0u ? 0u : level == 1u ? step.level1 : level == 2u ? step.level2 : step.level3; }

// The farthest depth in a rectangle of tiles, from cells of a level (4^level tiles wide).
float farthest(uvec2 lo, uvec2 hi, uint level) {
  uint shift = 2u * level, width = (step.tiles_x + (1u << shift) - 1u) >> shift, start = level_start(level);
  lo >>= shift;
  hi >>= shift;
  float most = 0.0;
  uvec2 cell = lo;
  do {
    most = max(most, far[start + cell.y * width + cell.x]);
    bool wrap = cell.x == hi.x;
    cell = wrap ? uvec2(lo.x, cell.y + 1u) : uvec2(cell.x + 1u, cell.y);
  } while (cell.y <= hi.y);
  return most;
}

#endif
