#version 460
// SPDX-License-Identifier: MIT
// Analytic edges by tiles: a pixel next to one of another particle is composited, front to back, of what each of the particles that
// own it and its eight neighbors covers of it (closed forms, common/coverage.glsl) with the color that the particle has in the
// pixel it owns. What they leave is the background where a neighbor is empty, else the farthest's.
//
// A workgroup, one subgroup, looks at 64 pixels, LANES a row, and blends those at an outline, LANES at a time.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "particles/interface.glsl"
#include "particles/tiles/work.glsl"
#include "particles/tiles/winners.glsl"
#include "common/coverage.glsl"
#define COLOR_BINDING 1
#define COLOR_PAIRS_BINDING 2
#include "particles/tiles/color_out.glsl"

layout(local_size_x = LANES) in;
const int rows = 64 / LANES;

layout(std430, set = 1, binding = 0) readonly buffer Winners { PAIR winners[]; };

// Uniform values, taken once.
struct Taken {
  uint width, pixels;
  ivec2 last;
  float focal, inverse_focal;
  vec2 offset;
};
Taken taken() {
  return Taken(step.width, step.width * step.height, ivec2(int(step.width), int(step.height)) - 1, frame.viewport.z,
               frame.viewport.w + frame.depth_near.y, frame.sample_near_far.xy);
}

uint index_of(Taken u, ivec2 pixel) {
  ivec2 p = clamp(pixel, ivec2(0), u.last); // beyond the picture: its edge
  return uint(p.y) * u.width + uint(p.x);
}
uvec2 name_at(Taken u, ivec2 pixel) { return words(winners[index_of(u, pixel)]); }
bool differ(uvec2 a, uvec2 b) { return ((a.x ^ b.x) | (a.y ^ b.y)) != 0u; }

// Which of the 64 pixels have a neighbor of another particle; bit row * LANES + lane.
uvec2 outlines(Taken u, ivec2 base) {
  ivec2 at = base + ivec2(int(gl_LocalInvocationID.x), -1);
  bool inside = at.x <= u.last.x;
  uvec2 up_l = name_at(u, at - ivec2(1, 0)), up = name_at(u, at), up_r = name_at(u, at + ivec2(1, 0));
  ++at.y;
  uvec2 own_l = name_at(u, at - ivec2(1, 0)), own = name_at(u, at), own_r = name_at(u, at + ivec2(1, 0));
  uvec2 bits = uvec2(0u);
  uint row = 0u;
  do {
    ++at.y;
    uvec2 down_l = name_at(u, at - ivec2(1, 0)), down = name_at(u, at), down_r = name_at(u, at + ivec2(1, 0));
    uvec2 d = (up_l ^ own) | (up ^ own) | (up_r ^ own) | (own_l ^ own) | (own_r ^ own) | (down_l ^ own) | (down ^ own) | (down_r ^ own);
    uint ballot = subgroupBallot((d.x | d.y) != 0u && inside && at.y - 1 <= u.last.y).x, shift = row * uint(LANES);
    bits.x |= shift < 32u ? ballot << shift : 0u;
    bits.y |= shift < 32u ? 0u : ballot << (shift & 31u);
    up_l = own_l; up = own; up_r = own_r;
    own_l = down_l; own = down; own_r = down_r;
    ++row;
  } while (row < uint(rows));
  return bits;
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
void cover_by(Taken u, uint at, uvec2 name, bool some, vec2 ray) {
  vec4 payload[payload_vec4s];
  payload[0] = winner_payload(name, words(winners[u.pixels + 2u * at]));
  uvec2 color = words(winners[u.pixels + 2u * at + 1u]);
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
  uvec2 own = words(winners[at]);
  uvec2 name[8];
  uint fresh = 0u; // neighbors of other particles, each particle once
  bool empty = !differ(own, no_winner), own_empty = empty;
#define LOOK(i) name[i] = name_at(u, pixel + neighbor(uint(i)));
  LOOK(0) LOOK(1) LOOK(2) LOOK(3) LOOK(4) LOOK(5) LOOK(6) LOOK(7)
#define OTHER(j) other = other && differ(own_name, name[j]);
#define JUDGE(i, earlier) { \
  uvec2 own_name = name[i]; \
  bool none = !differ(own_name, no_winner), other = !none && differ(own_name, own); \
  empty = empty || none; \
  earlier \
  fresh |= other ? 1u << i : 0u; }
  JUDGE(0, ) JUDGE(1, OTHER(0)) JUDGE(2, OTHER(0) OTHER(1)) JUDGE(3, OTHER(0) OTHER(1) OTHER(2))
  JUDGE(4, OTHER(0) OTHER(1) OTHER(2) OTHER(3)) JUDGE(5, OTHER(0) OTHER(1) OTHER(2) OTHER(3) OTHER(4))
  JUDGE(6, OTHER(0) OTHER(1) OTHER(2) OTHER(3) OTHER(4) OTHER(5)) JUDGE(7, OTHER(0) OTHER(1) OTHER(2) OTHER(3) OTHER(4) OTHER(5) OTHER(6))

  vec2 ray = (vec2(pixel) + u.offset) * u.inverse_focal;
  no_covers();
  cover_by(u, at, own, !own_empty, ray);
  do {
    uint i = uint(max(findLSB(fresh), 0)), there = index_of(u, pixel + neighbor(i));
    uvec2 who = name[0];
#define PICK(k) who = i == uint(k) ? name[k] : who;
    PICK(1) PICK(2) PICK(3) PICK(4) PICK(5) PICK(6) PICK(7)
    cover_by(u, there, who, fresh != 0u, ray);
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
  vec4 background = step.material;
  ivec2 base = ivec2(gl_WorkGroupID.xy) * ivec2(LANES, rows);
  uvec2 bits = outlines(u, base);
  do {
    uint mine = 0u, l = 0u;
    bool some = false;
    do { // the next LANES of them, one an invocation
      bool low = bits.x != 0u, any = (bits.x | bits.y) != 0u, me = gl_LocalInvocationID.x == l;
      uint next = low ? uint(findLSB(bits.x)) : 32u + uint(max(findLSB(bits.y), 0));
      mine = me && any ? next : mine;
      some = some || (me && any);
      bits = low ? uvec2(bits.x & (bits.x - 1u), bits.y) : uvec2(0u, bits.y & (bits.y - 1u));
      ++l;
    } while (l < uint(LANES));
    ivec2 pixel = base + ivec2(int(mine % uint(LANES)), int(mine / uint(LANES)));
    uint at = index_of(u, pixel);
    vec4 color = map_pixel(blended(u, pixel, at, background));
    if (some) write_color(at, color);
  } while ((bits.x | bits.y) != 0u);
}
