#version 460
// SPDX-License-Identifier: MIT
// Lists the tiles that have entries (in a gathered frame: more than before), and makes room for the entries that did not fit in a tile's own places.
#extension GL_GOOGLE_include_directive : require
#include "particles/tiles/binning.glsl"

layout(local_size_x = 64) in;

void main() {
  uint t = gl_GlobalInvocationID.x;
  if (t >= step.tiles_x * step.tiles_y) return;
  if (t == 0u) arguments[scatter_arguments(step.round)] = (arguments[list_counter()] + 63u) / 64u;
  uint count = tiles[t];
  if (count == 0u) return;
  uint own = step.tiles_x * step.tiles_y * step.tile_room;
  uint rest = count - min(count, step.tile_room);
  bool more = true;
  if (gathered(step.others)) more = count != tiles[tile_end(t)];
  else tiles[t] = 0u;
  tiles[tile_cursor(t)] = own + atomicAdd(arguments[allocate_arguments(step.round) + 3u], rest);
  tiles[tile_end(t)] = count;
  if (more) active_tiles[atomicAdd(arguments[cast_arguments(step.round)], 1u)] = t;
}
