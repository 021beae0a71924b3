// SPDX-License-Identifier: MIT
// Buffers of the kernels that choose chunks and file particles under tiles.
#ifndef MOTE_TILES_BINNING_GLSL
#define MOTE_TILES_BINNING_GLSL

#include "particles/tiles/work.glsl"

layout(std430, set = 2, binding = 0) readonly buffer Chunks { uint chunks[]; };
layout(std430, set = 2, binding = 1) readonly buffer Draws { uint draws[]; };
layout(std430, set = 2, binding = 2) buffer Flags { PAIR flags[]; };        // per (instance, chunk): the particles that were seen, a bit each
layout(std430, set = 2, binding = 3) buffer Lists { uint lists[]; };        // chunks taken and sifted, by round and slice: list_at(), sifted_at()
layout(std430, set = 2, binding = 4) buffer Arguments { uint arguments[]; };
layout(std430, set = 2, binding = 5) buffer Payloads { uvec4 payloads[]; }; // of the round's particles, 64 a chunk
layout(std430, set = 2, binding = 6) buffer Colors { PAIR placed_colors[]; }; // half floats: r g, b and the material's number
layout(std430, set = 2, binding = 7) buffer Ids { uint placed_ids[]; };
layout(std430, set = 2, binding = 8) buffer Tiles { uint tiles[]; };        // counts, cursors, ends: see tile_cursor()
layout(std430, set = 2, binding = 9) buffer Far { float far[]; };          // farthest depth of each tile, of coarser cells, of windows: farthest()
layout(std430, set = 2, binding = 10) buffer Active { uint active_tiles[]; };
layout(std430, set = 2, binding = 11) buffer Entries { uint entries[]; };   // tile_room a tile, then those of the list in tile order; then the
                                                                            // list itself, two words each: tile and place
layout(std430, set = 2, binding = 14) writeonly buffer Casters { uvec4 casters[]; }; // payloads by id, of a map that keeps them so
layout(std430, set = 2, binding = 13) buffer SplatLists { uint splat_lists[]; }; // placed chunks taken, by slice and side

// Where the farthest depths of windows start: of 2x1, 1x2 and 2x2 tiles from each tile on, all tiles of one size after the other.
uint windows_start() { return step.level3 + ((step.tiles_x + 63u) >> 6) * ((step.tiles_y + 63u) >> 6); }

// The farthest depth in a rectangle of tiles: of up to 4 tiles across from windows that cover it exactly, else from cells, 4 tiles wide
// where it is less than `fine` of them across, else 16 or 64.
float farthest(uvec2 lo, uvec2 hi, uint fine) {
  uvec2 span = hi - lo + 1u;
  uint most = max(span.x, span.y);
  bool windows = most <= 4u;
  uvec2 wide = windows ? min(span - 1u, uvec2(1u)) : uvec2(0u);
  uint size = wide.x + 2u * wide.y, shift = windows ? 0u : most <= 4u * fine ? 2u : most <= 16u * fine ? 4u : 6u;
  uint start = shift == 0u ? (size == 0u ? 0u : windows_start() + (size - 1u) * step.level1) : shift == 2u ? step.level1 : shift == 4u ? step.level2 : step.level3;
  uint width = (step.tiles_x + (1u << shift) - 1u) >> shift, stride = windows ? 2u : 1u;
  uvec2 first = lo >> shift, last = (hi >> shift) - wide, cell = first;
  float depth = 0.0;
  bool more;
  do {
    depth = max(depth, far[start + cell.y * width + cell.x]);
    bool wrap = cell.x >= last.x;
    more = !wrap || cell.y < last.y;
    cell = wrap ? uvec2(first.x, min(cell.y + stride, last.y)) : uvec2(min(cell.x + stride, last.x), cell.y);
  } while (more);
  return depth;
}

#endif
