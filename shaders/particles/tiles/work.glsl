// SPDX-License-Identifier: MIT
// Expansion `compute`: what its kernels share. Mirrors passes/particles/tiles/tile_blocks.hpp.
//
// A frame is a few *steps*. A step takes some of the placed chunks (cull), of those that were drawn in part chooses the particles that
// are still to be drawn (sift), and in *rounds* whose memory is bounded
// by construction brings their particles into view space and files them under tiles of 8x8 pixels (place). A tile has
// `tile_room` places of its own; what does not fit goes to a list, for which room is made (allocate) and which is filed in
// a second go (scatter). Then each tile is cast (cast). Between steps the farthest depth of every tile, and of blocks of
// tiles, hides what lies behind (far).
//
// A frame whose entries fit in one round is *gathered* where that is asked for: a step's entries join those of the step before, and tiles
// that got any are cast anew from all. So no cast needs to know what another has left in a pixel.
//
// Chunks whose particles all cover at most three pixel centers in x and in y are not filed: each of their particles writes
// itself where it is nearest (splat), with atomic minima of 64 bits, and what stands at the frame's end is shaded then
// (resolve_splats). Before other chunks are tested, tiles learn how far the splats in them reach (splat_far).
#ifndef MOTE_TILES_WORK_GLSL
#define MOTE_TILES_WORK_GLSL

// Two words in one access: a CPU device walks through its lanes for every access to a buffer, whatever its width.
#ifdef INT64
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#define PAIR uint64_t
uvec2 words(PAIR pair) { return unpackUint2x32(pair); }
PAIR pair(uvec2 w) { return packUint2x32(w); }
#else
#define PAIR uvec2
uvec2 words(PAIR pair) { return pair; }
PAIR pair(uvec2 w) { return w; }
#endif

const uint chunk_capacity = 64u;
const int tile_size = 8;

// A CPU device gathers uniform values lane by lane at every use: loops take them into locals first.
layout(push_constant) uniform StepBlock {
  uint first, count;        // placed chunks of this step
  uint others;              // bit 0: not the particles that were seen in frames before but the rest, tested against the depth so far;
                            // bit 1: something was cast before in this frame; bits 2..4: chunks of which number look anew (looks_anew);
                            // bit 5: what cull has chosen is sifted; bit 6: the frame is gathered
  uint region;              // of this step's arguments, in uints: one cursor, then a block for each round
  uint round;
  uint slice, slices;       // buffers of records
  uint capacity;            // entries that are reserved for one round, roughly
  uint list_capacity;       // chunks of one round and slice at most
  uint tiles_x, tiles_y;
  uint level1, level2, level3; // where the coarser levels start in `far`; level 0 starts at 0
  uint width, height;       // pixels
  uint tile_room;           // entries that a tile holds by itself
  uint spilled;             // where the list of entries without a place starts in `entries`
  float depth_origin, depth_scale; // of entries' steps of depth
  vec4 material;            // of all batches, with one_material
  vec4 background;          // with analytic edges: scene-linear
  uint place_first;         // in a gathered frame: places of chunks that earlier steps may have taken
} step;

// Words of a placed chunk, a chunk of one instance that the view may see:
//   0..2 origin in view space, formed in double; 3 z_min, nothing of it is nearer; 4, 5 the tiles it may cover, lo and hi
//   (corner() of each; bits 24..31: tiles that one of its particles may cover in x, y); 6 its index in its slice; 7 its draw and, in
//   bits 30 and 31, the pixels that one of its particles may cover in x or y if it is drawn by splats, else 0
const uint chunk_words = 8u;
// Words of a draw, one for each (batch, instance, slice):
//   0..2 linear0, 3 scale, 4..6 linear1, 7 id_base, 8..10 linear2, 11 first_flag, 12..14 color,
//   15 material (bits 0..15), slice (16..30), whether particles have colors of their own (31)
const uint draw_words = 16u;

// A corner of a rectangle of tiles: x in bits 0..11, y in 12..23.
uvec2 corner(uint packed_xy) { return uvec2(packed_xy & 0xFFFu, (packed_xy >> 12) & 0xFFFu); }
uint pack_corner(uvec2 tile) { return tile.x | tile.y << 12; }

// Which particles of a chunk were not hidden in frames before: a bit each. The first step of a frame draws those; the steps of the
// others look at the rest of all chunks that are not hidden whole, draw what they find and keep its bit. Bits of what is hidden by now
// go when the whole chunk is hidden, or when its number comes, every eighth frame: what was seen a moment ago may be seen again.
const uint most_anew = 8u;
bool looks_anew(uint flag, uint others) { return (flag & (most_anew - 1u)) == ((others >> 2) & (most_anew - 1u)); }

uint draw_of(uint word) { return (word & 0x3FFFFFFFu) * draw_words; } // word 7 of a chunk: where its draw's words start
uint splat_side(uint word) { return word >> 30; }

// The arguments of splats: (workgroups, 1, 1, chunks on the list, where the list starts, and 3 words without use) for each
// slice and side of 1 to 3 pixels.
const uint splat_words = 8u, splat_sides = 3u;
uint splat_arguments(uint slice, uint side) { return step.region + 4u + splat_words * (slice * splat_sides + side - 1u); }
const uint most_splat_groups = 16384u; // each takes one chunk after the other
// Of splat_far: (tiles in x, in y, 1, 0), no workgroups in x until so many splats were taken that it is worth its time.
uint splat_far_arguments() { return step.region + 4u + splat_words * splat_sides * step.slices; }
// Where the arguments of a round start: (x, 1, 1, 0) for each slice's place, for allocate, for cast, for scatter, for each slice's sift.
uint round_arguments(uint round) { return splat_far_arguments() + 4u + round * 4u * (2u * step.slices + 3u); }
uint slice_arguments(uint round, uint slice) { return round_arguments(round) + 4u * slice; }
uint allocate_arguments(uint round) { return round_arguments(round) + 4u * step.slices; }
uint cast_arguments(uint round) { return round_arguments(round) + 4u * (step.slices + 1u); }
uint scatter_arguments(uint round) { return round_arguments(round) + 4u * (step.slices + 2u); } // its 4th: list_counter()

uint sift_arguments(uint round, uint slice) { return round_arguments(round) + 4u * (step.slices + 3u + slice); }

bool sifted(uint others) { return (others & 32u) != 0u; }
bool gathered(uint others) { return (others & 64u) != 0u; }
// How many entries are on the list: of this round, or of the frame (counted where its first step starts).
uint list_counter() { return scatter_arguments(step.round) + 3u - (gathered(step.others) ? step.region : 0u); }
// Chunks that cull has taken: placed chunks, a word each; and what sift has left of them: three words each, with the bits of particles.
const uint sifted_words = 3u;
uint list_at(uint round, uint slice) { return (round * step.slices + slice) * (1u + sifted_words) * step.list_capacity; }
uint sifted_at(uint round, uint slice) { return list_at(round, slice) + step.list_capacity; }

// Words of all tiles: how many entries each has while placing (close together: they are counted up all over the image), then cursors
// in the list's part, then numbers of entries.
uint tile_cursor(uint tile) { return step.level1 + tile; }
uint tile_end(uint tile) { return 2u * step.level1 + tile; }

// An entry: the place of a particle in its round and, above it, the step of depth in which its nearest point lies. One word, since
// entries are written all over memory. Steps grow with depth, so what lies before a depth has no larger step than it has.
const uint place_bits = 20u, last_depth_step = 4095u;
uint depth_step(float z, float origin, float scale) { return uint(clamp((z - origin) * scale, 0.0, float(last_depth_step))); }
uint place_of(uint entry) { return entry & ((1u << place_bits) - 1u); }

// Where a shadow map that stays in buffers has a texel: tile by tile, so that those around a point lie near each other. The sum of both.
uint tiled_column(uint x) { return (x >> 3) * 64u + (x & 7u); }
uint tiled_row(uint y, uint tiles_x) { return ((y >> 3) * tiles_x * 8u + (y & 7u)) * 8u; }

const uint no_particle = 0xFFFFFFFFu;
const float infinitely_far = 3e38; // keys of pixels without a particle: depth times |ray|^2

#endif
