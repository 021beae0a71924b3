// SPDX-License-Identifier: MIT
// What types with an axis share (capsule, cylinder, cone, arrow): a ray split along and across the axis, and where it is
// between two planes across the axis. Formulas: method book, section 3.2; all numbers in the particle's own space.
#ifndef MOTE_AXIAL_GLSL
#define MOTE_AXIAL_GLSL

#include "particles/bounds.glsl"

const float beyond = 1e30; // a parameter that no ray reaches

// The unit axis and half length; of a particle without length, any axis.
struct Axis {
  vec3 u;
  float half_length;
};
Axis axis_of(vec3 h) {
  float length_ = length(h);
  return length_ > 0.0 ? Axis(h / length_, length_) : Axis(vec3(0.0, 0.0, 1.0), 0.0);
}

struct AxialRay {
  float fz, dz;      // along the axis
  vec3 fp, dp;       // across it
  float f_p, d_p;    // their lengths
  float across;      // (fp x dp) . u
};
AxialRay axial(OwnRay ray, vec3 u) {
  AxialRay r;
  r.fz = dot(ray.f, u);
  r.dz = dot(ray.d, u);
  vec3 dxu = cross(ray.d, u);
  r.dp = cross(u, dxu);
  r.fp = ray.f - r.fz * u;
  r.f_p = length(r.fp);
  r.d_p = length(dxu);
  r.across = dot(ray.f, dxu);
  return r;
}

// Where the ray is between the planes z = lo and z = hi; empty (x > y) where never.
vec2 between(AxialRay r, float lo, float hi) {
  float inverse = 1.0 / r.dz;
  float a = (lo - r.fz) * inverse, b = (hi - r.fz) * inverse;
  bool parallel_in = r.fz >= lo && r.fz <= hi;
  return r.dz != 0.0 ? vec2(min(a, b), max(a, b)) : parallel_in ? vec2(-beyond, beyond) : vec2(beyond, -beyond);
}

// Where the ray is inside the endless body of radius rho(z) = radius + slope (z - z0) around the axis (a cylinder with slope 0, a
// cone of one nappe else).
vec2 inside_round(AxialRay r, float radius, float slope, float z0) {
  float rho = radius + slope * (r.fz - z0), rho_d = slope * r.dz;
  vec3 gv = rho * r.dp - rho_d * r.fp;
  float g = length(gv), x = abs(r.across);
  float discriminant = (g - x) * (g + x);
  float a = (r.d_p - abs(rho_d)) * (r.d_p + abs(rho_d));
  float b = -r.fz * r.dz - rho * rho_d; // f is the point nearest to the center: f . d = 0
  float c = (r.f_p - rho) * (r.f_p + rho);
  float root = sqrt(max(discriminant, 0.0));
  float q = b >= 0.0 ? -(b + root) : root - b;
  float one = q != 0.0 ? c / q : 0.0;
  float other = a != 0.0 ? q / a : q >= 0.0 ? -beyond : beyond; // a = 0: along a generator, as the limit of steep rays
  vec2 s = vec2(min(one, other), max(one, other));
  bool other_nappe = rho + rho_d * 0.5 * (max(s.x, -1e20) + min(s.y, 1e20)) < 0.0;
  bool missed = discriminant < 0.0 || other_nappe;
  vec2 closed = missed ? vec2(beyond, -beyond) : s;
  vec2 open = rho_d > 0.0 ? vec2(s.y, beyond) : vec2(-beyond, s.x); // a steep ray meets one nappe once
  bool parallel_axis = r.d_p <= 1e-8 * abs(r.dz);
  vec2 along = r.f_p <= rho ? vec2(-beyond, beyond) : vec2(beyond, -beyond);
  return parallel_axis && slope == 0.0 ? along : a > 0.0 ? closed : open;
}

// Where the ray is inside the ball around z u. The ray's origin is the point nearest to the center, not to the ball.
vec2 inside_ball(OwnRay ray, AxialRay r, vec3 u, float z, float radius) {
  float d_d = dot(ray.d, ray.d), middle = z * r.dz / d_d;
  float distance = length((ray.f - z * u) + middle * ray.d);
  float d2 = (radius - distance) * (radius + distance);
  float h = sqrt(max(d2, 0.0) / d_d);
  return d2 >= 0.0 ? vec2(middle - h, middle + h) : vec2(beyond, -beyond);
}

vec2 both(vec2 a, vec2 b) { return vec2(max(a.x, b.x), min(a.y, b.y)); }
// Of intervals that touch or are empty.
vec2 joined(vec2 a, vec2 b) { return a.x > a.y ? b : b.x > b.y ? a : vec2(min(a.x, b.x), max(a.y, b.y)); }

// How near the ray passes the axis between lo and hi.
float distance_to_axis(OwnRay ray, AxialRay r, vec3 u, float lo, float hi) {
  float nearest = r.d_p > 1e-8 * abs(r.dz) ? r.fz * r.dz / (r.d_p * r.d_p) : 0.0;
  float z = clamp(r.fz + nearest * r.dz, lo, hi);
  return length((ray.f - z * u) + (z * r.dz / dot(ray.d, ray.d)) * ray.d);
}

// A frustum or a cylinder between lo and hi, closed by discs: where the ray is inside, and in zw whether a disc ends that.
vec4 inside_frustum(AxialRay r, float radius, float slope, float z0, float lo, float hi) {
  vec2 side = inside_round(r, radius, slope, z0), slab = between(r, lo, hi), s = both(side, slab);
  return vec4(s, slab.x > side.x ? 1.0 : 0.0, slab.y < side.y ? 1.0 : 0.0);
}
// At the point q of its surface: outward, in own space, not unit. `disc`: on one that the ray with direction d crosses.
vec3 frustum_normal(vec3 q, vec3 d, vec3 u, float slope, bool disc, bool exit) {
  vec3 across = q - dot(q, u) * u;
  float away = length(across);
  vec3 side = away > 0.0 ? across / away - slope * u : (slope > 0.0 ? -1.0 : 1.0) * u;
  return disc ? ((dot(d, u) > 0.0) == exit ? 1.0 : -1.0) * u : side;
}

#ifdef TILES
// The same for visibility in tiles: f is any point of the ray near the particle.
struct TileRay {
  float f_f, f_d, d_d, fz, dz, dp2, across;
};
TileRay tile_ray(vec2 f, vec2 d, vec3 u) {
  vec3 dxu = vec3(d.y * u.z - u.y, u.x - d.x * u.z, d.x * u.y - d.y * u.x);
  return TileRay(dot(f, f), dot(f, d), 1.0 + dot(d, d), dot(f, u.xy), dot(d, u.xy) + u.z, dot(dxu, dxu), dot(f, dxu.xy));
}
vec2 tile_round(TileRay r, float radius, float slope, float z0) {
  float rho = radius + slope * (r.fz - z0), rho_d = slope * r.dz;
  float fp_dp = r.f_d - r.fz * r.dz, fp2 = r.f_f - r.fz * r.fz;
  float q = rho * rho * r.dp2 + rho_d * (rho_d * fp2 - 2.0 * rho * fp_dp) - r.across * r.across;
  float a = r.dp2 - rho_d * rho_d, b = fp_dp - rho * rho_d;
  float root = sqrt(max(q, 0.0)), sum = b >= 0.0 ? -(b + root) : root - b; // never root - |b|: rays along a generator have a = 0
  float one = sum != 0.0 ? (fp2 - rho * rho) / sum : 0.0, other = sum / (abs(a) > 1e-14 ? a : -1e-14);
  vec2 s = vec2(min(one, other), max(one, other));
  vec2 closed = q >= 0.0 && rho + rho_d * 0.5 * (s.x + s.y) >= 0.0 ? s : vec2(beyond, -beyond);
  vec2 open = rho_d > 0.0 ? vec2(s.y, beyond) : vec2(-beyond, s.x);
  vec2 along = fp2 <= rho * rho ? vec2(-beyond, beyond) : vec2(beyond, -beyond);
  return slope == 0.0 && r.dp2 < 1e-12 ? along : a > 0.0 ? closed : open;
}
vec2 tile_between(TileRay r, float lo, float hi) {
  float inverse = 1.0 / (abs(r.dz) > 1e-20 ? r.dz : 1e-20), a = (lo - r.fz) * inverse, b = (hi - r.fz) * inverse;
  return vec2(min(a, b), max(a, b));
}
#endif

// Outlines of these types are not blended: covered or not, by the sample.
Outline sampled_outline(bool covered) { return Outline(covered ? 1e3 : -1e3, vec2(1.0, 0.0), 1e3, vec2(0.0)); }

#endif
