#version 460
// SPDX-License-Identifier: MIT
// Shades the pixels that a splat of one slice has won, against other splats and what was cast. A workgroup, one subgroup, a
// tile; each invocation has its own particle, which is placed again from its record.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "particles/interface.glsl"
#include "particles/tiles/work.glsl"
#include "particles/tiles/resolve.glsl"

layout(local_size_x = LANES) in;

layout(constant_id = 20) const bool splats_only = false;        // nothing is cast in this frame, and there is one slice

layout(std430, set = 1, binding = 1) readonly buffer Records { uvec4 records[]; };
layout(std430, set = 1, binding = 2) readonly buffer Rows { uint rows[]; };
#define COLORS_BINDING 3
#define COLOR_INDICES_BINDING 7
#include "particles/own_color.glsl"
layout(std430, set = 1, binding = 4) readonly buffer Chunks { uvec4 chunks[]; };
layout(std430, set = 1, binding = 5) readonly buffer Draws { uvec4 draws[]; };
layout(std430, set = 1, binding = 6) readonly buffer Splats { PAIR splats[]; };

// Particle `who` as splat.comp names it; `mine`: of the slice of this dispatch.
Winner winner_at(uint who, out bool mine) {
  uint chunk = (who / chunk_capacity) * (chunk_words / 4u);
  uvec4 first = chunks[chunk], last = chunks[chunk + 1u];
  uint draw = draw_of(last.w) / 4u;
  uvec4 flags = draws[draw + 3u]; // color, material and slice
  mine = splats_only || ((flags.w >> 16) & 0x7FFFu) == step.slice;
  uint slot = mine ? last.z * chunk_capacity + who % chunk_capacity : 0u;
  uvec4 linear0_scale = draws[draw], linear1_id = draws[draw + 1u], linear2 = draws[draw + 2u];
  Placement at;
  at.linear = mat3(uintBitsToFloat(linear0_scale.xyz), uintBitsToFloat(linear1_id.xyz), uintBitsToFloat(linear2.xyz));
  at.scale = uintBitsToFloat(linear0_scale.w);
  at.origin = uintBitsToFloat(first.xyz);
  vec4 record[record_vec4s];
  for (int i = 0; i < record_vec4s; ++i) record[i] = uintBitsToFloat(records[slot * uint(record_vec4s) + uint(i)]);
  vec3 color = uintBitsToFloat(flags.xyz);
  if (per_particle_color) color = (flags.w >> 31) != 0u ? own_color(slot).rgb : color;
  Winner winner = Winner(place(record, at), color, flags.w & 0xFFFFu, 0u);
  if (want_id()) winner.id = linear1_id.w + rows[slot];
  return winner;
}

// The key of an invocation's pixel in row `row` of the tile's pixels, LANES a row; infinitely far: not a splat's.
float key_at(Taken u, uvec2 base, uint row, uint height, out uvec2 pixel, out uint who) {
  uint k = row * uint(LANES) + gl_LocalInvocationID.x;
  pixel = base + uvec2(k & 7u, k >> 3);
  bool inside = pixel.x < u.width && pixel.y < height;
  uint at = inside ? pixel.y * u.width + pixel.x : 0u;
  uvec2 splat = words(splats[at]);
  who = splat.x;
  float key = uintBitsToFloat(splat.y);
  bool wins = inside;
  if (!splats_only) wins = wins && key < nearest[at];
  return wins ? key : infinitely_far;
}

void main() {
  uvec2 base = gl_WorkGroupID.xy * uint(tile_size);
  Taken u = take();
  uint height = step.height, row = 0u, changed_rows = 0u;
  float inverse_focal = u.viewport.w + u.inverse_rest;
  uvec2 pixel;
  uint who;
  // Only rows in which a splat won: the devices that this is for run both sides of a branch.
  do {
    changed_rows |= subgroupAny(key_at(u, base, row, height, pixel, who) < infinitely_far) ? 1u << row : 0u;
    ++row;
  } while (row < 64u / uint(LANES));
  do {
    float key = key_at(u, base, uint(max(findLSB(changed_rows), 0)), height, pixel, who);
    bool changed = key < infinitely_far, mine;
    Winner winner = winner_at(changed ? who : 0u, mine);
    resolve(u, pixel, (vec2(pixel) + u.sample_near_far.xy) * inverse_focal, key, changed && mine, winner);
    changed_rows &= changed_rows - 1u;
  } while (changed_rows != 0u);
}
