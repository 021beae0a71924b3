// SPDX-License-Identifier: MIT
// Particle type `box`: record of oriented.glsl with the half extents. Between three pairs of planes (Kay and Kajiya 1986), from
// the ray's point nearest to the center. One half extent may be 0: a plate.
const int record_vec4s = 3;
#include "particles/oriented.glsl"

bool drawable(Particle p) { return p.bound > 0.0 && least(p.size) >= 0.0; }
Proxy proxy(Particle p) { return box_proxy(p, p.size); }

// A ray along a face meets its plane far away.
vec3 not_zero(vec3 d) { return mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20))); }

// Entry and exit on a ray f + s d in the box's axes, and the axes of the faces there.
vec4 within_box(vec3 f, vec3 d, vec3 size) {
  vec3 inverse = 1.0 / not_zero(d);
  vec3 a = (-size - f) * inverse, b = (size - f) * inverse;
  vec3 lo = min(a, b), hi = max(a, b);
  float first = max(lo.x, max(lo.y, lo.z)), last = min(hi.x, min(hi.y, hi.z));
  return vec4(first, last, lo.x == first ? 0.0 : lo.y == first ? 1.0 : 2.0, hi.x == last ? 0.0 : hi.y == last ? 1.0 : 2.0);
}

bool intersect(Ray ray, Particle p, out Interval hit) {
  OwnRay own = ray_of(ray, p);
  mat3 axes = axes_of(p);
  vec4 s = within_box(own.f * axes, own.d * axes, p.size);
  bool met = s.x <= s.y;
  hit = interval_of(own, met ? s.xy : vec2(0.0), s.zw);
  return met;
}

vec3 face_normal(Particle p, int axis, float sign_) { return normal_from_own(axes_of(p)[axis] * sign_); }
vec3 outward_normal(Ray ray, Particle p, Interval hit, bool exit) {
  int axis = int(exit ? hit.ends.w : hit.ends.z);
  float along = dot(to_own(ray.direction), axes_of(p)[axis]);
  return face_normal(p, axis, (along >= 0.0) == exit ? 1.0 : -1.0);
}

bool passes_thin(Ray ray, Particle p, Interval hit, float radius) {
  OwnRay own = ray_of(ray, p);
  mat3 axes = axes_of(p);
  vec4 s = within_box(own.f * axes, own.d * axes, p.size + radius);
  return least(p.size) < radius && s.x <= s.y;
}
Outline outline(Ray ray, Particle p, Interval hit) { Interval again; return sampled_outline(intersect(ray, p, again)); }

#ifdef TILES
Proxy tile_proxy(Particle p) { return proxy(p); }

// With the axes over the half extents, E, and the center c: the planes lie at (E.c -+ 1) / E.d on the ray d = (x, y, 1).
struct TileTest { vec4 a, b, c; }; // (E, E.c) of each axis

TileTest tile_test(Particle p, bool alive) {
  mat3 axes = axes_of(p);
  vec3 size = max(p.size, vec3(1e-6 * p.bound));
  vec3 x = axes[0] / size.x, y = axes[1] / size.y, z = axes[2] / size.z;
  TileTest s = TileTest(vec4(x, dot(x, p.center)), vec4(y, dot(y, p.center)), vec4(z, dot(z, p.center)));
  if (!alive) s = TileTest(vec4(0.0, 0.0, 1.0, 1e30), vec4(0.0, 0.0, 1.0, -1e30), vec4(0.0, 0.0, 1.0, 0.0));
  return s;
}

bool tile_nearer(TileTest s, float x, float y, inout float key) {
  vec3 across = vec3(x * s.a.x + y * s.a.y, x * s.b.x + y * s.b.y, x * s.c.x + y * s.c.y), along = vec3(s.a.z, s.b.z, s.c.z);
  vec3 inverse = 1.0 / not_zero(orthographic ? along : along + across);
  vec3 center = vec3(s.a.w, s.b.w, s.c.w) - (orthographic ? across : vec3(0.0));
  vec3 a = (center - 1.0) * inverse, b = (center + 1.0) * inverse, lo = min(a, b), hi = max(a, b);
  float first = max(lo.x, max(lo.y, lo.z)), last = min(hi.x, min(hi.y, hi.z));
  float entry = orthographic ? first : first * (1.0 + x * x + y * y);
  bool nearer = first <= last && entry < key;
  key = nearer ? entry : key;
  return nearer;
}

vec3 normal_at(Ray ray, Particle p, float t) {
  vec3 q = own_point(ray, p.center, t) * axes_of(p);
  vec3 off = abs(q) - p.size; // 0 on the face that it lies on, else below
  float nearest = max(off.x, max(off.y, off.z));
  int axis = off.x == nearest ? 0 : off.y == nearest ? 1 : 2;
  return face_normal(p, axis, q[axis] >= 0.0 ? 1.0 : -1.0);
}
#endif
