#version 460
// SPDX-License-Identifier: MIT
// Files the particles of a round under their tiles: the same loop as in place.comp.
#extension GL_GOOGLE_include_directive : require
#include "particles/tiles/binning.glsl"

layout(local_size_x = 64) in;

void main() {
  uint before = 0u;
  for (uint s = 0u; s < step.slice; ++s) before += arguments[slice_arguments(step.round, s)];
  uint at = (before + gl_WorkGroupID.x) * chunk_capacity + gl_LocalInvocationID.x;
  uvec2 rect = words(rects[at]);
  uvec2 lo = corner(rect.x), hi = corner(rect.y);
  if (lo.x > hi.x) return;
  uvec2 tile = lo;
  do {
    entries[atomicAdd(tiles[4u * (tile.y * step.tiles_x + tile.x) + 1u], 1u)] = at;
    bool wrap = tile.x == hi.x;
    tile = wrap ? uvec2(lo.x, tile.y + 1u) : uvec2(tile.x + 1u, tile.y);
  } while (tile.y <= hi.y);
}
