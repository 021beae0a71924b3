// SPDX-License-Identifier: MIT
// What types with an axis share (capsule, cylinder, cone, arrow): a ray split along and across the axis, and where it is
// between two planes across the axis. Formulas: method book, section 3.2; all numbers in the particle's own space.
#ifndef MOTE_AXIAL_GLSL
#define MOTE_AXIAL_GLSL

#include "particles/bounds.glsl"

const float beyond = 1e30; // a parameter that no ray reaches

// The unit axis and half length; of a particle without length, any axis. h: the axis as it came, which has no rounding of its own.
struct Axis {
  vec3 u, h;
  float half_length;
};
Axis axis_of(vec3 h) {
  float length_ = length(h);
  vec3 u = length_ > 0.0 ? h / length_ : vec3(0.0, 0.0, 1.0);
  return Axis(u, length_ > 1e-15 ? h : u, length_); // squares stay in range
}

// What lies across the axis errs by its own rounding, not by that of what lies along it.
struct AxialRay {
  float fz, dz;      // along the axis
  vec3 fp, dp;       // across it
  float f_p, d_p;    // their lengths
  vec3 l;            // the ray's point nearest to the axis, across it; fp where the ray is parallel
  float l_p, to_axis; // its length and parameter
  bool parallel;
};
AxialRay axial(OwnRay ray, Axis axis) {
  AxialRay r;
  r.fz = dot(ray.f, axis.u);
  r.dz = dot(ray.d, axis.u);
  vec3 f_rest, d_rest, rest;
  vec2 parameter;
  shift_in_pairs(ray.f, ray.rest, axis.h, r.fp, f_rest, parameter);
  shift_in_pairs(ray.d, vec3(0.0), axis.h, r.dp, d_rest, parameter);
  r.f_p = length(r.fp);
  r.d_p = length(r.dp);
  r.parallel = r.d_p <= 1e-8 * abs(r.dz);
  shift_in_pairs(r.fp, f_rest, r.parallel ? axis.u : r.dp, r.l, rest, parameter);
  r.to_axis = r.parallel ? 0.0 : parameter.x + parameter.y;
  r.l += rest + r.to_axis * d_rest;
  r.l -= dot(r.l, axis.u) * axis.u; // the way here was long, its roundings count
  r.l_p = length(r.l);
  return r;
}

// Where the ray is between the planes z = lo and z = hi; empty (x > y) where never.
vec2 between(AxialRay r, float lo, float hi) {
  float inverse = 1.0 / r.dz;
  float a = (lo - r.fz) * inverse, b = (hi - r.fz) * inverse;
  bool parallel_in = r.fz >= lo && r.fz <= hi;
  return r.dz != 0.0 ? vec2(min(a, b), max(a, b)) : parallel_in ? vec2(-beyond, beyond) : vec2(beyond, -beyond);
}

// A stretch of a ray within a body, and its ends as seen from the axis (or from the center of a ball).
struct Stretch {
  vec2 s;
  vec3 first, last;
};

// Within the endless body of radius rho(z) = radius + slope (z - z0) around the axis (a cylinder with slope 0, a cone of one nappe
// else). Rays that meet a nappe twice (a > 0) are solved from their point nearest to the axis, where b is -rho rho_d.
Stretch inside_round(AxialRay r, float radius, float slope, float z0) {
  float rho_d = slope * r.dz, a = (r.d_p - abs(rho_d)) * (r.d_p + abs(rho_d));
  bool twice = a > 0.0;
  vec3 l = twice ? r.l : r.fp;
  float shift = twice ? r.to_axis : 0.0, l_p = twice ? r.l_p : r.f_p;
  float rho = radius + slope * ((r.fz - z0) + shift * r.dz);
  float g = twice ? abs(rho) * r.d_p : length(rho * r.dp - rho_d * r.fp), x = r.l_p * (twice ? sqrt(a) : r.d_p);
  float discriminant = (g - x) * (g + x);
  float b = (twice ? 0.0 : dot(r.fp, r.dp)) - rho * rho_d, c = (l_p - rho) * (l_p + rho);
  float root = sqrt(max(discriminant, 0.0));
  float q = b >= 0.0 ? -(b + root) : root - b;
  float one = q != 0.0 ? c / q : 0.0;
  float other = a != 0.0 ? q / a : q >= 0.0 ? -beyond : beyond; // a = 0: along a generator, as the limit of steep rays
  vec2 s = vec2(min(one, other), max(one, other));
  bool other_nappe = rho + rho_d * 0.5 * (max(s.x, -1e20) + min(s.y, 1e20)) < 0.0;
  bool missed = discriminant < 0.0 || other_nappe;
  Stretch closed = Stretch(missed ? vec2(beyond, -beyond) : shift + s, l + s.x * r.dp, l + s.y * r.dp);
  vec2 open = rho_d > 0.0 ? vec2(s.y, beyond) : vec2(-beyond, s.x); // a steep ray meets one nappe once
  vec2 along = r.f_p <= rho ? vec2(-beyond, beyond) : vec2(beyond, -beyond);
  if (!twice) closed = Stretch(open, l + s.y * r.dp, l + s.x * r.dp);
  if (r.parallel && slope == 0.0) closed = Stretch(along, r.fp, r.fp);
  return closed;
}

// Within the ball around a center, both in own space.
Stretch inside_ball(OwnRay ray, vec3 center, float radius) {
  vec3 f, rest, l;
  two_sum(ray.f, -center, f, rest);
  vec2 middle;
  vec3 l_rest;
  shift_in_pairs(f, rest + ray.rest, ray.d, l, l_rest, middle);
  float distance = length(l), d2 = (radius - distance) * (radius + distance);
  float h = sqrt(max(d2, 0.0) / dot(ray.d, ray.d)), s = middle.x + middle.y;
  return Stretch(d2 >= 0.0 ? vec2(s - h, s + h) : vec2(beyond, -beyond), l - h * ray.d, l + h * ray.d);
}

vec2 both(vec2 a, vec2 b) { return vec2(max(a.x, b.x), min(a.y, b.y)); }
// Of intervals that touch or are empty.
vec2 joined(vec2 a, vec2 b) { return a.x > a.y ? b : b.x > b.y ? a : vec2(min(a.x, b.x), max(a.y, b.y)); }

Stretch joined(Stretch a, Stretch b) {
  vec2 s = joined(a.s, b.s);
  return Stretch(s, s.x == b.s.x ? b.first : a.first, s.y == b.s.y ? b.last : a.last);
}

// A cylinder with round ends.
Stretch inside_capsule(OwnRay ray, AxialRay r, Axis axis, vec3 h, float radius) {
  Stretch side = inside_round(r, radius, 0.0, 0.0);
  side.s = both(side.s, between(r, -axis.half_length, axis.half_length));
  return joined(joined(side, inside_ball(ray, -h, radius)), inside_ball(ray, h, radius));
}

#ifdef NEAR_EYE
// Near the eye a depth is small against the numbers that it was formed of, and their roundings show in it. So a depth that was found is
// moved onto the surface by a step of Newton, whose residual is formed of numbers of twice the precision.

// A ray's point at depth t as seen from the particle's center, in own space: a sum of two floats.
void point_in_pairs(Ray ray, vec3 center, vec3 rest, float t, out vec3 point, out vec3 point_rest) {
  vec3 m, m_rest, high, low;
  two_sum(center, -ray.origin, m, m_rest);
  along_minus(vec2(t, 0.0), ray.direction, orthographic ? vec3(0.0) : ray.rest, m, m_rest + rest - (orthographic ? ray.rest : vec3(0.0)), high, low);
  point = to_own(high);
  point_rest = to_own(low);
}
// slope: half the residual's derivative along a ray d. Steps that are no small part of the chord are not taken: at the limb.
float stepped(float t, float residual, float slope, vec3 d) {
  float step_ = residual / (2.0 * slope);
  return abs(step_) < 0.25 * abs(slope) / dot(d, d) ? t - step_ : t;
}

// Onto the points as far from the segment from -h to h as the radius. An error of the place on the segment counts squared.
float onto_capsule(Ray ray, vec3 center, vec3 rest, vec3 h, vec3 h_rest, float radius, float t) {
  vec3 p, p_rest, towards, towards_rest, d = to_own(ray.direction);
  point_in_pairs(ray, center, rest, t, p, p_rest);
  float z = clamp(dot(p, h) / max(dot(h, h), 1e-30), -1.0, 1.0);
  along_minus(vec2(z, 0.0), h, h_rest, p, p_rest, towards, towards_rest);
  vec2 residual = minus(dot_pair(towards, towards_rest, towards, towards_rest), two_product(radius, radius));
  return stepped(t, residual.x, -dot(towards, d), d);
}

vec2 length_in_pairs(vec3 h, vec3 h_rest) {
  vec2 hh = dot_pair(h, h_rest, h, h_rest);
  float root = sqrt(hh.x);
  return normal_pair(root, minus(hh, two_product(root, root)).x / (2.0 * root));
}

// Onto the side whose radius goes from `low` at -h to `high` at h, each a sum of two floats.
float onto_side(Ray ray, vec3 center, vec3 rest, vec3 h, vec3 h_rest, vec2 low, vec2 high, float t) {
  vec3 p, p_rest, towards, towards_rest, d = to_own(ray.direction);
  point_in_pairs(ray, center, rest, t, p, p_rest);
  vec2 hh = dot_pair(h, h_rest, h, h_rest), z = divided(dot_pair(p, p_rest, h, h_rest), hh);
  along_minus(z, h, h_rest, p, p_rest, towards, towards_rest);
  vec2 change = 0.5 * minus(high, low), radius = minus(0.5 * minus(high, -low), -times(change, z));
  vec2 residual = minus(dot_pair(towards, towards_rest, towards, towards_rest), times(radius, radius));
  return stepped(t, residual.x, -dot(towards, d) - radius.x * change.x * dot(d, h) / hh.x, d);
}
// Onto the plane across the axis that lies the length `back` before `end` times h; end: -1 or 1.
float onto_disc(Ray ray, vec3 center, vec3 rest, vec3 h, vec3 h_rest, float end, float back, float t) {
  vec3 p, p_rest;
  point_in_pairs(ray, center, rest, t, p, p_rest);
  vec2 residual = minus(dot_pair(p, p_rest, h, h_rest), end * dot_pair(h, h_rest, h, h_rest));
  residual = minus(residual, -times(vec2(back, 0.0), length_in_pairs(h, h_rest)));
  float slope = dot(to_own(ray.direction), h), step_ = residual.x / slope;
  return abs(step_) < 1e-3 * abs(t) ? t - step_ : t;
}
#endif

// How near the ray passes the axis between lo and hi.
float distance_to_axis(OwnRay ray, AxialRay r, vec3 u, float lo, float hi) {
  float nearest = r.d_p > 1e-8 * abs(r.dz) ? r.fz * r.dz / (r.d_p * r.d_p) : 0.0;
  float z = clamp(r.fz + nearest * r.dz, lo, hi);
  return length((ray.f - z * u) + (z * r.dz / dot(ray.d, ray.d)) * ray.d);
}

// Within a frustum or a cylinder between lo and hi, closed by discs, with the outward normals (own space, not unit) at both ends; which
// of them are on a disc.
struct FrustumStretch {
  vec2 s;
  vec3 first, last;
  bvec2 disc;
};
vec3 side_normal(vec3 across, vec3 u, float slope) {
  float away = length(across);
  return away > 0.0 ? across / away - slope * u : (slope > 0.0 ? -1.0 : 1.0) * u;
}
FrustumStretch inside_frustum(AxialRay r, vec3 u, float radius, float slope, float z0, float lo, float hi) {
  Stretch side = inside_round(r, radius, slope, z0);
  vec2 slab = between(r, lo, hi);
  bvec2 disc = bvec2(slab.x > side.s.x, slab.y < side.s.y);
  vec3 ahead = r.dz > 0.0 ? u : -u;
  return FrustumStretch(both(side.s, slab), disc.x ? -ahead : side_normal(side.first, u, slope), disc.y ? ahead : side_normal(side.last, u, slope), disc);
}

#ifdef TILES
// From the point of the segment from -h to h that is nearest to q; unit.
vec3 capsule_normal(vec3 q, vec3 h, float radius) {
  Axis axis = axis_of(h);
  return normal_from_own((q - clamp(dot(q, axis.u), -axis.half_length, axis.half_length) * axis.u) / radius);
}

// A frustum's face that a point near the surface is nearest to: its normal (not unit), and how far outside of the frustum the point is.
vec4 nearest_face(vec3 q, vec3 u, float radius, float slope, float z0, float lo, float hi) {
  float z = dot(q, u);
  vec3 across = q - z * u;
  float side = (length(across) - (radius + slope * (z - z0))) * inversesqrt(1.0 + slope * slope), disc = max(lo - z, z - hi);
  return vec4(side >= disc ? side_normal(across, u, slope) : lo - z > z - hi ? -u : u, max(side, disc));
}

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
