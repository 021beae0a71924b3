// SPDX-License-Identifier: MIT
// The sphere under a general affine placement: exactly an ellipsoid. Included by type.glsl with AFFINE, a variant of
// its own, so that spheres that stay spheres pay nothing. Formulas: method book, sections 3.5 (shift in view units,
// then rotate and scale, then shift again where the ellipsoid is the unit sphere) and 4.1 (bounds of affine balls).
// Here `radius` is the one of the record, before the transform; the half axes are radius * unit_lengths().

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
