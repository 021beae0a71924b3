#version 460
// SPDX-License-Identifier: MIT
// Chooses the chunks of a step: those of which particles were seen, or those that the depth so far does not hide and that may
// have others.
// One invocation a placed chunk; they come front to back.
#extension GL_GOOGLE_include_directive : require
#include "particles/tiles/binning.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 2, binding = 0) readonly buffer ChunkQuads { uvec4 chunk_quads[]; };

void main() {
  if (gl_GlobalInvocationID.x >= step.count) return;
  uint i = step.first + gl_GlobalInvocationID.x;
  float z_min = uintBitsToFloat(chunks[i * chunk_words + 3u]);
  uvec4 rest = chunk_quads[i * chunk_words / 4u + 1u];
  uint rect_lo = rest.x, rect_hi = rest.y, draw = draw_of(rest.w), side = splat_side(rest.w);
  uvec2 lo = corner(rect_lo), hi = corner(rect_hi), span = hi - lo + 1u;
  uint flag = draws[draw + 11u] + rest.z;
  uvec2 seen = words(flags[flag]);
  bool before = (seen.x | seen.y) != 0u, take = before;
  if ((step.others & 1u) != 0u) {
    bool now = z_min < farthest(lo, hi, 4u);
    bool more = side != 0u ? !before : (seen.x & seen.y) != 0xFFFFFFFFu || looks_anew(flag, step.others);
    if (before && !now) flags[flag] = pair(uvec2(0u));
    if (now && !before && side != 0u) flags[flag] = pair(uvec2(0xFFFFFFFFu)); // splats are seen as chunks
    take = now && more;
  }
  if (!take) return;
  uint slice = (draws[draw + 15u] >> 16) & 0x7FFFu;
  if (side != 0u) {
    uint list = splat_arguments(slice, side), place = atomicAdd(arguments[list + 3u], 1u);
    atomicMax(arguments[list], min(place + 1u, most_splat_groups));
    splat_lists[arguments[list + 4u] + place] = i;
    if (place >= ((step.others & 1u) != 0u ? step.count / 32u : 0u)) atomicMax(arguments[splat_far_arguments()], step.tiles_x);
    return;
  }
  // Room for each of its particles in as many tiles as the largest may cover; at least 4 a particle.
  uvec2 most = uvec2(rect_lo >> 24, rect_hi >> 24);
  most = mix(min(most, span), span, equal(most, uvec2(255u)));
  uint start = atomicAdd(arguments[step.region], chunk_capacity * max(most.x * most.y, 4u));
  uint round = start / step.capacity;
  uint place = atomicAdd(arguments[sifted(step.others) ? sift_arguments(round, slice) : slice_arguments(round, slice)], 1u);
  lists[list_at(round, slice) + place] = i;
  atomicMax(arguments[allocate_arguments(round)], (step.tiles_x * step.tiles_y + 63u) / 64u);
}
