#version 460
// SPDX-License-Identifier: MIT
// Reserves room for each tile's entries, one tile's after another's in any order, and lists the tiles that have some.
#extension GL_GOOGLE_include_directive : require
#include "particles/tiles/binning.glsl"

layout(local_size_x = 64) in;

void main() {
  uint t = gl_GlobalInvocationID.x;
  if (t >= step.tiles_x * step.tiles_y) return;
  uint count = tiles[4u * t];
  if (count == 0u) return;
  uint totals = cast_arguments(step.round);
  tiles[4u * t + 1u] = atomicAdd(arguments[totals + 3u], count);
  tiles[4u * t + 2u] = count;
  tiles[4u * t] = 0u;
  active_tiles[atomicAdd(arguments[totals], 1u)] = t;
}
