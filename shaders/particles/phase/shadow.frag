#version 460
// SPDX-License-Identifier: MIT
// Phase `shadow`: the nearest surface seen from a light. SHADOW_IDS: who it belongs to, in the texel format of
// passes/shadows/shadow_maps.hpp; without it only the depth.
#extension GL_GOOGLE_include_directive : require
#include "particles/particle.glsl"

layout(location = 1) flat in uint v_id;
layout(location = 2) flat in vec4 v_payload[payload_vec4s];

#ifdef SHADOW_IDS
layout(location = 0) out uvec4 o_caster;
layout(location = 1) out uvec4 o_id;
#if CASTER_VEC4S > 1
layout(location = 2) out uvec4 o_rest[CASTER_VEC4S - 1];
#endif
#endif
layout(depth_less) out float gl_FragDepth;

void main() {
  Particle particle = unpack(v_payload);
  Interval hit;
  Ray ray = pixel_ray(gl_FragCoord.xy);
  bool covered = intersect(ray, particle, hit);
#ifdef SHADOW_IDS
  // Thinner than a texel: it owns the texels beside it, too, and is not lost between their centers. Receivers test it exactly.
  covered = covered || passes_thin(ray, particle, hit, proxy_slack / frame.viewport.z * (orthographic ? 1.0 : hit.t_in));
#endif
  if (!covered) discard;
  bool inside = !(hit.t_in > 0.0) || inner_end(hit, false);
  float t = inside ? hit.t_out : hit.t_in; // a light inside a particle shines on its inner wall
  if (inside && inner_end(hit, true)) discard;
  if (!(t > 0.0 && t <= frame.sample_near_far.w)) discard;
  gl_FragDepth = encode_depth(t);
#ifdef SHADOW_IDS
  vec4 caster[CASTER_VEC4S];
#ifdef HAS_CASTER
  pack_caster(particle, caster);
#else
  for (int i = 0; i < CASTER_VEC4S; ++i) caster[i] = v_payload[i];
#endif
  o_caster = floatBitsToUint(caster[0]);
  o_id = uvec4(v_id, type_number, 0u, 0u);
#if CASTER_VEC4S > 1
  for (int i = 1; i < CASTER_VEC4S; ++i) o_rest[i - 1] = floatBitsToUint(caster[i]);
#endif
#endif
}
