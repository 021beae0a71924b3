#version 460
// SPDX-License-Identifier: MIT
// How much of a light reaches each pixel's surface, from a map of method `ids`: the shadow ray is cast against the
// casters of the 2x2 texels around the point; a particle never shadows itself. False shadow is impossible; light
// leaks only where the true caster owns none of the four texels (method book, section 8.2).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shadow/receiver.glsl"
#include "shadow/casters.glsl"

layout(set = 2, binding = 1) uniform utexture2DArray casters;
layout(location = 0) out float o_light;

void main() {
  Receiver at = receiver_at(gl_FragCoord.xy);
  vec2 place = map_place(at.position);
  float reach = light_orthographic ? 1e38 : length(at.position);
  vec3 to_light = light_orthographic ? vec3(0.0, 0.0, -1.0) : -at.position / max(reach, 1e-30);
  ivec2 last = ivec2(shadow.map.xy) - 1;
  ivec2 first = ivec2(floor(clamp(place, vec2(-1.0), shadow.map.xy + 1.0) - 0.5));
  bool blocked = false;
  int k = 0;
  do {
    ivec2 texel = clamp(first + ivec2(k & 1, k >> 1), ivec2(0), last);
    uint id = texelFetch(casters, ivec3(texel, 1), 0).r;
    vec4 caster = uintBitsToFloat(texelFetch(casters, ivec3(texel, 0), 0));
    blocked = blocked || (id != 0xFFFFFFFFu && id != at.id && sphere_blocks(at.position, to_light, reach, caster));
  } while (++k < 4);
  o_light = blocked && on_map(at.position, place) ? 0.0 : 1.0;
}
