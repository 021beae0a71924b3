#version 460
// SPDX-License-Identifier: MIT
// Chooses the chunks of a step: those seen in the last frame, or the others that the depth so far does not hide.
// One invocation a placed chunk; they come front to back.
#extension GL_GOOGLE_include_directive : require
#include "particles/tiles/binning.glsl"

layout(local_size_x = 64) in;

uint level_of(uint span) { return span <= 4u ? 0u : span <= 16u ? 1u : span <= 64u ? 2u : 3u; }

void main() {
  if (gl_GlobalInvocationID.x >= step.count) return;
  uint i = step.first + gl_GlobalInvocationID.x;
  float z_min = uintBitsToFloat(chunks[i * chunk_words + 3u]);
  uint rect_lo = chunks[i * chunk_words + 4u], rect_hi = chunks[i * chunk_words + 5u];
  uint last = chunks[i * chunk_words + 7u], draw = draw_of(last), side = splat_side(last);
  uvec2 lo = corner(rect_lo), hi = corner(rect_hi), span = hi - lo + 1u;
  uint flag = draws[draw + 11u] + chunks[i * chunk_words + 6u];
  bool before = flags[flag] != 0u, take = before;
  if ((step.others & 1u) != 0u) {
    bool now = z_min < farthest(lo, hi, level_of(max(span.x, span.y)));
    flags[flag] = now ? 1u : 0u;
    take = now && !before;
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
  uint place = atomicAdd(arguments[slice_arguments(round, slice)], 1u);
  lists[list_at(round, slice) + place] = i;
  atomicMax(arguments[allocate_arguments(round)], (step.tiles_x * step.tiles_y + 63u) / 64u);
}
