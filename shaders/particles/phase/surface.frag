#version 460
// SPDX-License-Identifier: MIT
// Phase `surface`: what shading needs of the nearest visible surface, not shaded yet: color, id, normal and depth.
// EDGES: drawn with proxy_slack, also where the particle covers only a part of the pixel; how much goes to o_edge, for
// post/edges.frag. A full-screen pass shades each pixel once (passes/shadows/surface_shading.hpp). The surface is that of phase `opaque`.
#extension GL_GOOGLE_include_directive : require
#include "particles/particle.glsl"
#include "common/coverage.glsl"

layout(location = 0) flat in vec4 v_color;
layout(location = 1) flat in uint v_id;
layout(location = 2) flat in vec4 v_payload[payload_vec4s];

layout(location = 0) out vec4 o_color;    // rgb: working space; a: number of the material (batch.material.x)
layout(location = 1) out uint o_id;
layout(location = 2) out vec4 o_normal_t; // view space, unit, turned to the eye; w: depth along the view axis
#ifdef EDGES
layout(location = 3) out vec4 o_edge;     // x: coverage; yz: to the pixel beyond the outline
#endif
layout(depth_less) out float gl_FragDepth;

#ifdef EDGES
// The surface of a pixel that the particle covers in part is that at a place 0.35 pixels within the outline; of one
// smaller than a pixel, at the place that has its mean brightness under a head light (normal 2/3 to the eye).
vec2 inner_place(Outline o) {
  vec2 to_pixel = -o.offset / max(length(o.offset), 1e-6);
  return o.radius < 0.85 ? o.offset + 0.745 * o.radius * to_pixel : o.inward * max(0.35 - o.inside, 0.0);
}
// The nearest pixel outward of this one, one or two steps away, that the particle does not touch.
vec2 pixel_beyond(Outline o) {
  vec2 outward = o.radius < 0.85 ? -o.offset : -o.inward;
  float extent = max(abs(outward.x), abs(outward.y));
  vec2 one = round(outward / max(extent, 1e-6)), two = round(2.0 * outward / max(extent, 1e-6));
  bool touched = o.inside - dot(one, -o.inward) > -0.5 * (abs(o.inward.x) + abs(o.inward.y)) - 0.02;
  if (o.radius < 0.85) touched = extent < 0.25;
  return touched ? two : one;
}
#endif

void main() {
  Ray ray = pixel_ray(gl_FragCoord.xy);
  Particle particle = unpack(v_payload);
  Interval hit;
#ifdef EDGES
  intersect(ray, particle, hit);
  Outline o = outline(ray, particle, hit);
  float coverage = disc_coverage(o.offset, o.radius, o.inside, o.inward);
  if (coverage <= 0.0) discard;
  o_edge = vec4(coverage, pixel_beyond(o), 0.0);
  vec2 moved = inner_place(o) / frame.viewport.z;
  if (orthographic) ray.origin.xy += moved;
  else ray.direction.xy += moved;
  intersect(ray, particle, hit);
#else
  if (!intersect(ray, particle, hit)) discard;
#endif
  float near = frame.sample_near_far.z;
  bool inside = cull == 1 || inner_end(hit, false) || !(hit.t_in > 0.0 && hit.t_in >= near);
  if (inside && (cull == 2 || inner_end(hit, true))) discard;
  float t = inside ? hit.t_out : hit.t_in;
  vec3 outward = outward_normal(ray, particle, hit, inside);
  if (!(t > 0.0 && t >= near && t <= frame.sample_near_far.w)) discard;
  gl_FragDepth = encode_depth(t);
  o_color = vec4(v_color.rgb, batch.material.x);
#ifdef HAS_ALARM
  if (type_alarm) o_color.rgb = vec3(1.0, 0.0, 1.0);
#endif
  o_id = v_id;
  o_normal_t = vec4(inside ? -outward : outward, t);
}
