#version 460
// SPDX-License-Identifier: MIT
// Of the chunks that cull has taken, finds the particles that nothing hides and that were not drawn in this frame: seldom any. Placing
// runs for these alone; it costs a CPU device several times a look, whether a particle is then filed or not.
// One workgroup a chunk (chunk.glsl), every invocation looks at one particle after the other.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "particles/interface.glsl"
#include "particles/tiles/seen.glsl"

layout(local_size_x = LANES) in;

bool is_seen(Reach u, Chunk chunk, uint lane) {
  Particle particle = place_record(chunk.first + lane, chunk.at);
  Proxy bounds = tile_proxy(particle);
  uvec4 rect = tile_rect(u, bounds);
  uvec2 lo = max(rect.xy, chunk.rect_lo), hi = min(rect.zw, chunk.rect_hi);
  bool some = drawable(particle) && rect.x <= rect.z && lo.x <= hi.x && lo.y <= hi.y;
  return some && bounds.z_min < farthest(some ? lo : uvec2(0u), some ? hi : uvec2(0u), 2u);
}

void main() {
  uint at = lists[list_at(step.round, step.slice) + gl_WorkGroupID.x];
  Chunk chunk = load_chunk(at);
  uvec2 seen = words(flags[chunk.flag]), kept = uvec2(0u);
  bool anew = looks_anew(chunk.flag, step.others);
  uvec2 these = anew ? uvec2(0xFFFFFFFFu) : ~seen;
  Reach u = take_reach();
  uint count = uint(bitCount(these.x) + bitCount(these.y)), done = 0u;
  do {
    uint n = done + gl_LocalInvocationID.x, lane = bit_at(these, n);
    if (n < count && is_seen(u, chunk, lane)) kept |= bit_of(lane);
    done += uint(LANES);
  } while (done < count);
  kept = bits_of_all(kept);
  if (!subgroupElect()) return;
  flags[chunk.flag] = pair(anew ? kept : seen | kept);
  uvec2 left = kept & ~seen;
  if ((left.x | left.y) == 0u) return;
  uint to = sifted_at(step.round, step.slice) + sifted_words * atomicAdd(arguments[slice_arguments(step.round, step.slice)], 1u);
  lists[to] = at;
  lists[to + 1u] = left.x;
  lists[to + 2u] = left.y;
}
