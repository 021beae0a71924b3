#version 460
// SPDX-License-Identifier: MIT
// Casts one tile: 8x8 pixels against the particles filed under it, nearest wins; then what won is shaded, or left as a
// surface to be shaded later, or as the caster of a shadow map's texel.
//
// A workgroup is one subgroup of LANES invocations (LANES is at most the device's smallest subgroup); each owns
// 64 / LANES pixels in registers. LANES particles are loaded at a time, one an invocation, and broadcast one by one.
// Entries come roughly front to back; a batch that lies behind all pixels is passed over. Everything is unrolled by
// macros on local arrays: a CPU device keeps them in registers only if every index is a constant. Particles are handed
// round by shuffles with a constant lane, which are one instruction there; broadcasts search for an active lane.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "particles/interface.glsl"
#ifdef SHADOW_SET
#include "shadow/lit.glsl"
Lit lit = all_lit(); // at the surface that is being shaded
#define LIGHT_VISIBILITY(i) lit_by(lit, i)
#endif
#include "common/shading.glsl"
#include "particles/tiles/work.glsl"

#ifdef PIXEL_MAP
#extension GL_EXT_samplerless_texture_functions : require
#include "pixel_map.glsl" // made at run time: vec4 map_pixel(vec4), the display transform that would come next
#else
vec4 map_pixel(vec4 color) { return color; }
#endif

layout(local_size_x = LANES) in;
const int pixels = 64 / LANES; // of one invocation

layout(constant_id = 10) const uint aovs = 0u;           // bits: 1 depth, 2 id, 4 normal
layout(constant_id = 13) const bool one_material = true; // of all batches: StepBlock.material
layout(constant_id = 14) const uint color_words = 2u;    // of a pixel: 1 rgba8unorm, 2 rgba16float, 4 rgba32float; 0: no color
layout(constant_id = 15) const bool want_depth = false;  // the encoded depth, for passes that draw after this one
layout(constant_id = 8) const uint type_number = 0u;     // phase shadow: the type, as a map of casters says it
layout(constant_id = 18) const int phase = 0;            // 0 opaque, 1 surface, 3 shadow, as in phase/surface.frag and phase/shadow.frag
layout(constant_id = 16) const bool display_only = false; // colors of 8 bits are all that is asked for: normals may err by 1e-4

layout(std430, set = 1, binding = 0) readonly buffer Materials { vec4 materials[]; };
layout(std430, set = 1, binding = 1) readonly buffer Payloads { PAIR payloads[]; };
layout(std430, set = 1, binding = 2) readonly buffer Colors { PAIR placed_colors[]; };
layout(std430, set = 1, binding = 3) readonly buffer Ids { uint placed_ids[]; };
layout(std430, set = 1, binding = 4) readonly buffer Tiles { uint tiles[]; };
layout(std430, set = 1, binding = 5) buffer Far { float far[]; };
layout(std430, set = 1, binding = 6) readonly buffer Active { uint active_tiles[]; };
layout(std430, set = 1, binding = 7) readonly buffer Entries { uint entries[]; };
layout(std430, set = 1, binding = 8) buffer Keys { float nearest[]; };       // per pixel: view depth times |ray|^2
layout(std430, set = 1, binding = 9) writeonly buffer OutColor { uint out_color[]; };       // rgba8unorm
layout(std430, set = 1, binding = 10) writeonly buffer OutEncoded { float out_encoded[]; };
layout(std430, set = 1, binding = 11) writeonly buffer OutDepth { float out_depth[]; };
layout(std430, set = 1, binding = 12) writeonly buffer OutId { uint out_id[]; };
layout(std430, set = 1, binding = 13) writeonly buffer OutNormal { vec4 out_normal[]; }; // surface: and depth; shadow: payload
layout(std430, set = 1, binding = 14) writeonly buffer OutColorPairs { PAIR out_color_pairs[]; }; // the wider formats

const float infinitely_far = 3e38; // what `nearest` is filled with before a frame

uint lane() { return gl_LocalInvocationID.x; }
// Pixel k of this invocation, within the tile.
uvec2 pixel_of(int k) {
#if LANES >= 8
  return uvec2(lane() & 7u, (lane() >> 3) + uint(k * (LANES / 8)));
#else
  return uvec2(lane() + uint(LANES * (k & (8 / LANES - 1))), uint(k / (8 / LANES)));
#endif
}

#if LANES == 4
#define FOR_LANES(M) M(0) M(1) M(2) M(3)
#define FOR_PIXELS(M) M(0) M(1) M(2) M(3) M(4) M(5) M(6) M(7) M(8) M(9) M(10) M(11) M(12) M(13) M(14) M(15)
#elif LANES == 8
#define FOR_LANES(M) M(0) M(1) M(2) M(3) M(4) M(5) M(6) M(7)
#define FOR_PIXELS(M) M(0) M(1) M(2) M(3) M(4) M(5) M(6) M(7)
#elif LANES == 16
#define FOR_LANES(M) M(0) M(1) M(2) M(3) M(4) M(5) M(6) M(7) M(8) M(9) M(10) M(11) M(12) M(13) M(14) M(15)
#define FOR_PIXELS(M) M(0) M(1) M(2) M(3)
#elif LANES == 32
#define FOR_8(M, b) M(b) M(b + 1) M(b + 2) M(b + 3) M(b + 4) M(b + 5) M(b + 6) M(b + 7)
#define FOR_LANES(M) FOR_8(M, 0) FOR_8(M, 8) FOR_8(M, 16) FOR_8(M, 24)
#define FOR_PIXELS(M) M(0) M(1)
#endif

// Against one particle of the batch.
#define TEST_PIXEL(k) if (tile_nearer(test, ray_x[k], ray_y[k], key[k])) won[k] = who;
#define TEST_LANE(l) { \
  TileTest test = TileTest(subgroupShuffle(mine.a, uint(l)), subgroupShuffle(mine.b, uint(l)), subgroupShuffle(mine.c, uint(l))); \
  uint who = subgroupShuffle(entry, uint(l)); \
  FOR_PIXELS(TEST_PIXEL) }

#define FARTHEST(k) farthest = max(farthest, key[k]);
// Where no pixel of the tile is open: the farthest depth, from keys (depth times |ray|^2) and the tile's least |ray|^2.
float farthest_depth(float farthest_key, float least_ray2) {
  float farthest = subgroupMax(farthest_key);
  return farthest >= infinitely_far ? uintBitsToFloat(0x7F800000u) : farthest / least_ray2 * (1.0 + 2e-6);
}

void write_color(uint at, vec4 color) {
  if (color_words == 1u) {
    // The shuffle keeps the packing out of the store's loop over lanes.
    out_color[at] = subgroupShuffle(packUnorm4x8(color), gl_SubgroupInvocationID);
  } else if (color_words == 2u) {
    out_color_pairs[at] = pair(uvec2(packHalf2x16(color.rg), packHalf2x16(color.ba)));
  } else {
    out_color_pairs[2u * at] = pair(floatBitsToUint(color.rg));
    out_color_pairs[2u * at + 1u] = pair(floatBitsToUint(color.ba));
  }
}

Particle load_particle(uint at) {
  vec4 payload[payload_vec4s];
  for (int i = 0; i < payload_vec4s; ++i) {
    uint from = 2u * (at * uint(payload_vec4s) + uint(i));
    payload[i] = uintBitsToFloat(uvec4(words(payloads[from]), words(payloads[from + 1u])));
  }
  return unpack(payload);
}

// Uniform values that every pixel needs, taken once.
struct Taken {
  uint width;
  vec4 viewport, sample_near_far, material;
  float inverse_rest;
  vec3 ambient, head_light; // times the material, with one_material
#ifdef SHADOW_SET
  LightMap map0, map1, map2, map3;
#endif
};
Taken take() {
  Taken u;
  u.width = step.width;
  u.viewport = frame.viewport;
  u.sample_near_far = frame.sample_near_far;
  u.inverse_rest = frame.depth_near.y;
  u.material = step.material;
  u.ambient = (one_material ? u.material.x : 1.0) * frame.ambient.rgb;
  u.head_light = (one_material ? u.material.y : 1.0) * frame.lights[0].strength.rgb;
#ifdef SHADOW_SET
  if (shadow_maps > 0) u.map0 = take_map(0);
  if (shadow_maps > 1) u.map1 = take_map(1);
  if (shadow_maps > 2) u.map2 = take_map(2);
  if (shadow_maps > 3) u.map3 = take_map(3);
#endif
  return u;
}

// The surface at one pixel, shaded; written where this round changed the pixel. `quick`: the ray's x, y to visibility's
// precision.
void resolve(Taken u, uvec2 pixel, vec2 quick, float pixel_key, uint winner) {
  bool changed = winner != no_particle;
  uint who = changed ? winner : 0u, at = pixel.y * u.width + pixel.x;
  Particle particle = load_particle(who);
  uvec2 packed_color = words(placed_colors[who]);
  vec3 own = vec3(unpackHalf2x16(packed_color.x), unpackHalf2x16(packed_color.y).x);
  Ray ray = orthographic ? Ray(vec3(quick, 0.0), vec3(0.0, 0.0, 1.0)) : Ray(vec3(0.0), vec3(quick, 1.0));
  float t;
  vec3 normal;
  if (display_only) {
    t = pixel_key / dot(ray.direction, ray.direction);
    normal = normal_at(ray, particle, t);
  } else {
    ray = ray_through(vec2(pixel), u.sample_near_far.xy, u.viewport.w, u.inverse_rest);
    Interval hit;
    intersect(ray, particle, hit);
    normal = outward_normal(ray, particle, hit, false);
    t = hit.t_in;
  }
  vec4 material = u.material;
  if (!one_material) material = materials[packed_color.y >> 16];
  vec3 color = own;
  if (phase != 0) {
    if (!changed) return;
    nearest[at] = pixel_key;
    if (want_depth) out_encoded[at] = encode_depth(t);
    if (phase == 1) {
      write_color(at, vec4(own, float(packed_color.y >> 16)));
      out_id[at] = placed_ids[who];
      out_normal[at] = vec4(normal, t);
    } else if (color_words != 0u) {
      vec4 payload[payload_vec4s];
      pack(particle, payload);
      out_normal[at] = payload[0];
      out_color_pairs[2u * at] = pair(uvec2(placed_ids[who], type_number));
    }
    return;
  }
  if (head_light_only) {
    vec3 ambient = one_material ? u.ambient : material.x * u.ambient, light = one_material ? u.head_light : material.y * u.head_light;
    color = own * (ambient + max(-normal.z, 0.0) * light);
  } else {
#ifdef SHADOW_SET
    vec3 position = ray.origin + t * ray.direction;
    uint id = placed_ids[who];
    if (shadow_maps > 0) lit.map0 = light_past(u.map0, casters0, (orthographic_maps & 1) != 0, id, position);
    if (shadow_maps > 1) lit.map1 = light_past(u.map1, casters1, (orthographic_maps & 2) != 0, id, position);
    if (shadow_maps > 2) lit.map2 = light_past(u.map2, casters2, (orthographic_maps & 4) != 0, id, position);
    if (shadow_maps > 3) lit.map3 = light_past(u.map3, casters3, (orthographic_maps & 8) != 0, id, position);
#endif
    color = shade(Surface(ray.origin + t * ray.direction, normal, -normalize(ray.direction)), own, material);
  }
  if (!changed) return;
  nearest[at] = pixel_key;
  write_color(at, map_pixel(vec4(color, 1.0)));
  if (want_depth) out_encoded[at] = encode_depth(t);
  if ((aovs & 1u) != 0u) out_depth[at] = t;
  if ((aovs & 2u) != 0u) out_id[at] = placed_ids[who];
  if ((aovs & 4u) != 0u)
    out_normal[at] = vec4(normal.x * frame.world_from_view0.xyz + normal.y * frame.world_from_view1.xyz + normal.z * frame.world_from_view2.xyz, 0.0);
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
  float key[pixels];
  uint won[pixels];
  float ray_x[pixels], ray_y[pixels];
#define START(k) { \
  uvec2 p = pixel_of(k); \
  ray_x[k] = (offset.x + float(p.x)) * inverse_focal; \
  ray_y[k] = (offset.y + float(p.y)) * inverse_focal; \
  bool inside = base.x + p.x < u.width && base.y + p.y < height; \
  uint pixel = (base.y + p.y) * u.width + base.x + p.x; \
  key[k] = !inside ? -1.0 : infinitely_far; \
  if (inside && again) key[k] = nearest[pixel]; \
  won[k] = no_particle; }
  FOR_PIXELS(START)
  vec2 least = max(max(offset, -(offset + float(tile_size - 1))), vec2(0.0)) * inverse_focal;
  float least_ray2 = orthographic ? 1.0 : 1.0 + dot(least, least);
  float hidden_from = far[tile];
  float depth_origin = step.depth_origin, depth_scale = step.depth_scale;
  uint hidden_step = depth_step(hidden_from, depth_origin, depth_scale);

  do {
    // The next LANES entries of which at least one may be seen.
    uint entry;
    bool alive;
    do {
      uint mine_at = min(at + lane(), end - 1u);
      entry = entries[(mine_at < room ? own : spilled) + mine_at];
      alive = at + lane() < end && entry >> place_bits <= hidden_step;
      at += uint(LANES);
    } while (at < end && !subgroupAny(alive));
    entry = place_of(entry);
    TileTest mine = tile_test(load_particle(entry), alive);
    FOR_LANES(TEST_LANE)
    float farthest = 0.0;
    FOR_PIXELS(FARTHEST)
    hidden_from = farthest_depth(farthest, least_ray2);
    hidden_step = depth_step(hidden_from, depth_origin, depth_scale);
  } while (at < end);

  if (subgroupElect()) far[tile] = hidden_from;

  // Only rows of pixels in which something changed: in later rounds few do.
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
    resolve(u, base + pixel_of(row), row_ray, row_key, row_won);
    changed &= changed - 1u;
  } while (changed != 0u);
}
