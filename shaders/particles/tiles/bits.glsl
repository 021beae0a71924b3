// SPDX-License-Identifier: MIT
// Sets of up to 64 things, a bit each.
#ifndef MOTE_TILES_BITS_GLSL
#define MOTE_TILES_BITS_GLSL

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
bool has_bit(uvec2 bits, uint number) { return ((number < 32u ? bits.x : bits.y) >> (number & 31u) & 1u) != 0u; }
// How many bits below `number` are set.
uint bits_before(uvec2 bits, uint number) {
  uint below = (1u << (number & 31u)) - 1u;
  return uint(number < 32u ? bitCount(bits.x & below) : bitCount(bits.x) + bitCount(bits.y & below));
}

#endif
