#version 460
// SPDX-License-Identifier: MIT
// Shades the surfaces that phase `surface` left, once a pixel, with what shadow maps let through; writes the AOVs that
// are wanted (AOV as in phase `opaque`). Drawn once for each shading model of the scene.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/frame.glsl"

layout(constant_id = 16) const bool masked = false; // any light has a map

layout(set = 1, binding = 0) uniform utexture2D surface_id;
layout(set = 1, binding = 1) uniform texture2D surface_normal_t;
layout(set = 1, binding = 2) uniform texture2D surface_color;
layout(set = 1, binding = 3) uniform texture2DArray masks; // light that arrives, a layer for each map
layout(std430, set = 1, binding = 4) readonly buffer Tables {
  ivec4 mask_of_light[max_lights / 4]; // layer of `masks`, -1: no map
  vec4 materials[];                    // two each: (ambient, diffuse, specular, exponent), (shading model, 0, 0, 0)
};

float light_visibility(int light) {
  if (!masked) return 1.0;
  int layer = mask_of_light[light / 4][light % 4];
  float seen = texelFetch(masks, ivec3(ivec2(gl_FragCoord.xy), max(layer, 0)), 0).r;
  return layer < 0 ? 1.0 : seen;
}
#define LIGHT_VISIBILITY(light) light_visibility(light)
#include "common/shading.glsl"

layout(location = 0) out vec4 o_color;
#if (AOV & 1) != 0
layout(location = 1) out float o_depth;
#endif
#if (AOV & 2) != 0
layout(location = 1 + (AOV & 1)) out uint o_id;
#endif
#if (AOV & 4) != 0
layout(location = 1 + (AOV & 1) + ((AOV >> 1) & 1)) out vec4 o_normal;
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint id = texelFetch(surface_id, pixel, 0).r;
  vec4 normal_t = texelFetch(surface_normal_t, pixel, 0);
  vec4 color = texelFetch(surface_color, pixel, 0);
  int material = int(color.a + 0.5);
  if (normal_t.w <= 0.0 || int(materials[2 * material + 1].x) != specular_model) discard;
  Ray ray = pixel_ray(gl_FragCoord.xy);
  Surface at = Surface(ray.origin + normal_t.w * ray.direction, normal_t.xyz, -normalize(ray.direction));
  o_color = vec4(shade(at, color.rgb, materials[2 * material]), 1.0);
#if (AOV & 1) != 0
  o_depth = normal_t.w;
#endif
#if (AOV & 2) != 0
  o_id = id;
#endif
#if (AOV & 4) != 0
  o_normal = vec4(normal_t.x * frame.world_from_view0.xyz + normal_t.y * frame.world_from_view1.xyz +
                      normal_t.z * frame.world_from_view2.xyz, 0.0);
#endif
}
