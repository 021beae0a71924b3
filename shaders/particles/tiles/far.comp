#version 460
// SPDX-License-Identifier: MIT
// The farthest depth of blocks of 4x4, 16x16 and 64x64 tiles and of windows of two tiles from each tile on, each straight from the
// tiles; one invocation a tile for its windows, then one a cell of all three levels.
#extension GL_GOOGLE_include_directive : require
#include "particles/tiles/binning.glsl"

layout(local_size_x = 64) in;

void windows_of(uint tile) {
  uint right = tile % step.tiles_x + 1u < step.tiles_x ? tile + 1u : tile, down = tile + step.tiles_x < step.level1 ? step.tiles_x : 0u;
  float here = far[tile], beside = max(here, far[right]), below = far[tile + down];
  uint to = windows_start() + tile;
  far[to] = beside;
  far[to + step.level1] = max(here, below);
  far[to + 2u * step.level1] = max(max(beside, below), far[right + down]);
}

void main() {
  uint cell = gl_GlobalInvocationID.x; // as numbered in `far`; tiles first
  if (cell < step.level1) {
    windows_of(cell);
    return;
  }
  uint shift = cell < step.level2 ? 2u : cell < step.level3 ? 4u : 6u;
  uint start = shift == 2u ? step.level1 : shift == 4u ? step.level2 : step.level3;
  uint width = (step.tiles_x + (1u << shift) - 1u) >> shift, height = (step.tiles_y + (1u << shift) - 1u) >> shift;
  uint k = cell - start;
  if (k >= width * height) return;
  uvec2 lo = uvec2(k % width, k / width) << shift;
  uvec2 hi = min(lo + (1u << shift), uvec2(step.tiles_x, step.tiles_y)) - 1u;
  float farthest = 0.0;
  uvec2 tile = lo;
  do {
    farthest = max(farthest, far[tile.y * step.tiles_x + tile.x]);
    bool wrap = tile.x == hi.x;
    tile = wrap ? uvec2(lo.x, tile.y + 1u) : uvec2(tile.x + 1u, tile.y);
  } while (tile.y <= hi.y);
  far[cell] = farthest;
}
