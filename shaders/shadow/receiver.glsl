// SPDX-License-Identifier: MIT
// A surface point as a light's map sees it: shared by the passes that ask a shadow map. The surface comes from the
// textures of phase `surface`; the block mirrors ShadowBlock of passes/shadows/surface_shading.cpp.
#ifndef MOTE_RECEIVER_GLSL
#define MOTE_RECEIVER_GLSL

#include "common/frame.glsl"

layout(constant_id = 16) const bool light_orthographic = true;
layout(constant_id = 17) const int pcf_radius = 1;

layout(set = 1, binding = 0) uniform utexture2D surface_id;
layout(set = 1, binding = 1) uniform texture2D surface_normal_t;

layout(std140, set = 2, binding = 0) uniform ShadowBlock {
  vec4 light_from_view0; // columns of the rotation
  vec4 light_from_view1;
  vec4 light_from_view2;
  vec4 offset;           // xyz: the camera's eye in the light's view space
  vec4 map;              // width, height, focal (texels a tangent; orthographic: a world unit), n of the depth encoding
  vec4 bias;             // x: method depth, normal offset in texels
} shadow;

struct Receiver {
  uint id;       // 0xFFFFFFFF: nothing is here
  vec3 position; // in the light's view space
  vec3 normal;
};

Receiver receiver_at(vec2 fragment) {
  ivec2 pixel = ivec2(fragment);
  vec4 normal_t = texelFetch(surface_normal_t, pixel, 0);
  Ray ray = pixel_ray(fragment);
  vec3 p = ray.origin + normal_t.w * ray.direction;
  mat3 light_from_view = mat3(shadow.light_from_view0.xyz, shadow.light_from_view1.xyz, shadow.light_from_view2.xyz);
  return Receiver(texelFetch(surface_id, pixel, 0).r, light_from_view * p + shadow.offset.xyz, light_from_view * normal_t.xyz);
}

// Where a point of the light's view space lies on the map, in texels from its corner; centers at + 0.5.
vec2 map_place(vec3 p) {
  vec2 tangents = light_orthographic ? p.xy : p.xy / p.z;
  return tangents * shadow.map.z + 0.5 * shadow.map.xy;
}
// Outside of it, or behind a spot light, nothing is known to block.
bool on_map(vec3 p, vec2 place) {
  return all(greaterThan(place, vec2(0.0))) && all(lessThan(place, shadow.map.xy)) && p.z > 0.0;
}

#endif
