// SPDX-License-Identifier: MIT
// Which particles of a chunk are seen: the tiles that one may cover, whether what was cast there hides it, and the bits that keep the
// answer for the next frame (work.glsl).
#ifndef MOTE_TILES_SEEN_GLSL
#define MOTE_TILES_SEEN_GLSL

#include "particles/tiles/chunk.glsl"

// The number of the n-th bit that is set, n from 0; 63 if there are fewer.
#define HALVE(size) { \
  uint below = uint(bitCount(word & ((1u << (size)) - 1u))); \
  bool above = n >= below; \
  n -= above ? below : 0u; \
  word >>= above ? (size) : 0u; \
  number += above ? (size) : 0u; }
uint bit_at(uvec2 bits, uint n) {
  uint low = uint(bitCount(bits.x)), word = n < low ? bits.x : bits.y, number = n < low ? 0u : 32u;
  n -= n < low ? 0u : low;
  HALVE(16u)
  HALVE(8u)
  HALVE(4u)
  HALVE(2u)
  HALVE(1u)
  return number;
}

uvec2 bit_of(uint number) { return number < 32u ? uvec2(1u << number, 0u) : uvec2(0u, 1u << (number - 32u)); }

// Uniform values, taken once.
struct Reach {
  float focal;
  vec2 offset, last_pixel;
};
Reach take_reach() { return Reach(frame.viewport.z, frame.sample_near_far.xy, vec2(float(step.width), float(step.height)) - 1.0); }

layout(constant_id = 21) const float pixel_reach = 0.02; // how far from its center a pixel is met; a fiftieth for rounding

// The tiles whose pixels the proxy may meet, as (lo, hi); empty where lo.x > hi.x.
uvec4 tile_rect(Reach u, Proxy bounds) {
  vec2 lo = bounds.lo * u.focal - u.offset - pixel_reach, hi = bounds.hi * u.focal - u.offset + pixel_reach;
  vec2 first = max(ceil(lo), vec2(0.0)), last = min(floor(hi), u.last_pixel);
  bool empty = !(first.x <= last.x && first.y <= last.y);
  uvec2 tile_lo = uvec2(first) >> 3, tile_hi = uvec2(max(last, vec2(0.0))) >> 3;
  return empty ? uvec4(1u, 1u, 0u, 0u) : uvec4(tile_lo, tile_hi);
}

// The bits of all invocations.
uvec2 bits_of_all(uvec2 bits) { return uvec2(subgroupOr(bits.x), subgroupOr(bits.y)); }
void keep_seen(uint flag, uvec2 bits) {
  bits = bits_of_all(bits);
  if (subgroupElect()) flags[flag] = pair(bits);
}

#endif
