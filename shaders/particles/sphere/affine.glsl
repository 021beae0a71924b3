// SPDX-License-Identifier: MIT
// The sphere under a general affine placement: exactly an ellipsoid. Included by type.glsl with AFFINE, a variant of
// its own, so that spheres that stay spheres pay nothing. Formulas: method book, sections 3.5 (shift in view units,
// then rotate and scale, then shift again where the ellipsoid is the unit sphere) and 4.1 (bounds of affine balls).
// Here `radius` is the one of the record, before the transform; the half axes are radius * unit_lengths(). What `hit.local` holds is
// where the ellipsoid is the unit sphere.

// A view-space vector where the ellipsoid is the unit sphere.
vec3 to_unit(vec3 v, float radius) { return (v * unit_axes()) / (unit_lengths() * radius); }

bool intersect(Ray ray, Particle p, out Interval hit) {
#ifdef NEAR_EYE
  vec3 center_rest = p.rest;
#else
  vec3 center_rest = vec3(0.0);
#endif
  vec3 l, nearest;
  vec2 first; // the parameter where the ray is nearest to the center: first.x has few bits, the rest is small
  float shift;
  if (orthographic) {
    l = vec3(ray.origin.xy - p.center.xy, 0.0) - center_rest;
    first = vec2(p.center.z, 0.0);
  } else {
    shift_in_parts(ray.origin - p.center, ray.direction, l, first);
    l -= center_rest;
  }
  vec3 d = to_unit(ray.direction, p.radius);
  shift_to_nearest(to_unit(l, p.radius), d, nearest, shift);
  float distance = length(nearest), d_d = dot(d, d);
  float d2 = (1.0 - distance) * (1.0 + distance);
  float h = sqrt(max(d2, 0.0) / d_d);
  float small = first.y + shift;
  hit = Interval(first.x + (small - h), first.x + (small + h), vec4(nearest, h), vec4(0.0));
#ifdef NEAR_EYE
  // A root much nearer than the other one loses its digits in that difference: it comes from the product of both, which is
  // the power of the eye where the ellipsoid is the unit sphere.
  bool ahead = first.x + small >= 0.0;
  float far_root = ahead ? hit.t_out : hit.t_in;
  float near_root = p.power.x / (d_d * far_root);
  bool by_power = !orthographic && abs(near_root) < 0.3 * abs(far_root);
  hit.t_in = by_power && ahead ? near_root : hit.t_in;
  hit.t_out = by_power && !ahead ? near_root : hit.t_out;
#endif
  return d2 >= 0.0;
}

// By the inverse transpose of the placement, from the local hit point.
vec3 outward_normal(Ray ray, Particle p, Interval hit, bool exit) {
  vec3 local = hit.local.xyz + (exit ? hit.local.w : -hit.local.w) * to_unit(ray.direction, p.radius);
  return normal_from_own(local);
}

vec3 half_axis_lengths(Particle p) { return abs(unit_lengths()) * p.radius; }

// As the ellipsoid's (ellipsoid/type.glsl).
bool passes_thin(Ray ray, Particle p, Interval hit, float radius) {
  vec3 lengths = half_axis_lengths(p);
  float q = length(hit.local.xyz);
  return min(lengths.x, min(lengths.y, lengths.z)) < radius && (q - 1.0) * q < radius * length(hit.local.xyz / lengths);
}

// The ellipse that shows of it, in pixels: the longer half axis and the radius of a disc of equal area. In perspective that of the
// picture's linear part at the center.
vec2 shown_ellipse(Particle p) {
  mat3 axes = unit_axes();
  vec3 lengths = frame.viewport.z * half_axis_lengths(p) / (orthographic ? 1.0 : p.center.z);
  vec2 m = orthographic ? vec2(0.0) : p.center.xy / p.center.z;
  float xx = 0.0, xy = 0.0, yy = 0.0;
  for (int k = 0; k < 3; ++k) {
    vec2 half_axis = (axes[k].xy - m * axes[k].z) * lengths[k];
    xx += half_axis.x * half_axis.x, xy += half_axis.x * half_axis.y, yy += half_axis.y * half_axis.y;
  }
  float longer = 0.5 * (xx + yy + length(vec2(xx - yy, 2.0 * xy)));
  return vec2(sqrt(longer), sqrt(sqrt(max(xx * yy - xy * xy, 0.0))));
}

// As the sphere's, with F where the ellipsoid is the unit sphere and its gradient along the picture. One that is thinner than a
// disc's outline needs and longer than a pixel has no closed form here: its pixels are covered or not.
Outline outline(Ray ray, Particle p, Interval hit) {
  vec3 l = hit.local.xyz, d = to_unit(ray.direction, p.radius), lengths = unit_lengths() * p.radius;
  float distance = length(l), d2 = (1.0 - distance) * (1.0 + distance), focal = frame.viewport.z;
  float middle = 0.5 * (hit.t_in + hit.t_out);
  vec3 rise = orthographic ? l : middle * l - d2 / dot(d, d) * d;
  vec2 outward = (unit_axes() * (rise / lengths)).xy;
  float slope = max(length(outward), 1e-30);
  vec2 ellipse = shown_ellipse(p);
  Outline o;
  o.inside = focal * (orthographic ? (1.0 - distance) * max(distance, 1e-6) : 0.5 * d2) / slope;
  o.inward = -outward / slope;
  o.radius = ellipse.y;
  o.offset = orthographic ? focal * (p.center.xy - ray.origin.xy) : focal * (p.center.xy / p.center.z - ray.direction.xy);
  if (ellipse.x > 0.85 && ellipse.y * ellipse.y < 0.85 * ellipse.x) o = Outline(d2 >= 0.0 ? 1e3 : -1e3, vec2(1.0, 0.0), 1e3, vec2(0.0));
  return o;
}

#include "particles/affine_caster.glsl"
void pack_caster(Particle p, out vec4 caster[CASTER_VEC4S]) { pack_ellipsoid(p.center, unit_axes()[0], unit_axes()[1], half_axis_lengths(p), caster); }
