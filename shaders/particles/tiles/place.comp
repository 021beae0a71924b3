#version 460
// SPDX-License-Identifier: MIT
// Brings the particles of a round's chunks into view space and files them under the tiles they may cover.
// One workgroup a chunk, one invocation a particle.
// What is the same for all of them is loaded word by word, one word a lane, and handed round.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "particles/interface.glsl"
#include "particles/tiles/binning.glsl"

layout(local_size_x = 64) in;

layout(constant_id = 11) const bool want_ids = false;
layout(constant_id = 12) const bool first_round = false; // nothing was cast before in this frame
layout(constant_id = 17) const bool first_slice = false;

layout(std430, set = 1, binding = 0) readonly buffer Records { PAIR records[]; };
layout(std430, set = 1, binding = 1) readonly buffer Rows { uint rows[]; };
layout(std430, set = 1, binding = 2) readonly buffer FileColors { uint colors[]; };

// Eight words that start at `base`, the same for the whole subgroup.
#define WORD(k) w[k] = subgroupShuffle(own, uint(k));
#define WORDS(buffer_words, base) { \
  uint own = buffer_words[(base) + (gl_SubgroupInvocationID & (LANES >= 8 ? 7u : 3u))]; \
  WORD(0) WORD(1) WORD(2) WORD(3) \
  if (LANES < 8) own = buffer_words[(base) + 4u + (gl_SubgroupInvocationID & 3u)]; \
  w[4] = subgroupShuffle(own, LANES < 8 ? 0u : 4u); \
  w[5] = subgroupShuffle(own, LANES < 8 ? 1u : 5u); \
  w[6] = subgroupShuffle(own, LANES < 8 ? 2u : 6u); \
  w[7] = subgroupShuffle(own, LANES < 8 ? 3u : 7u); }

// Chunks of the same round in earlier slices: their particles come first.
uint chunks_before() {
  uint before = 0u;
  if (first_slice) return before;
  for (uint s = 0u; s < step.slice; ++s) before += arguments[slice_arguments(step.round, s)];
  return before;
}

// The tiles whose pixel centers the proxy may cover, as (lo, hi); empty where lo.x > hi.x. A pixel's margin of 1/64.
uvec4 tile_rect(Proxy bounds) {
  vec2 focal = vec2(frame.viewport.z), offset = frame.sample_near_far.xy;
  vec2 lo = bounds.lo * focal - offset - 0.02, hi = bounds.hi * focal - offset + 0.02;
  vec2 first = max(ceil(lo), vec2(0.0)), last = min(floor(hi), vec2(float(step.width), float(step.height)) - 1.0);
  bool empty = !(first.x <= last.x && first.y <= last.y);
  uvec2 tile_lo = uvec2(first) >> 3, tile_hi = uvec2(max(last, vec2(0.0))) >> 3;
  return empty ? uvec4(1u, 1u, 0u, 0u) : uvec4(tile_lo, tile_hi);
}

uint level_of(uint span) { return span <= 2u ? 0u : span <= 8u ? 1u : span <= 32u ? 2u : 3u; }

void main() {
  uint chunk_at = gl_WorkGroupID.x, lane = gl_LocalInvocationID.x;
  uint w[8];
  WORDS(chunks, lists[list_at(step.round, step.slice) + chunk_at] * chunk_words)
  vec3 origin = uintBitsToFloat(uvec3(w[0], w[1], w[2]));
  uvec2 rect_lo = corner(w[4]), rect_hi = corner(w[5]);
  uint slot = w[6] * chunk_capacity + lane, draw = w[7] * draw_words;
  WORDS(draws, draw)
  vec3 linear0 = uintBitsToFloat(uvec3(w[0], w[1], w[2])), linear1 = uintBitsToFloat(uvec3(w[4], w[5], w[6]));
  float scale = uintBitsToFloat(w[3]);
  uint id_base = w[7];
  WORDS(draws, draw + 8u)
  vec3 linear2 = uintBitsToFloat(uvec3(w[0], w[1], w[2])), color = uintBitsToFloat(uvec3(w[4], w[5], w[6]));
  uint material = w[7] & 0xFFFFu;
  bool colored = (w[7] >> 31) != 0u;

  vec4 record[record_vec4s];
  for (int i = 0; i < record_vec4s; ++i) {
    uint at = 2u * (slot * uint(record_vec4s) + uint(i));
    record[i] = uintBitsToFloat(uvec4(words(records[at]), words(records[at + 1u])));
  }
  Particle particle = place(record, Placement(mat3(linear0, linear1, linear2), origin, scale));

  uint at = (chunks_before() + chunk_at) * chunk_capacity + lane;
  vec4 payload[payload_vec4s];
  pack(particle, payload);
  for (int i = 0; i < payload_vec4s; ++i) {
    uint to = 2u * (at * uint(payload_vec4s) + uint(i));
    payloads[to] = pair(floatBitsToUint(payload[i].xy));
    payloads[to + 1u] = pair(floatBitsToUint(payload[i].zw));
  }
  if (per_particle_color) color = colored ? unpack_color(colors[slot]).rgb : color;
  placed_colors[at] = pair(uvec2(packHalf2x16(color.rg), (packHalf2x16(vec2(color.b, 0.0)) & 0xFFFFu) | material << 16));
  if (want_ids) placed_ids[at] = id_base + rows[slot];

  Proxy bounds = tile_proxy(particle);
  uvec4 rect = tile_rect(bounds);
  // What was reserved is the chunk's rectangle; rounding never leads out of it.
  uvec2 lo = max(rect.xy, rect_lo), hi = min(rect.zw, rect_hi);
  bool some = drawable(particle) && rect.x <= rect.z && lo.x <= hi.x && lo.y <= hi.y;
  if (some && !first_round) some = bounds.z_min < farthest(lo, hi, level_of(max(hi.x - lo.x, hi.y - lo.y) + 1u));
  if (!some) return;
  PAIR entry = pair(uvec2(at, floatBitsToUint(bounds.z_min)));
  uint tiles_x = step.tiles_x, room = step.tile_room, list = scatter_arguments(step.round) + 3u, spilled = step.spilled;
  uvec2 tile = lo;
  do {
    uint t = tile.y * tiles_x + tile.x;
    uint k = atomicAdd(tiles[4u * t], 1u);
    bool fits = k < room;
    uint to = t * room + k;
    if (!fits) to = spilled + atomicAdd(arguments[list], 1u);
    entries[to] = fits ? entry : pair(uvec2(t, at));
    bool wrap = tile.x == hi.x;
    tile = wrap ? uvec2(lo.x, tile.y + 1u) : uvec2(tile.x + 1u, tile.y);
  } while (tile.y <= hi.y);
}
