#version 460
// SPDX-License-Identifier: MIT
// Files the entries that did not fit in their tiles' own places; one invocation an entry of the list. Their depth is
// not known any more: they are never passed over.
#extension GL_GOOGLE_include_directive : require
#include "particles/tiles/binning.glsl"

layout(local_size_x = 64) in;

void main() {
  if (gl_GlobalInvocationID.x >= arguments[list_counter()]) return;
  uint which = step.spilled + 2u * gl_GlobalInvocationID.x, tile = entries[which];
  entries[atomicAdd(tiles[tile_cursor(tile)], 1u)] = entries[which + 1u];
}
