// SPDX-License-Identifier: MIT
// How much of each mapped light reaches a point of a surface, for a kernel that shades at once what it has cast: up to
// most_shadow_maps maps of spheres that tiles have left in buffers, asked as shadow/mask_ids.frag asks them.
// Mirrors passes/shadows/tile_shadows.hpp. The includer defines SHADOW_SET, the number of this set.
#ifndef MOTE_LIT_GLSL
#define MOTE_LIT_GLSL

#include "shadow/casters.glsl"

const int most_shadow_maps = 4;
layout(constant_id = 30) const int shadow_maps = 0;
layout(constant_id = 31) const int light_of_map0 = -1; // of frame.lights
layout(constant_id = 32) const int light_of_map1 = -1;
layout(constant_id = 33) const int light_of_map2 = -1;
layout(constant_id = 34) const int light_of_map3 = -1;
layout(constant_id = 35) const int orthographic_maps = 0; // bit k: map k's light has no place
layout(constant_id = 36) const int maps_by_id = 0;        // bit k: map k's casters lie by id, else by texel

struct ShadowBlock { // as in shadow/receiver.glsl
  vec4 light_from_view0, light_from_view1, light_from_view2, offset, map, bias;
};
layout(std140, set = SHADOW_SET, binding = 0) uniform ShadowBlocks { ShadowBlock blocks[most_shadow_maps]; } shadows;

// A light's map, taken from the uniform block once.
struct LightMap {
  mat3 light_from_view;
  vec3 offset;
  vec3 map; // width, height, focal
  vec4 to;  // the light in the camera's view space, as Light::position
};
LightMap take_map(int k, int light) {
  ShadowBlock block = shadows.blocks[k];
  return LightMap(mat3(block.light_from_view0.xyz, block.light_from_view1.xyz, block.light_from_view2.xyz), block.offset.xyz, block.map.xyz,
                  frame.lights[max(light, 0)].position);
}
// Does a surface face the light? What does not is dark, whatever the map says.
bool faces(LightMap light, vec3 position, vec3 normal) { return dot(normal, light.to.xyz - position * light.to.w) > 0.0; }

// A point of view space as the light sees it: p in the light's view space, and where that lies on the map, in texels.
vec2 place_on(LightMap light, bool parallel, vec3 position, out vec3 p) {
  p = light.light_from_view * position + light.offset;
  return (parallel ? p.xy : p.xy / p.z) * light.map.z + 0.5 * light.map.xy;
}
bool is_on(LightMap light, vec2 place, vec3 p) { return all(greaterThan(place, vec2(0.0))) && all(lessThan(place, light.map.xy)) && p.z > 0.0; }

layout(std430, set = SHADOW_SET, binding = 1) readonly buffer Casters0 { uvec4 casters0[]; };
layout(std430, set = SHADOW_SET, binding = 2) readonly buffer Casters1 { uvec4 casters1[]; };
layout(std430, set = SHADOW_SET, binding = 3) readonly buffer Casters2 { uvec4 casters2[]; };
layout(std430, set = SHADOW_SET, binding = 4) readonly buffer Casters3 { uvec4 casters3[]; };
layout(std430, set = SHADOW_SET, binding = 5) readonly buffer CasterIds0 { uint caster_ids0[]; };
layout(std430, set = SHADOW_SET, binding = 6) readonly buffer CasterIds1 { uint caster_ids1[]; };
layout(std430, set = SHADOW_SET, binding = 7) readonly buffer CasterIds2 { uint caster_ids2[]; };
layout(std430, set = SHADOW_SET, binding = 8) readonly buffer CasterIds3 { uint caster_ids3[]; };

// The 2x2 texels around a point of a surface, and its ray to the light.
struct Question {
  uvec4 texels;
  vec3 p, to_light; // the light's view space
  float reach;
  bool asked;
};
Question question_of(LightMap light, bool parallel, vec3 position) {
  Question q;
  vec2 place = place_on(light, parallel, position, q.p);
  q.asked = is_on(light, place, q.p);
  q.reach = parallel ? 1e38 : length(q.p);
  q.to_light = parallel ? vec3(0.0, 0.0, -1.0) : -q.p / max(q.reach, 1e-30);
  vec2 last = light.map.xy - 1.0;
  uvec2 lo = uvec2(clamp(floor(place - 0.5), vec2(0.0), last)), hi = uvec2(clamp(floor(place - 0.5) + 1.0, vec2(0.0), last));
  uint tiles_x = (uint(light.map.x) + 7u) >> 3, left = tiled_column(lo.x), right = tiled_column(hi.x);
  uint upper = tiled_row(lo.y, tiles_x), lower = tiled_row(hi.y, tiles_x);
  q.texels = uvec4(upper + left, upper + right, lower + left, lower + right);
  return q;
}
// Whose casters have not been tried: bits. The same caster in several texels is tried once.
uint others_than(uvec4 ids, uint id, uint open) {
  return open & ~((ids.x == id ? 1u : 0u) | (ids.y == id ? 2u : 0u) | (ids.z == id ? 4u : 0u) | (ids.w == id ? 8u : 0u));
}
#define ASK_MAP(k, light, position, own, facing) { \
  const bool parallel = (orthographic_maps & (1 << k)) != 0, by_id = (maps_by_id & (1 << k)) != 0; \
  bool blocked = false; \
  Question q = question_of(light, parallel, position); \
  bool asked = q.asked && (facing); \
  uvec4 ids = uvec4(no_particle); \
  if (asked) ids = uvec4(caster_ids##k[q.texels.x], caster_ids##k[q.texels.y], caster_ids##k[q.texels.z], caster_ids##k[q.texels.w]); \
  uint open = others_than(ids, own, others_than(ids, no_particle, 15u)); \
  do { \
    int i = findLSB(open); \
    uint texel = i <= 0 ? q.texels.x : i == 1 ? q.texels.y : i == 2 ? q.texels.z : q.texels.w; \
    uint id = i <= 0 ? ids.x : i == 1 ? ids.y : i == 2 ? ids.z : ids.w; \
    vec4 caster = vec4(0.0); \
    if (open != 0u) caster = uintBitsToFloat(casters##k[by_id ? id : texel]); \
    blocked = blocked || (open != 0u && sphere_blocks(q.p, q.to_light, q.reach, caster)); \
    open = blocked ? 0u : others_than(ids, id, open); \
  } while (subgroupAny(open != 0u)); \
  lit.blocked##k = blocked; }

struct Lit { bool blocked0, blocked1, blocked2, blocked3; };
Lit all_lit() { return Lit(false, false, false, false); }
// Of light i of the frame.
float lit_by(Lit lit, int i) {
  bool blocked = false;
  if (shadow_maps > 0) blocked = blocked || (i == light_of_map0 && lit.blocked0);
  if (shadow_maps > 1) blocked = blocked || (i == light_of_map1 && lit.blocked1);
  if (shadow_maps > 2) blocked = blocked || (i == light_of_map2 && lit.blocked2);
  if (shadow_maps > 3) blocked = blocked || (i == light_of_map3 && lit.blocked3);
  return blocked ? 0.0 : 1.0;
}

#endif
