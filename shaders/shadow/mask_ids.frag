#version 460
// SPDX-License-Identifier: MIT
// How much of a light reaches each pixel's surface, from a map of method `ids`: the shadow ray is cast against the
// casters of the 2x2 texels around the point, those of one particle type; a particle never shadows itself. False shadow is
// impossible; light leaks only where the true caster owns none of the four texels (method book, section 8.2).
// What several types let through is multiplied.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shadow/receiver.glsl"
#define orthographic false // of shadow rays, for the type
#define SHADOW_RAY
#include "particles/interface.glsl"

layout(constant_id = 18) const uint caster_type = 0u;

layout(set = 2, binding = 1) uniform utexture2DArray casters; // shadow_maps.hpp
layout(location = 0) out float o_light;

#ifndef HAS_BLOCKS
// Any surface of the particle on origin + t direction with 0 < t < t_max; direction is a unit vector.
bool blocks(vec3 origin, vec3 direction, float t_max, Particle p) {
  Interval hit;
  bool met = intersect(Ray(origin, direction), p, hit);
  return met && ((hit.t_in > 0.0 && hit.t_in < t_max) || (hit.t_out > 0.0 && hit.t_out < t_max));
}
#endif

Particle caster_at(ivec2 texel) {
  vec4 payload[payload_vec4s];
  for (int i = 0; i < payload_vec4s; ++i) payload[i] = uintBitsToFloat(texelFetch(casters, ivec3(texel, i == 0 ? 0 : i + 1), 0));
  return unpack(payload);
}

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
    uvec2 who = texelFetch(casters, ivec3(texel, 1), 0).rg; // id, type
    blocked = blocked || (who.r != 0xFFFFFFFFu && who.r != at.id && who.g == caster_type && blocks(at.position, to_light, reach, caster_at(texel)));
  } while (++k < 4);
  o_light = blocked && on_map(at.position, place) ? 0.0 : 1.0;
}
