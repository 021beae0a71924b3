// SPDX-License-Identifier: MIT
// Analytic edges by tiles: what a cast keeps of each pixel's nearest particle for outlines.comp and edges.comp: its name, its payload
// and the color that it has here (half floats). A name is a mixture of the payload's words, so that neighbors are told apart by one
// word: two particles have the same once in 2^32 pairs, and the outline between them stays as it was cast.
#ifndef MOTE_TILES_WINNERS_GLSL
#define MOTE_TILES_WINNERS_GLSL

const uint no_winner = 0xFFFFFFFFu; // pixels are cleared to it

uint winner_name(vec4 payload) {
  uvec4 w = floatBitsToUint(payload);
  uint h = w.x * 0x9E3779B1u;
  h = (h ^ (h >> 15) ^ w.y) * 0x85EBCA77u;
  h = (h ^ (h >> 13) ^ w.z) * 0xC2B2AE3Du;
  h = (h ^ (h >> 16) ^ w.w) * 0x27D4EB2Fu;
  h ^= h >> 15;
  return h == no_winner ? 0u : h;
}

// outlines.comp lists the pixels of outlines for edges.comp, which takes them LANES a workgroup, so many workgroups a row of them.
const uint edge_groups = 256u; // as in tile_edges.cpp
uint pack_pixel(uvec2 pixel) { return pixel.x | pixel.y << 16; }
uvec2 listed_pixel(uint word) { return uvec2(word & 0xFFFFu, word >> 16); }

#endif
