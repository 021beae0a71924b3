// SPDX-License-Identifier: MIT
// The sphere under a general affine placement: exactly an ellipsoid. Included by type.glsl with AFFINE, a variant of
// its own, so that spheres that stay spheres pay nothing. Formulas: method book, sections 3.5 (shift in view units,
// then rotate and scale, then shift again where the ellipsoid is the unit sphere) and 4.1 (bounds of affine balls).
// Here `radius` is the one of the record, before the transform; the half axes are radius * unit_lengths().

mat3 unit_axes() { // columns: the half axes' directions in view space
  vec3 x = vec3(batch.axes[0], batch.axes[1], batch.axes[2]), y = vec3(batch.axes[3], batch.axes[4], batch.axes[5]);
  return mat3(x, y, cross(x, y));
}
vec3 unit_lengths() { return vec3(batch.linear0_scale.w, batch.linear1.w, batch.linear2.w); }

// A view-space vector where the ellipsoid is the unit sphere.
vec3 to_unit(vec3 v, float radius) { return (v * unit_axes()) / (unit_lengths() * radius); }

// Extent of (e . p) / z over the part of the ellipsoid with z >= n, as (min, max); m = (e . center, z of the center);
// g, k: what the half axes reach along e and along z. For a sphere g = (r, 0, 0), k = (0, r, 0).
vec2 affine_extent(vec2 m, vec3 g, vec3 k, float n) {
  vec2 extent = vec2(1e30, -1e30);
  float gg = dot(g, g), kk = dot(k, k), gk = dot(g, k);
  vec3 gxk = cross(g, k), w = m.y * g - m.x * k;
  float disc = dot(w, w) - dot(gxk, gxk);
  if (disc > 0.0) {
    float b = m.x * m.y - gk;
    float q = b + (b >= 0.0 ? sqrt(disc) : -sqrt(disc));
    float a = (m.y - sqrt(kk)) * (m.y + sqrt(kk)), c = (m.x - sqrt(gg)) * (m.x + sqrt(gg));
    vec2 h = vec2(q / a, c / q);
    for (int i = 0; i < 2; ++i) {
      vec3 v = g - h[i] * k;
      float s = m.x - h[i] * m.y > 0.0 ? -1.0 : 1.0; // side of the tangent point
      float z = m.y + s * dot(k, v) * inversesqrt(dot(v, v));
      if (z >= n) extent = vec2(min(extent.x, h[i]), max(extent.y, h[i]));
    }
  }
  float u = (n - m.y) * inversesqrt(kk); // the ellipse in which the near plane cuts the ellipsoid
  if (abs(u) <= 1.0) {
    float middle = m.x + gk / kk * (n - m.y), half_chord = sqrt(dot(gxk, gxk) / kk * (1.0 - u) * (1.0 + u));
    extent = vec2(min(extent.x, (middle - half_chord) / n), max(extent.y, (middle + half_chord) / n));
  }
  return extent;
}

Proxy proxy(Particle p) {
  float n = max(frame.sample_near_far.z, frame.depth_near.x);
  mat3 reach = transpose(unit_axes()); // columns: x, y and z parts of the three half axes
  vec3 lengths = unit_lengths() * p.radius;
  vec3 gx = reach[0] * lengths, gy = reach[1] * lengths, k = reach[2] * lengths;
  float depth = length(k);
  if (p.center.z + depth < n) return empty_proxy();
  vec2 x = p.center.x + length(gx) * vec2(-1.0, 1.0);
  vec2 y = p.center.y + length(gy) * vec2(-1.0, 1.0);
  if (!orthographic) {
    x = affine_extent(p.center.xz, gx, k, n);
    y = affine_extent(p.center.yz, gy, k, n);
  }
  return Proxy(vec2(x.x, y.x), vec2(x.y, y.y), max(n, p.center.z - depth));
}

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
  hit = Interval(first.x + (small - h), first.x + (small + h), vec4(nearest, h));
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
  vec3 lengths = unit_lengths();
  float shortest = min(lengths.x, min(lengths.y, lengths.z));
  return normalize(unit_axes() * (local * (shortest / lengths)));
}
