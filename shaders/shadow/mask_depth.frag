#version 460
// SPDX-License-Identifier: MIT
// How much of a light reaches each pixel's surface, from a map of method `depth`: percentage-closer filtering (Reeves,
// Salesin & Cook, SIGGRAPH 1987) over (2 pcf_radius + 1)^2 texels. The point is moved along its normal by delta sin(theta),
// which takes all self-shadowing from convex bodies (method book, section 8.2).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shadow/receiver.glsl"

layout(set = 2, binding = 1) uniform texture2D depths;
layout(location = 0) out float o_light;

void main() {
  Receiver at = receiver_at(gl_FragCoord.xy);
  float texel = (light_orthographic ? 1.0 : at.position.z) / shadow.map.z;
  vec3 from_light = light_orthographic ? vec3(0.0, 0.0, 1.0) : normalize(at.position);
  float sine = length(cross(at.normal, from_light));
  vec3 p = at.position + at.normal * (shadow.bias.x * texel * sine);
  vec2 place = map_place(p);
  ivec2 last = ivec2(shadow.map.xy) - 1;
  ivec2 center = ivec2(floor(clamp(place, vec2(-1.0), shadow.map.xy + 1.0)));
  // n / z of the point; a hair farther than the surface it came from would be in rounding.
  float own = shadow.map.w / p.z * (1.0 + 1e-6);
  float lit = 0.0;
  for (int y = -pcf_radius; y <= pcf_radius; ++y)
    for (int x = -pcf_radius; x <= pcf_radius; ++x)
      lit += texelFetch(depths, clamp(center + ivec2(x, y), ivec2(0), last), 0).r > own ? 0.0 : 1.0;
  float side = float(2 * pcf_radius + 1);
  o_light = on_map(p, place) ? lit / (side * side) : 1.0;
}
