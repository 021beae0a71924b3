#version 460
// SPDX-License-Identifier: MIT
// Brings the particles of a round's chunks into view space and files them under the tiles they may cover.
// One workgroup a chunk (chunk.glsl), every invocation takes one particle after the other.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "particles/interface.glsl"
#include "particles/tiles/chunk.glsl"

layout(local_size_x = LANES) in;

layout(constant_id = 11) const bool want_ids = false;
layout(constant_id = 12) const bool first_round = false; // nothing was cast before in this frame
layout(constant_id = 17) const bool first_slice = false;

// Chunks of the same round in earlier slices: their particles come first.
uint chunks_before() {
  uint before = 0u;
  if (first_slice) return before;
  for (uint s = 0u; s < step.slice; ++s) before += arguments[slice_arguments(step.round, s)];
  return before;
}

// Uniform values that every particle needs, taken once.
struct Taken {
  float focal;
  vec2 offset, last_pixel;
  uint tiles_x, room, list, spilled;
  float depth_origin, depth_scale;
};
Taken take() {
  return Taken(frame.viewport.z, frame.sample_near_far.xy, vec2(float(step.width), float(step.height)) - 1.0, step.tiles_x,
               step.tile_room, scatter_arguments(step.round) + 3u, step.spilled, step.depth_origin, step.depth_scale);
}

// The tiles whose pixel centers the proxy may cover, as (lo, hi); empty where lo.x > hi.x. A pixel's margin of 1/64.
uvec4 tile_rect(Taken u, Proxy bounds) {
  vec2 lo = bounds.lo * u.focal - u.offset - 0.02, hi = bounds.hi * u.focal - u.offset + 0.02;
  vec2 first = max(ceil(lo), vec2(0.0)), last = min(floor(hi), u.last_pixel);
  bool empty = !(first.x <= last.x && first.y <= last.y);
  uvec2 tile_lo = uvec2(first) >> 3, tile_hi = uvec2(max(last, vec2(0.0))) >> 3;
  return empty ? uvec4(1u, 1u, 0u, 0u) : uvec4(tile_lo, tile_hi);
}

uint level_of(uint span) { return span <= 2u ? 0u : span <= 8u ? 1u : span <= 32u ? 2u : 3u; }

// Record `lane` of a chunk: placed, kept for the cast, and filed.
void place_particle(Taken u, Chunk chunk, uint lane) {
  uint slot = chunk.first + lane, at = chunk.place + lane;
  Particle particle = place_record(slot, chunk.at);
  Proxy bounds = tile_proxy(particle);
  uvec4 rect = tile_rect(u, bounds);
  // What was reserved is the chunk's rectangle; rounding never leads out of it.
  uvec2 lo = max(rect.xy, chunk.rect_lo), hi = min(rect.zw, chunk.rect_hi);
  bool some = drawable(particle) && rect.x <= rect.z && lo.x <= hi.x && lo.y <= hi.y;
  if (some && !first_round) some = bounds.z_min < farthest(lo, hi, level_of(max(hi.x - lo.x, hi.y - lo.y) + 1u));
  if (some) {
    vec4 payload[payload_vec4s];
    pack(particle, payload);
    for (int i = 0; i < payload_vec4s; ++i) {
      uint to = 2u * (at * uint(payload_vec4s) + uint(i));
      payloads[to] = pair(floatBitsToUint(payload[i].xy));
      payloads[to + 1u] = pair(floatBitsToUint(payload[i].zw));
    }
    vec3 color = chunk.color;
    if (per_particle_color) color = chunk.colored ? unpack_color(colors[slot]).rgb : color;
    placed_colors[at] = pair(uvec2(packHalf2x16(color.rg), (packHalf2x16(vec2(color.b, 0.0)) & 0xFFFFu) | chunk.material << 16));
    if (want_ids) placed_ids[at] = chunk.id_base + rows[slot];
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
}

void main() {
  uint chunk_at = gl_WorkGroupID.x;
  Chunk chunk = load_chunk(lists[list_at(step.round, step.slice) + chunk_at]);
  chunk.place = (chunks_before() + chunk_at) * chunk_capacity;
  Taken u = take();
  uint lane = gl_LocalInvocationID.x;
  do {
    place_particle(u, chunk, lane);
    lane += uint(LANES);
  } while (lane < chunk_capacity);
}
