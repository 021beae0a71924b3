#version 460
// SPDX-License-Identifier: MIT
// Files the entries that did not fit in their tiles' own places; one invocation an entry of the list. Their depth is
// not known any more: they are never passed over.
#extension GL_GOOGLE_include_directive : require
#include "particles/tiles/binning.glsl"

layout(local_size_x = 64) in;

void main() {
  if (gl_GlobalInvocationID.x >= arguments[scatter_arguments(step.round) + 3u]) return;
  uvec2 which = words(entries[step.spilled + gl_GlobalInvocationID.x]); // tile, place
  entries[atomicAdd(tiles[4u * which.x + 1u], 1u)] = pair(uvec2(which.y, 0u));
}
