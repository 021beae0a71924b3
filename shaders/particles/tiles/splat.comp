#version 460
// SPDX-License-Identifier: MIT
// Casts the particles of a step's chunks whose every particle covers at most `side` pixel centers in x and in y: each writes
// itself at the pixels where it is nearest so far. A key's upper half is what tiles compare, too (positive floats order as
// their bits do), the lower half says which particle it is: 64 times the placed chunk, and the place in it.
//
// Workgroups take one chunk after the other (chunk.glsl), invocations one particle after the other.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_EXT_shader_atomic_int64 : require
#include "particles/interface.glsl"
#include "particles/tiles/chunk.glsl"

layout(local_size_x = LANES) in;

layout(constant_id = 19) const uint side = 1u;

layout(std430, set = 2, binding = 12) buffer Splats { uint64_t splats[]; };

// Uniform values that every particle needs, taken once.
struct Taken {
  float focal, inverse_focal;
  vec2 offset, last_pixel;
  uint width;
};
Taken take() {
  return Taken(frame.viewport.z, frame.viewport.w + frame.depth_near.y, frame.sample_near_far.xy,
               vec2(float(step.width), float(step.height)) - 1.0, step.width);
}

void splat(Taken u, Particle particle, uint who) {
  Proxy bounds = tile_proxy(particle);
  vec2 first = max(ceil(bounds.lo * u.focal - u.offset - 0.02), vec2(0.0));
  vec2 last = min(floor(bounds.hi * u.focal - u.offset + 0.02), u.last_pixel);
  TileTest test = tile_test(particle, drawable(particle));
  for (uint y = 0u; y < side; ++y)
    for (uint x = 0u; x < side; ++x) {
      vec2 pixel = first + vec2(float(x), float(y));
      float key = infinitely_far;
      bool hit = tile_nearer(test, (u.offset.x + pixel.x) * u.inverse_focal, (u.offset.y + pixel.y) * u.inverse_focal, key);
      if (hit && pixel.x <= last.x && pixel.y <= last.y) {
        uint at = uint(pixel.y) * u.width + uint(pixel.x);
        uint64_t splatted = packUint2x32(uvec2(who, floatBitsToUint(key)));
        if (splatted < splats[at]) atomicMin(splats[at], splatted);
      }
    }
}

void main() {
  uint list = splat_arguments(step.slice, side), count = arguments[list + 3u], start = arguments[list + 4u];
  uint k = gl_WorkGroupID.x;
  Taken u = take();
  do {
    uint chunk_at = splat_lists[start + k];
    Chunk chunk = load_chunk(chunk_at);
    uint lane = gl_LocalInvocationID.x;
    do {
      splat(u, place_record(chunk.first + lane, chunk.at), chunk_at * chunk_capacity + lane);
      lane += uint(LANES);
    } while (lane < chunk_capacity);
    k += gl_NumWorkGroups.x;
  } while (k < count);
}
