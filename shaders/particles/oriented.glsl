// SPDX-License-Identifier: MIT
// What types with three axes of their own share (ellipsoid, box, superquadric): the record (center relative to the chunk, radius
// of the bounding ball), (quaternion x, y, z, w), (half lengths of the axes, -) and, of the superquadric, (e1, e2, -, -); the
// particle in its own space; a ray in its axes. A quaternion counts by its direction. These solids are symmetric about each
// plane of their axes, so a mirroring placement turns an axis at most into its opposite.
// A type defines record_vec4s before it includes this, HANDED if its solid is not symmetric, and FINE_AXES where directions of axes in
// floats are not enough (their errors count by the square of the ratio of the axes) and the record has no shape.
#ifndef MOTE_ORIENTED_GLSL
#define MOTE_ORIENTED_GLSL

#include "particles/bounds.glsl"
#ifdef FINE_AXES
#include "particles/fine_axes.glsl"
#endif

#define CASTER_VEC4S 4
#ifdef NEAR_EYE
const int payload_vec4s = 5;
#else
const int payload_vec4s = 4;
#endif

struct Particle {
  vec3 center; // view space
  float bound;
  vec3 x, y;   // own space, as all that follows: the first two axes, unit; the third is their cross product
  vec3 size;
  vec2 shape;
#ifdef FINE_AXES
  vec3 turn;   // by which the axes are turned from x and y, a rotation vector
#endif
#ifdef HANDED
  float hand;  // -1 where a placement mirrors: of the third axis
#endif
#ifdef NEAR_EYE
  vec3 rest;   // center - float32(center)
#endif
};

Particle oriented(vec4 record[record_vec4s], Placement at, vec3 center, float bound) {
  vec4 q = record[1];
  float s = 2.0 / dot(q, q);
  Particle p;
  p.center = center;
  p.bound = bound;
  p.x = normalize(turned(at, vec3(1.0 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y + q.w * q.z), s * (q.x * q.z - q.w * q.y))));
  vec3 y = turned(at, vec3(s * (q.x * q.y - q.w * q.z), 1.0 - s * (q.x * q.x + q.z * q.z), s * (q.y * q.z + q.w * q.x)));
  p.y = normalize(y - dot(p.x, y) * p.x);
#ifdef FINE_AXES // apart from the above, which is all that tiles need for visibility
  FineColumns fine = fine_columns(q);
  vec3 x_rest = fine_rest(turned(at, fine.x), turned(at, fine.x_rest), p.x), y_rest = fine_rest(turned(at, fine.y), turned(at, fine.y_rest), p.y);
  vec3 across = cross(p.x, p.y);
  p.turn = vec3(dot(y_rest, across), -dot(x_rest, across), dot(x_rest, p.y));
#endif
  p.size = scaled(at, 1.0) * record[2].xyz;
  p.shape = record_vec4s > 3 ? record[record_vec4s - 1].xy : vec2(1.0);
#ifdef HANDED
  vec3 z = turned(at, vec3(s * (q.x * q.z + q.w * q.y), s * (q.y * q.z - q.w * q.x), 1.0 - s * (q.x * q.x + q.y * q.y)));
  p.hand = dot(cross(p.x, p.y), z) < 0.0 ? -1.0 : 1.0;
#endif
  return p;
}

#ifdef NEAR_EYE
Particle place_near(vec4 record[record_vec4s], Placement at, vec4 near[4]) {
  Particle p = oriented(record, at, near[0].xyz, near[0].w);
  p.rest = near[1].xyz;
  return p;
}
#else
Particle place(vec4 record[record_vec4s], Placement at) {
  return oriented(record, at, placed_center(at, record[0].xyz), scaled(at, record[0].w));
}
#endif
Particle unpack(vec4 payload[payload_vec4s]) {
  Particle p;
  p.center = payload[0].xyz;
  p.bound = payload[0].w;
  p.x = payload[1].xyz;
  p.y = payload[2].xyz;
  p.size = vec3(payload[1].w, payload[2].w, payload[3].x);
#ifdef FINE_AXES
  p.turn = payload[3].yzw;
#else
  p.shape = payload[3].yz;
#endif
#ifdef HANDED
  p.hand = payload[3].w;
#endif
#ifdef NEAR_EYE
  p.rest = payload[4].xyz;
#endif
  return p;
}
void pack(Particle p, out vec4 payload[payload_vec4s]) {
  payload[0] = vec4(p.center, p.bound);
  payload[1] = vec4(p.x, p.size.x);
  payload[2] = vec4(p.y, p.size.y);
#ifdef FINE_AXES
  payload[3] = vec4(p.size.z, p.turn);
#elif defined(HANDED)
  payload[3] = vec4(p.size.z, p.shape, p.hand);
#else
  payload[3] = vec4(p.size.z, p.shape, 0.0);
#endif
#ifdef NEAR_EYE
  payload[4] = vec4(p.rest, 0.0);
#endif
}

#ifdef HANDED
mat3 axes_of(Particle p) { return mat3(p.x, p.y, p.hand * cross(p.x, p.y)); }
#else
mat3 axes_of(Particle p) { return mat3(p.x, p.y, cross(p.x, p.y)); }
#endif
float least(vec3 v) { return min(v.x, min(v.y, v.z)); }

OwnRay ray_of(Ray ray, Particle p) {
#ifdef NEAR_EYE
  return own_ray(ray, p.center, p.rest);
#else
  return own_ray(ray, p.center, vec3(0.0));
#endif
}

// A ray where the half lengths are 1: l its point nearest to the center, of depth depth.x + depth.y. Moved near in own space
// first, then scaled, then moved again (method book, section 3.5): the ratio of the axes enters once.
struct UnitRay {
  vec3 l, d;
  vec2 depth;
};
UnitRay unit_ray(Ray ray, Particle p) {
  OwnRay own = ray_of(ray, p);
  mat3 axes = axes_of(p);
  UnitRay u;
#ifdef FINE_AXES
  // The way between the two nearest points is gone in own space, where it is exact; scaled, it would keep the roundings of both.
  FineAxes fine = fine_axes(p.x, p.y, p.turn);
  u.d = in_axes(own.d, vec3(0.0), fine) / p.size;
  float ia = 1.0 / dot(u.d, u.d);
  precise float shift = hi12(-dot((own.f * axes) / p.size, u.d) * ia);
  precise vec3 dh = hi12(own.d);
  precise vec3 dl = own.d - dh;
  vec3 f, rest;
  two_sum(own.f, dh * shift, f, rest);
  vec3 l = in_axes(f, rest + own.rest + dl * shift, fine) / p.size;
  float e = dot(l, u.d) * ia;
  u.l = l - e * u.d;
  u.depth = vec2(own.depth.x, own.depth.y + (shift - e));
#else
  float shift;
  u.d = (own.d * axes) / p.size;
  shift_to_nearest((own.f * axes) / p.size, u.d, u.l, shift);
  u.depth = vec2(own.depth.x, own.depth.y + shift);
#endif
  return u;
}
// A normal where the half lengths are 1 (a gradient there) in view space; unit.
vec3 normal_from_unit(vec3 gradient, Particle p) { return normal_from_own(axes_of(p) * (gradient * (least(p.size) / p.size))); }

// The rectangle of the box around the solid, whose corners lie before the near plane; else that of the ball.
Proxy box_proxy(Particle p, vec3 size) {
  mat3 axes = axes_of(p);
  vec3 x = from_own(axes[0] * size.x), y = from_own(axes[1] * size.y), z = from_own(axes[2] * size.z);
  float z_min = p.center.z - abs(x.z) - abs(y.z) - abs(z.z);
  Proxy parts = Proxy(vec2(1e30), vec2(-1e30), z_min);
  for (int i = 0; i < 8; ++i) {
    vec3 corner = p.center + ((i & 1) != 0 ? x : -x) + ((i & 2) != 0 ? y : -y) + ((i & 4) != 0 ? z : -z);
    vec2 at = orthographic ? corner.xy : corner.xy / corner.z;
    parts.lo = min(parts.lo, at);
    parts.hi = max(parts.hi, at);
  }
  return hull_proxy(parts, z_min, p.center, p.bound);
}

#ifdef TILES
// The quaternion (w >= 0) of a rotation over 1 + w: three numbers, exact for all rotations.
vec3 rodrigues(mat3 m) {
  vec4 squares = 1.0 + vec4(m[0][0] - m[1][1] - m[2][2], m[1][1] - m[0][0] - m[2][2], m[2][2] - m[0][0] - m[1][1], m[0][0] + m[1][1] + m[2][2]);
  vec3 sums = vec3(m[1][2] + m[2][1], m[2][0] + m[0][2], m[0][1] + m[1][0]), differences = vec3(m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]);
  float most = max(max(squares.x, squares.y), max(squares.z, squares.w));
  vec4 q = most == squares.w ? vec4(differences, most) : most == squares.x ? vec4(most, sums.z, sums.y, differences.x)
           : most == squares.y ? vec4(sums.z, most, sums.x, differences.y) : vec4(sums.y, sums.x, most, differences.z);
  q *= (q.w < 0.0 ? -1.0 : 1.0) * inversesqrt(dot(q, q));
  return q.xyz / (1.0 + q.w);
}
mat3 from_rodrigues(vec3 r) {
  float rr = dot(r, r), k = 1.0 / (1.0 + rr);
  vec3 v = 2.0 * k * r;
  float w = (1.0 - rr) * k;
  return mat3(1.0 - 2.0 * (v.y * v.y + v.z * v.z), 2.0 * (v.x * v.y + w * v.z), 2.0 * (v.x * v.z - w * v.y),
              2.0 * (v.x * v.y - w * v.z), 1.0 - 2.0 * (v.x * v.x + v.z * v.z), 2.0 * (v.y * v.z + w * v.x),
              2.0 * (v.x * v.z + w * v.y), 2.0 * (v.y * v.z - w * v.x), 1.0 - 2.0 * (v.x * v.x + v.y * v.y));
}
#endif

// Outlines of these types are not blended: covered or not, by the sample.
Outline sampled_outline(bool covered) { return Outline(covered ? 1e3 : -1e3, vec2(1.0, 0.0), 1e3, vec2(0.0)); }

#endif
