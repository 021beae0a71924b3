#version 460
// SPDX-License-Identifier: MIT
// Analytic edges by tiles: a pixel next to one of another particle is composited, front to back, of what each of the particles that
// own it and its eight neighbors covers of it (closed forms, common/coverage.glsl) with the color that the particle has in the
// pixel it owns. What they leave is the background where a neighbor is empty, else the farthest's.
//
// An invocation blends one of the pixels that outlines.comp has listed.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "particles/interface.glsl"
#include "particles/tiles/work.glsl"
#include "particles/tiles/winners.glsl"
#include "common/coverage.glsl"
#define COLOR_BINDING 1
#define COLOR_PAIRS_BINDING 2
#include "particles/tiles/color_out.glsl"

layout(local_size_x = LANES) in;

layout(std430, set = 1, binding = 0) readonly buffer Names { uint names[]; };
layout(std430, set = 1, binding = 3) readonly buffer Payloads { vec4 payloads[]; };
layout(std430, set = 1, binding = 4) readonly buffer WinnerColors { PAIR winner_colors[]; };
layout(std430, set = 1, binding = 5) readonly buffer Listed { uint listed[]; };
layout(std430, set = 1, binding = 6) readonly buffer Arguments { uint arguments[]; }; // the fourth: pixels listed

// Uniform values, taken once.
struct Taken {
  uint width;
  ivec2 last;
  float focal, inverse_focal;
  vec2 offset;
};
Taken taken() {
  return Taken(step.width, ivec2(int(step.width), int(step.height)) - 1, frame.viewport.z,
               frame.viewport.w + frame.depth_near.y, frame.sample_near_far.xy);
}

uint index_of(Taken u, ivec2 pixel) {
  ivec2 p = clamp(pixel, ivec2(0), u.last); // beyond the picture: its edge
  return uint(p.y) * u.width + uint(p.x);
}

// What covers a pixel, nearest first; the four nearest.
float key0, key1, key2, key3, cover0, cover1, cover2, cover3;
uvec2 color0, color1, color2, color3;
void no_covers() {
  key0 = key1 = key2 = key3 = infinitely_far;
  cover0 = cover1 = cover2 = cover3 = 0.0;
  color0 = color1 = color2 = color3 = uvec2(0u);
}
#define SINK(k, c, col) { \
  bool nearer = key < k; \
  float next_key = nearer ? k : key, next_cover = nearer ? c : cover; \
  uvec2 next_color = nearer ? col : color; \
  k = nearer ? key : k; c = nearer ? cover : c; col = nearer ? color : col; \
  key = next_key; cover = next_cover; color = next_color; }
void add_cover(float key, float cover, uvec2 color) {
  SINK(key0, cover0, color0)
  SINK(key1, cover1, color1)
  SINK(key2, cover2, color2)
  SINK(key3, cover3, color3)
}

// The particle that owns pixel `at`, if `some`: what it covers of the pixel of the ray (x, y, 1).
void cover_by(Taken u, uint at, bool some, vec2 ray) {
  vec4 payload[payload_vec4s];
  payload[0] = payloads[at];
  uvec2 color = words(winner_colors[at]);
  float key;
  Outline o = tile_outline(unpack(payload), ray.x, ray.y, u.focal, key);
  float cover = disc_coverage(o.offset, o.radius, o.inside, o.inward);
  some = some && cover > 0.0; // what covers nothing takes no place of the four
  add_cover(some ? key : infinitely_far, some ? cover : 0.0, color);
}

// The eight neighbors, nearest first: two bits each of x + 1 and of y + 1.
const uint neighbors_x = 0x8861u, neighbors_y = 0xA094u;
ivec2 neighbor(uint i) { return ivec2(int(neighbors_x >> (2u * i) & 3u), int(neighbors_y >> (2u * i) & 3u)) - 1; }

vec4 blended(Taken u, ivec2 pixel, uint at, vec4 background) {
  uint own = names[at], name[8];
  uint fresh = 0u; // neighbors of other particles, each particle once
  bool own_empty = own == no_winner, empty = own_empty;
#define LOOK(i) name[i] = names[index_of(u, pixel + neighbor(uint(i)))];
  LOOK(0) LOOK(1) LOOK(2) LOOK(3) LOOK(4) LOOK(5) LOOK(6) LOOK(7)
#define OTHER(j) other = other && who != name[j];
#define JUDGE(i, earlier) { \
  uint who = name[i]; \
  bool none = who == no_winner, other = !none && who != own; \
  empty = empty || none; \
  earlier \
  fresh |= other ? 1u << i : 0u; }
  JUDGE(0, ) JUDGE(1, OTHER(0)) JUDGE(2, OTHER(0) OTHER(1)) JUDGE(3, OTHER(0) OTHER(1) OTHER(2))
  JUDGE(4, OTHER(0) OTHER(1) OTHER(2) OTHER(3)) JUDGE(5, OTHER(0) OTHER(1) OTHER(2) OTHER(3) OTHER(4))
  JUDGE(6, OTHER(0) OTHER(1) OTHER(2) OTHER(3) OTHER(4) OTHER(5)) JUDGE(7, OTHER(0) OTHER(1) OTHER(2) OTHER(3) OTHER(4) OTHER(5) OTHER(6))

  vec2 ray = (vec2(pixel) + u.offset) * u.inverse_focal;
  no_covers();
  cover_by(u, at, !own_empty, ray);
  do {
    uint i = uint(max(findLSB(fresh), 0));
    cover_by(u, index_of(u, pixel + neighbor(i)), fresh != 0u, ray);
    fresh &= fresh - 1u;
  } while (fresh != 0u);

  float rest = 1.0;
  vec3 color = vec3(0.0), last = vec3(0.0);
#define OVER(c, col) { \
  last = cover_of(c) ? vec3(unpackHalf2x16(col.x), unpackHalf2x16(col.y).x) : last; \
  color += rest * c * last; \
  rest *= 1.0 - c; }
#define cover_of(c) (c > 0.0)
  OVER(cover0, color0) OVER(cover1, color1) OVER(cover2, color2) OVER(cover3, color3)
  float behind = empty ? rest * background.a : rest;
  color += behind * (empty ? background.rgb : last);
  float alpha = 1.0 - rest + behind;
  return alpha > 0.0 ? vec4(color / alpha, alpha) : vec4(0.0);
}

void main() {
  Taken u = taken();
  uint count = arguments[3], i = (gl_WorkGroupID.y * edge_groups + gl_WorkGroupID.x) * uint(LANES) + gl_LocalInvocationID.x;
  ivec2 pixel = ivec2(listed_pixel(listed[min(i, count - 1u)]));
  uint at = index_of(u, pixel);
  vec4 color = map_pixel(blended(u, pixel, at, step.material));
  if (i < count) write_color(at, color);
}
