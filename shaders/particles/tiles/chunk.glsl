// SPDX-License-Identifier: MIT
// A placed chunk as the kernels of tiles and of splats load it: one workgroup a chunk, one subgroup a workgroup. What is the same
// for all particles is loaded once, word by word, one word a lane, and handed round.
#ifndef MOTE_TILES_CHUNK_GLSL
#define MOTE_TILES_CHUNK_GLSL

#include "particles/tiles/binning.glsl"

layout(std430, set = 1, binding = 0) readonly buffer Records { uvec4 records[]; };
layout(std430, set = 1, binding = 1) readonly buffer Rows { uint rows[]; };
#define COLORS_BINDING 2
#define COLOR_INDICES_BINDING 3
#include "particles/own_color.glsl"

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

struct Chunk {
  Placement at;
  uvec2 rect_lo, rect_hi; // tiles
  uint first, place;      // of its records, and of its particles in the round (place.comp)
  uint id_base, material;
  uint flag;              // where it keeps which of its particles were seen
  vec3 color;
  bool colored;
};

// Placed chunk `at`, the same for the whole subgroup.
Chunk load_chunk(uint at) {
  uint w[8];
  Chunk chunk;
  WORDS(chunks, at * chunk_words)
  chunk.at.origin = uintBitsToFloat(uvec3(w[0], w[1], w[2]));
  chunk.rect_lo = corner(w[4]);
  chunk.rect_hi = corner(w[5]);
  chunk.first = w[6] * chunk_capacity;
  chunk.flag = w[6];
  uint draw = draw_of(w[7]);
  WORDS(draws, draw)
  chunk.at.linear[0] = uintBitsToFloat(uvec3(w[0], w[1], w[2]));
  chunk.at.linear[1] = uintBitsToFloat(uvec3(w[4], w[5], w[6]));
  chunk.at.scale = uintBitsToFloat(w[3]);
  chunk.id_base = w[7];
  WORDS(draws, draw + 8u)
  chunk.at.linear[2] = uintBitsToFloat(uvec3(w[0], w[1], w[2]));
  chunk.flag += w[3];
  chunk.color = uintBitsToFloat(uvec3(w[4], w[5], w[6]));
  chunk.material = w[7] & 0xFFFFu;
  chunk.colored = (w[7] >> 31) != 0u;
  return chunk;
}

// Record `slot` of the slice.
Particle place_record(uint slot, Placement at) {
  vec4 record[record_vec4s];
  for (int i = 0; i < record_vec4s; ++i) record[i] = uintBitsToFloat(records[slot * uint(record_vec4s) + uint(i)]);
  return place(record, at);
}

#endif
