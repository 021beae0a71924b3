// SPDX-License-Identifier: MIT
// Rectangles on the image that hold balls and discs, for the proxies of types: exact (method book, section 4.1; for balls Mara &
// McGuire, JCGT 2(2), 2013), and of hulls of them (4.2). A ball is one of the particle's own space: with AFFINE it is an
// ellipsoid in view space.
#ifndef MOTE_BOUNDS_GLSL
#define MOTE_BOUNDS_GLSL

#include "particles/own_space.glsl"

float visible_from() { return max(frame.sample_near_far.z, frame.depth_near.x); } // the near cut, or that of the depth encoding

// Extent of (e . p) / z over the part of { center + (g, k) w, |w| <= 1 } with z >= n, as (min, max); m = (e . center, z of the
// center); g, k: what the half axes reach along e and along z. For a sphere g = (r, 0, 0), k = (0, r, 0).
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

// Of { center + from_own(half * w), |w| <= 1 }; columns of `half`: vectors of own space.
Proxy affine_proxy(vec3 center, mat3 half_axes) {
  float n = visible_from();
  mat3 reach = transpose(mat3(from_own(half_axes[0]), from_own(half_axes[1]), from_own(half_axes[2]))); // columns: x, y and z parts
  vec3 gx = reach[0], gy = reach[1], k = reach[2];
  float depth = length(k);
  if (center.z + depth < n) return empty_proxy();
  vec2 x = center.x + length(gx) * vec2(-1.0, 1.0);
  vec2 y = center.y + length(gy) * vec2(-1.0, 1.0);
  if (!orthographic) {
    x = affine_extent(center.xz, gx, k, n);
    y = affine_extent(center.yz, gy, k, n);
  }
  return Proxy(vec2(x.x, y.x), vec2(x.y, y.y), max(n, center.z - depth));
}

#ifdef AFFINE
Proxy ball_proxy(vec3 center, float radius) { return affine_proxy(center, mat3(radius)); }
float ball_depth(float radius) { return radius * length(vec3(from_own(vec3(1.0, 0.0, 0.0)).z, from_own(vec3(0.0, 1.0, 0.0)).z, from_own(vec3(0.0, 0.0, 1.0)).z)); }

Proxy disc_proxy(vec3 center, vec3 axis, float radius) {
  float s = axis.z >= 0.0 ? 1.0 : -1.0, a = -1.0 / (s + axis.z), b = axis.x * axis.y * a; // Duff et al., JCGT 6(1), 2017
  radius = max(radius, 1e-6 * length(center)); // a point has an extent, too
  return affine_proxy(center, radius * mat3(vec3(1.0 + s * axis.x * axis.x * a, s * b, -s * axis.x), vec3(b, s + axis.y * axis.y * a, -axis.y), vec3(0.0)));
}
#else
// Extent of x / z (or y / z) over the part of the sphere with z >= n, as (min, max); m = (x or y, z) of the center.
vec2 tangent_extent(vec2 m, float r, float n) {
  vec2 extent = vec2(1e30, -1e30);
  float power = dot(m, m) - r * r;
  if (power > 0.0) {
    // Roots of (z^2 - r^2) h^2 - 2 x z h + (x^2 - r^2) = 0, each written without cancellation.
    float b = m.x * m.y;
    float root = r * sqrt(power); // never r^2 times the power, which overflows from 1e9 on
    float q = b + (b >= 0.0 ? root : -root);
    float a = (m.y - r) * (m.y + r), c = (m.x - r) * (m.x + r);
    vec2 h = vec2(q / a, c / q);
    for (int i = 0; i < 2; ++i) {
      float s = m.x - h[i] * m.y > 0.0 ? -1.0 : 1.0; // side of the tangent point
      float z = m.y - s * r * h[i] * inversesqrt(1.0 + h[i] * h[i]);
      if (z >= n) extent = vec2(min(extent.x, h[i]), max(extent.y, h[i]));
    }
  }
  float u = (n - m.y) / r; // the circle in which the near plane cuts the sphere
  if (abs(u) <= 1.0) {
    float half_chord = r * sqrt((1.0 - u) * (1.0 + u));
    extent = vec2(min(extent.x, (m.x - half_chord) / n), max(extent.y, (m.x + half_chord) / n));
  }
  return extent;
}

// Rectangle on the image that covers the visible part, and the least z that it can have there.
Proxy ball_proxy(vec3 center, float radius) {
  float n = visible_from();
  if (center.z + radius < n) return empty_proxy();
  vec2 x = vec2(center.x - radius, center.x + radius);
  vec2 y = vec2(center.y - radius, center.y + radius);
  if (!orthographic) {
    x = tangent_extent(center.xz, radius, n);
    y = tangent_extent(center.yz, radius, n);
  }
  return Proxy(vec2(x.x, y.x), vec2(x.y, y.y), max(n, center.z - radius));
}
float ball_depth(float radius) { return radius; }

// Extent of a disc that lies before the eye: m = (x or y, z) of the center, u the same of its unit normal, o the normal's third
// part. Of the radicand r^2 (o^2 (|m|^2 - r^2) + (m.u)^2) no term cancels.
vec2 disc_extent(vec2 m, vec2 u, float o, float r) {
  float kk = r * r * (1.0 - u.y) * (1.0 + u.y);
  float middle = m.x * m.y + r * r * u.x * u.y, across = dot(m, u);
  float root = r * sqrt(max(o * o * (dot(m, m) - r * r), 0.0) + across * across);
  return vec2(middle - root, middle + root) / (m.y * m.y - kk);
}
// A disc of which nothing lies before the near plane (else: what comes out means nothing).
Proxy disc_proxy(vec3 center, vec3 axis, float radius) {
  vec3 reach = radius * sqrt((1.0 - axis) * (1.0 + axis));
  vec2 x = center.x + reach.x * vec2(-1.0, 1.0), y = center.y + reach.y * vec2(-1.0, 1.0);
  if (!orthographic) {
    x = disc_extent(center.xz, axis.xz, axis.y, radius);
    y = disc_extent(center.yz, axis.yz, axis.x, radius);
  }
  return Proxy(vec2(x.x, y.x), vec2(x.y, y.y), center.z - reach.z);
}
#endif

Proxy united(Proxy a, Proxy b) { return Proxy(min(a.lo, b.lo), max(a.hi, b.hi), min(a.z_min, b.z_min)); }

// A hull whose parts reach no nearer than z_min has the rectangle around theirs; one that the near plane cuts, that of the
// ball around all of it.
Proxy hull_proxy(Proxy parts, float z_min, vec3 center, float radius) {
  Proxy ball = ball_proxy(center, radius);
  bool cut = z_min < visible_from();
  return Proxy(cut ? ball.lo : parts.lo, cut ? ball.hi : parts.hi, cut ? ball.z_min : z_min);
}

#ifdef TILES
// Of a ball wholly before the eye and the near plane: to a thousandth of a pixel.
Proxy tile_ball(vec3 center, float r) {
  if (orthographic) return Proxy(center.xy - r, center.xy + r, center.z - r);
  float z = center.z;
  vec2 half_extent = r * sqrt(center.xy * center.xy + (z - r) * (z + r));
  float scale = 1.0 / ((z - r) * (z + r));
  return Proxy((center.xy * z - half_extent) * scale, (center.xy * z + half_extent) * scale, z - r);
}
#endif

#endif
