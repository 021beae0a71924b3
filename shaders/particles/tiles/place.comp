#version 460
// SPDX-License-Identifier: MIT
// Brings the particles of a round's chunks into view space and files them under the tiles they may cover.
// One workgroup a chunk (chunk.glsl), every invocation takes one particle after the other, of those that the step is to draw.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "particles/interface.glsl"
#include "particles/tiles/chunk.glsl"
#include "particles/tiles/seen.glsl"

layout(local_size_x = LANES) in;

layout(constant_id = 11) const bool want_ids = false;
layout(constant_id = 12) const bool untested = false; // nothing was cast before in this frame, or what was cast is known not to hide them
layout(constant_id = 17) const bool first_slice = false;
layout(constant_id = 22) const bool casters_by_id = false; // of a shadow map

// Chunks of the same round in earlier slices: their particles come first.
uint chunks_before() {
  uint before = 0u;
  if (first_slice) return before;
  for (uint s = 0u; s < step.slice; ++s) before += arguments[slice_arguments(step.round, s)];
  return before;
}

// Uniform values that every particle needs, taken once.
struct Taken {
  Reach reach;
  uint tiles_x, room, list, spilled;
  float depth_origin, depth_scale;
};
Taken take() {
  return Taken(take_reach(), step.tiles_x, step.tile_room, list_counter(), step.spilled, step.depth_origin, step.depth_scale);
}

// Record `lane` of a chunk: placed, kept for the cast, and filed, if it is to be drawn. Is it not hidden?
bool place_particle(Taken u, Chunk chunk, uint lane, bool valid) {
  uint slot = chunk.first + lane, at = chunk.place + lane;
  Particle particle = place_record(slot, chunk.at);
  Proxy bounds = tile_proxy(particle);
  uvec4 rect = tile_rect(u.reach, bounds);
  // What was reserved is the chunk's rectangle; rounding never leads out of it.
  uvec2 lo = max(rect.xy, chunk.rect_lo), hi = min(rect.zw, chunk.rect_hi);
  bool some = valid && drawable(particle) && rect.x <= rect.z && lo.x <= hi.x && lo.y <= hi.y;
  if (some && !untested) some = bounds.z_min < farthest(lo, hi, 2u);
  if (some) {
    vec4 payload[payload_vec4s];
    pack(particle, payload);
    for (int i = 0; i < payload_vec4s; ++i) payloads[at * uint(payload_vec4s) + uint(i)] = floatBitsToUint(payload[i]);
    vec3 color = chunk.color;
    if (per_particle_color) color = chunk.colored ? own_color(slot).rgb : color;
    placed_colors[at] = pair(uvec2(packHalf2x16(color.rg), (packHalf2x16(vec2(color.b, 0.0)) & 0xFFFFu) | chunk.material << 16));
    if (want_ids) {
      uint id = chunk.id_base + rows[slot];
      placed_ids[at] = id;
      if (casters_by_id) casters[id] = floatBitsToUint(payload[0]);
    }
  }
  uint entry = at | depth_step(bounds.z_min, u.depth_origin, u.depth_scale) << place_bits;
  uvec2 tile = lo;
  if (some) do {
    uint t = tile.y * u.tiles_x + tile.x;
    uint k = atomicAdd(tiles[t], 1u);
    bool fits = k < u.room;
    uint to = t * u.room + k;
    if (!fits) {
      to = u.spilled + 2u * atomicAdd(arguments[u.list], 1u);
      entries[to + 1u] = at;
    }
    entries[to] = fits ? entry : t;
    bool wrap = tile.x == hi.x;
    tile = wrap ? uvec2(lo.x, tile.y + 1u) : uvec2(tile.x + 1u, tile.y);
  } while (tile.y <= hi.y);
  return some;
}

void main() {
  // A chunk that was drawn before draws what was seen, one that was not all of it, a sifted one what sift has chosen.
  bool others = (step.others & 1u) != 0u;
  uint from = sifted(step.others) ? sifted_at(step.round, step.slice) + sifted_words * gl_WorkGroupID.x : list_at(step.round, step.slice) + gl_WorkGroupID.x;
  uint own = lists[from + (gl_LocalInvocationID.x & 3u)];
  Chunk chunk = load_chunk(subgroupShuffle(own, 0u));
  chunk.place = (step.place_first + chunks_before() + gl_WorkGroupID.x) * chunk_capacity;
  uvec2 these = uvec2(subgroupShuffle(own, 1u), subgroupShuffle(own, 2u)), kept = uvec2(0u);
  if (!sifted(step.others)) these = others ? uvec2(0xFFFFFFFFu) : words(flags[chunk.flag]);
  Taken u = take();
  uint count = uint(bitCount(these.x) + bitCount(these.y)), done = 0u;
  do {
    uint n = done + gl_LocalInvocationID.x, lane = bit_at(these, n);
    if (place_particle(u, chunk, lane, n < count)) kept |= bit_of(lane);
    done += uint(LANES);
  } while (done < count);
  if (others && !sifted(step.others)) keep_seen(chunk.flag, kept);
}
