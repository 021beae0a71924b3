#version 460
// SPDX-License-Identifier: MIT
// Casts one tile: 8x8 pixels against the particles filed under it, nearest wins; then what won is shaded, or left as a
// surface to be shaded later, or as the caster of a shadow map's texel.
//
// A workgroup is one subgroup of LANES invocations (LANES is at most the device's smallest subgroup); each owns
// 64 / LANES pixels in registers. BATCH particles are loaded at a time, one an invocation, and broadcast one by one.
// Entries come roughly front to back; a batch that lies behind all pixels is passed over. Everything is unrolled by
// macros on arrays: a CPU device keeps them in registers only if every index is a constant. Particles are handed
// round by shuffles with a constant lane, which are one instruction there; broadcasts search for an active lane.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "particles/interface.glsl"
#include "particles/tiles/work.glsl"
#include "particles/tiles/resolve.glsl"

layout(local_size_x = LANES) in;
const int pixels = 64 / LANES; // of one invocation

layout(std430, set = 1, binding = 1) readonly buffer Payloads { uvec4 payloads[]; };
layout(std430, set = 1, binding = 2) readonly buffer Colors { PAIR placed_colors[]; };
layout(std430, set = 1, binding = 3) readonly buffer Ids { uint placed_ids[]; };
layout(std430, set = 1, binding = 4) readonly buffer Tiles { uint tiles[]; };
layout(std430, set = 1, binding = 5) buffer Far { float far[]; };
layout(std430, set = 1, binding = 6) readonly buffer Active { uint active_tiles[]; };
layout(std430, set = 1, binding = 7) readonly buffer Entries { uint entries[]; };

uint lane() { return gl_LocalInvocationID.x; }
// Pixel k of this invocation, within the tile.
uvec2 pixel_of(int k) {
  uint number = uint(k * LANES) + lane();
  return uvec2(number & 7u, number >> 3);
}

#define FOR_4(M, b) M(b) M(b + 1) M(b + 2) M(b + 3)
#define FOR_8(M, b) FOR_4(M, b) FOR_4(M, b + 4)
#if LANES == 4
#define FOR_PIXELS(M) FOR_8(M, 0) FOR_8(M, 8)
#elif LANES == 8
#define FOR_PIXELS(M) FOR_8(M, 0)
#elif LANES == 16
#define FOR_PIXELS(M) FOR_4(M, 0)
#elif LANES == 32
#define FOR_PIXELS(M) M(0) M(1)
#endif
// Particles that are loaded and tested at a time. Narrow subgroups take fewer than they could: tiles hold few, pipelines are made sooner.
#if LANES <= 8 && !defined(TILE_TOUCHES)
#define BATCH 4
#else
#define BATCH LANES
#endif
#if BATCH == 4
#define FOR_BATCH(M) FOR_4(M, 0)
#elif BATCH == 8
#define FOR_BATCH(M) FOR_8(M, 0)
#elif BATCH == 16
#define FOR_BATCH(M) FOR_8(M, 0) FOR_8(M, 8)
#elif BATCH == 32
#define FOR_BATCH(M) FOR_8(M, 0) FOR_8(M, 8) FOR_8(M, 16) FOR_8(M, 24)
#endif
uint turn() { return lane() % uint(BATCH); } // in the batch

// An invocation's pixels: rays, the key of what is nearest, and what that is. Not in main(), so that functions work on them: of the test of all
// pixels SPIR-V then holds one copy instead of one for each lane.
float ray_x[pixels], ray_y[pixels], key[pixels];
uint won[pixels];

Particle load_particle(uint at) {
  vec4 payload[payload_vec4s];
  for (int i = 0; i < payload_vec4s; ++i) payload[i] = uintBitsToFloat(payloads[at * uint(payload_vec4s) + uint(i)]);
  return unpack(payload);
}

Winner winner_at(uint who) {
  uvec2 packed_color = words(placed_colors[who]);
  Winner winner = Winner(load_particle(who), vec3(unpackHalf2x16(packed_color.x), unpackHalf2x16(packed_color.y).x), packed_color.y >> 16, 0u);
  if (want_id()) winner.id = placed_ids[who];
  return winner;
}

#ifdef ANALYTIC_EDGES
#include "particles/tiles/layers.glsl"
#else
#define TEST_PIXEL(k) if (tile_nearer(test, ray_x[k], ray_y[k], key[k])) won[k] = who;
#define START_PIXEL(k, inside, again, at) { \
  key[k] = !inside ? -1.0 : infinitely_far; \
  if (inside && again) key[k] = nearest[at]; \
  won[k] = no_particle; }

// Only rows of pixels in which something changed: in later rounds few do.
void resolve_pixels(Taken u, uvec2 base) {
  uint changed = 0u;
#define CHANGED(k) changed |= won[k] != no_particle ? 1u << (k) : 0u;
  FOR_PIXELS(CHANGED)
  changed = subgroupOr(changed);
  do {
    int row = findLSB(changed);
    float row_key = 0.0;
    uint row_won = no_particle;
    vec2 row_ray = vec2(ray_x[0], 0.0);
#define SELECT(k) { bool me = row == (k); row_key = me ? key[k] : row_key; row_won = me ? won[k] : row_won; \
  row_ray = me ? vec2(ray_x[k], ray_y[k]) : row_ray; }
    FOR_PIXELS(SELECT)
    bool row_changed = row_won != no_particle;
    resolve(u, base + pixel_of(row), row_ray, row_key, row_changed, winner_at(row_changed ? row_won : 0u));
    changed &= changed - 1u;
  } while (changed != 0u);
}
#endif

// Against one particle of the batch.
#ifndef TILE_LOOP
void test_all(TileTest test, uint who) { FOR_PIXELS(TEST_PIXEL) }
#endif
#define TEST_LANE(l) test_all(TileTest(subgroupShuffle(mine.a, uint(l)), subgroupShuffle(mine.b, uint(l)), subgroupShuffle(mine.c, uint(l))), subgroupShuffle(entry, uint(l)));

#ifdef TILE_LOOP
// A type whose test is long says so: one copy of it instead of LANES * pixels, which devices would take minutes to compile.
#define PICK_PIXEL(k) { bool me = pixel == (k); x = me ? ray_x[k] : x; y = me ? ray_y[k] : y; own_key = me ? key[k] : own_key; }
#define PUT_PIXEL(k) { bool me = nearer && pixel == (k); key[k] = me ? own_key : key[k]; won[k] = me ? who : won[k]; }
#define TEST_BATCH { \
  uint l = 0u; \
  do { \
    TileTest test = TileTest(subgroupShuffle(mine.a, l), subgroupShuffle(mine.b, l), subgroupShuffle(mine.c, l)); \
    uint who = subgroupShuffle(entry, l); \
    int pixel = 0; \
    do { \
      float x = 0.0, y = 0.0, own_key = 0.0; \
      FOR_PIXELS(PICK_PIXEL) \
      bool nearer = tile_nearer(test, x, y, own_key); \
      FOR_PIXELS(PUT_PIXEL) \
      ++pixel; \
    } while (pixel < pixels); \
    ++l; \
  } while (l < uint(BATCH)); }
#elif defined(TILE_TOUCHES)
// A long type: only those of the batch that touch the tile and are not hidden, one after the other. A shuffle from a lane that is
// no constant costs more than one that is, and less than the test.
#define TEST_BATCH { \
  uint touching = subgroupBallot(alive).x & (0xFFFFFFFFu >> (32 - BATCH)); \
  do { \
    uint l = uint(max(findLSB(touching), 0)); \
    TileTest test = TileTest(subgroupShuffle(mine.a, l), subgroupShuffle(mine.b, l), subgroupShuffle(mine.c, l)); \
    test_all(test, subgroupShuffle(entry, l)); \
    touching &= touching - 1u; \
  } while (touching != 0u); }
#else
#define TEST_BATCH FOR_BATCH(TEST_LANE)
#endif

#define FARTHEST(k) farthest = max(farthest, key[k]);
// Where no pixel of the tile is open: the farthest depth, from keys (depth times |ray|^2) and the tile's least |ray|^2.
float farthest_depth(float farthest_key, float least_ray2) {
  float farthest = subgroupMax(farthest_key);
  return farthest >= infinitely_far ? uintBitsToFloat(0x7F800000u) : farthest / least_ray2 * (1.0 + 2e-6);
}

void main() {
  uint tile = active_tiles[gl_WorkGroupID.x];
  uint cursor = tiles[tile_cursor(tile)], end = tiles[tile_end(tile)], at = 0u;
  uint own = tile * step.tile_room, spilled = cursor - (end - min(end, step.tile_room)) - step.tile_room; // entry k is there + k
  uvec2 base = uvec2(tile % step.tiles_x, tile / step.tiles_x) * uint(tile_size);

  // Rays to visibility's precision: a ten-thousandth of a pixel. resolve() forms the exact ones.
  Taken u = take();
  uint height = step.height, room = step.tile_room;
  bool again = (step.others & 2u) != 0u; // a variant of the pipeline for the first round would take longer to make than it saves
  vec2 offset = vec2(base) + u.sample_near_far.xy;
  float inverse_focal = u.viewport.w + u.inverse_rest;
#ifdef ANALYTIC_EDGES
  tile_band = outline_reach * inverse_focal;
#endif
#define START(k) { \
  uvec2 p = pixel_of(k); \
  ray_x[k] = (offset.x + float(p.x)) * inverse_focal; \
  ray_y[k] = (offset.y + float(p.y)) * inverse_focal; \
  bool inside = base.x + p.x < u.width && base.y + p.y < height; \
  uint pixel = (base.y + p.y) * u.width + base.x + p.x; \
  START_PIXEL(k, inside, again, pixel) }
  FOR_PIXELS(START)
  vec2 least = max(max(offset, -(offset + float(tile_size - 1))), vec2(0.0)) * inverse_focal;
  float least_ray2 = orthographic ? 1.0 : 1.0 + dot(least, least);
#ifdef TILE_TOUCHES
  vec2 middle = (offset + 0.5 * float(tile_size - 1)) * inverse_focal;
  float reach = (0.72 * float(tile_size - 1) + 1.5 * proxy_slack) * inverse_focal; // to its corners' pixels
#endif
  float hidden_from = far[tile];
  float depth_origin = step.depth_origin, depth_scale = step.depth_scale;
  uint hidden_step = depth_step(hidden_from, depth_origin, depth_scale);

  do {
    // The next BATCH entries of which at least one may be seen.
    uint entry;
    bool alive;
    do {
      uint mine_at = min(at + turn(), end - 1u);
      entry = entries[(mine_at < room ? own : spilled) + mine_at];
      alive = at + turn() < end && entry >> place_bits <= hidden_step;
      at += uint(BATCH);
    } while (at < end && !subgroupAny(alive));
    entry = place_of(entry);
    Particle particle = load_particle(entry);
#ifdef TILE_TOUCHES
    alive = alive && tile_touches(particle, middle, reach);
#endif
    TileTest mine = tile_test(particle, alive);
    TEST_BATCH
    float farthest = 0.0;
    FOR_PIXELS(FARTHEST)
    hidden_from = min(hidden_from, farthest_depth(farthest, least_ray2)); // splats may hide more
    hidden_step = depth_step(hidden_from, depth_origin, depth_scale);
  } while (at < end);

  if (subgroupElect()) far[tile] = hidden_from;

  resolve_pixels(u, base);
}
