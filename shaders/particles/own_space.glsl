// SPDX-License-Identifier: MIT
// A particle's own space: that of its record's vectors, with the particle's center as the origin. What a type is made of
// (half axes, radii) is said there, and rays are brought there, so that one intersection serves every placement.
// Without AFFINE it is view space, moved. With AFFINE (a placement that is no similarity, linear = U S V^T) it is the data
// set's space turned by V^T: rays come by S^-1 U^T, which is exact to rounding however uneven S is, records by V^T.
// Included by type.glsl files behind interface.glsl; used by every type.
#ifndef MOTE_OWN_SPACE_GLSL
#define MOTE_OWN_SPACE_GLSL

#ifdef AFFINE
mat3 unit_axes() { // U: columns are the directions in view space that the axes of own space get
  vec3 x = vec3(batch.axes[0], batch.axes[1], batch.axes[2]), y = vec3(batch.axes[3], batch.axes[4], batch.axes[5]);
  return mat3(x, y, cross(x, y));
}
vec3 unit_lengths() { return vec3(batch.linear0_scale.w, batch.linear1.w, batch.linear2.w); } // S; all below 0 where it mirrors

vec3 turned(Placement at, vec3 v) { // V^T v; V from its modified Rodrigues parameters, tan(angle / 4) times the axis
  vec3 p = vec3(batch.turn[0], batch.turn[1], batch.turn[2]);
  float pp = dot(p, p);
  vec3 t = cross(v, p); // v turned by -angle: the quaternion is (2 p, 1 - pp) / (1 + pp)
  return v + (4.0 * (1.0 - pp) * t + 8.0 * cross(t, p)) / ((1.0 + pp) * (1.0 + pp));
}
float scaled(Placement at, float size) { return size; }
vec3 to_own(vec3 v) { return (v * unit_axes()) / unit_lengths(); }
vec3 from_own(vec3 v) { return unit_axes() * (unit_lengths() * v); }
// A normal by the inverse transpose; unit.
vec3 normal_from_own(vec3 n) {
  vec3 lengths = unit_lengths();
  return normalize(unit_axes() * (n * (min(abs(lengths.x), min(abs(lengths.y), abs(lengths.z))) / lengths)));
}
#else
// A vector of a record in own space (by a mirroring placement it is mirrored), and a size.
vec3 turned(Placement at, vec3 v) { return at.linear * v; }
float scaled(Placement at, float size) { return size * at.scale; }
vec3 to_own(vec3 v) { return v; }
vec3 from_own(vec3 v) { return v; }
vec3 normal_from_own(vec3 n) { return normalize(n); }
#endif

// The center of a record in view space.
vec3 placed_center(Placement at, vec3 relative) {
  precise vec3 center = at.linear * relative + at.origin;
  return center;
}

// A ray in own space: f, its point nearest to the center, the direction d, and the depth of f as a sum of two floats:
// a point f + s d has the depth depth.x + (depth.y + s). Method book, section 3.0.
// `rest`: what rounding took from f.
struct OwnRay {
  vec3 f, d;
  vec2 depth;
  vec3 rest;
};

// `rest`: center - float32(center); 0 but for NEAR_EYE.
OwnRay own_ray(Ray ray, vec3 center, vec3 rest) {
  vec3 l = vec3(ray.origin.xy - center.xy, 0.0), low = vec3(0.0);
  vec2 depth = vec2(center.z, 0.0);
  if (!orthographic) shift_in_pairs(ray.origin - center, vec3(0.0), ray.direction, l, low, depth);
#ifdef NEAR_EYE
  low += orthographic ? ray.rest - vec3(rest.xy, 0.0) : depth.x * ray.rest - rest;
  if (orthographic) depth.y = rest.z;
#endif
  OwnRay own = OwnRay(to_own(l), to_own(ray.direction), depth, to_own(low));
#if defined(AFFINE) || defined(NEAR_EYE)
  vec2 shift;
  vec3 f = own.f, f_rest = own.rest;
  shift_in_pairs(f, f_rest, own.d, own.f, own.rest, shift);
  own.depth.y += shift.x + shift.y;
#endif
  return own;
}
// The point of an own ray where it meets depth t; exact enough for shading.
vec3 own_point(Ray ray, vec3 center, float t) { return to_own(t * ray.direction + (ray.origin - center)); }

// What an intersection found on an own ray: from s.x to s.y, and what it wants to remember of both ends; s is one point
// where the ray misses.
Interval interval_of(OwnRay own, vec2 s, vec2 parts) {
  return Interval(own.depth.x + (own.depth.y + s.x), own.depth.x + (own.depth.y + s.y), vec4(own.f, 0.0), vec4(s, parts));
}
// Of types that form their normals with the intersection (own space, any length).
Interval interval_of(OwnRay own, vec2 s, vec3 normal_in, vec3 normal_out, vec2 parts) {
  return Interval(own.depth.x + (own.depth.y + s.x), own.depth.x + (own.depth.y + s.y), vec4(normal_in, parts.x), vec4(normal_out, parts.y));
}
vec3 interval_point(Ray ray, Interval hit, bool exit) { return hit.local.xyz + (exit ? hit.ends.y : hit.ends.x) * to_own(ray.direction); }

#endif
