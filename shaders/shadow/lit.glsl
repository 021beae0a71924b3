// SPDX-License-Identifier: MIT
// How much of each mapped light reaches a point of a surface, for a kernel that shades at once what it has cast: up to
// most_shadow_maps maps of method `ids`, asked as shadow/mask_ids.frag asks them. Mirrors passes/shadows/tile_shadows.hpp.
// The includer defines SHADOW_SET, the number of this set.
#ifndef MOTE_LIT_GLSL
#define MOTE_LIT_GLSL

#extension GL_EXT_samplerless_texture_functions : require
#include "shadow/casters.glsl"

const int most_shadow_maps = 4;
layout(constant_id = 30) const int shadow_maps = 0;
layout(constant_id = 31) const int light_of_map0 = -1; // of frame.lights
layout(constant_id = 32) const int light_of_map1 = -1;
layout(constant_id = 33) const int light_of_map2 = -1;
layout(constant_id = 34) const int light_of_map3 = -1;
layout(constant_id = 35) const int orthographic_maps = 0; // bit k: map k's light has no place

struct ShadowBlock { // as in shadow/receiver.glsl
  vec4 light_from_view0, light_from_view1, light_from_view2, offset, map, bias;
};
layout(std140, set = SHADOW_SET, binding = 0) uniform ShadowBlocks { ShadowBlock blocks[most_shadow_maps]; } shadows;
layout(set = SHADOW_SET, binding = 1) uniform utexture2DArray casters0;
layout(set = SHADOW_SET, binding = 2) uniform utexture2DArray casters1;
layout(set = SHADOW_SET, binding = 3) uniform utexture2DArray casters2;
layout(set = SHADOW_SET, binding = 4) uniform utexture2DArray casters3;

// A light's map, taken from the uniform block once.
struct LightMap {
  mat3 light_from_view;
  vec3 offset;
  vec3 map; // width, height, focal
};
LightMap take_map(int k) {
  ShadowBlock block = shadows.blocks[k];
  return LightMap(mat3(block.light_from_view0.xyz, block.light_from_view1.xyz, block.light_from_view2.xyz), block.offset.xyz, block.map.xyz);
}

bool blocked_by(uint id, vec4 caster, uint own, vec3 p, vec3 to_light, float reach) {
  return id != 0xFFFFFFFFu && id != own && sphere_blocks(p, to_light, reach, caster);
}

// 1: the light reaches the point `position` of particle `id` (view space), 0: something stands between.
float light_past(LightMap light, utexture2DArray casters, bool parallel, uint id, vec3 position) {
  vec3 p = light.light_from_view * position + light.offset;
  vec2 place = (parallel ? p.xy : p.xy / p.z) * light.map.z + 0.5 * light.map.xy;
  bool on_map = all(greaterThan(place, vec2(0.0))) && all(lessThan(place, light.map.xy)) && p.z > 0.0;
  float reach = parallel ? 1e38 : length(p);
  vec3 to_light = parallel ? vec3(0.0, 0.0, -1.0) : -p / max(reach, 1e-30);
  ivec2 last = ivec2(light.map.xy) - 1;
  ivec2 first = ivec2(floor(clamp(place, vec2(-1.0), light.map.xy + 1.0) - 0.5));
  bool blocked = false;
  int k = 0;
  do {
    ivec2 texel = clamp(first + ivec2(k & 1, k >> 1), ivec2(0), last);
    blocked = blocked || blocked_by(texelFetch(casters, ivec3(texel, 1), 0).r, uintBitsToFloat(texelFetch(casters, ivec3(texel, 0), 0)), id, p, to_light, reach);
  } while (++k < 4);
  return blocked && on_map ? 0.0 : 1.0;
}

struct Lit { float map0, map1, map2, map3; };
Lit all_lit() { return Lit(1.0, 1.0, 1.0, 1.0); }
// Of light i of the frame.
float lit_by(Lit lit, int i) {
  float seen = 1.0;
  if (shadow_maps > 0) seen = i == light_of_map0 ? lit.map0 : seen;
  if (shadow_maps > 1) seen = i == light_of_map1 ? lit.map1 : seen;
  if (shadow_maps > 2) seen = i == light_of_map2 ? lit.map2 : seen;
  if (shadow_maps > 3) seen = i == light_of_map3 ? lit.map3 : seen;
  return seen;
}

#endif
