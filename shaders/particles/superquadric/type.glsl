// SPDX-License-Identifier: MIT
// Particle type `superquadric` (Barr, IEEE CG&A 1981): record of oriented.glsl with the semi-axes and (e1, e2), each in (0, 2]. Where
// the semi-axes are 1, g(p) = | (|(x, y)|_p2, z) |_p1 with p = 2 / e >= 1 is a norm and g = 1 the surface (method book,
// section 3.6): convex along any ray, so Newton's steps from outside of it come near without passing it, and a slope of 0
// with g > 1 says that the ray misses. Powers of ratios in [0, 1] only, by exp2 and log2, whose rounding the root takes back.
const int record_vec4s = 4;
#include "particles/oriented.glsl"

bool drawable(Particle p) { return least(p.size) > 0.0 && min(p.shape.x, p.shape.y) > 0.0; }
Proxy proxy(Particle p) { return box_proxy(p, p.size); }

// |(a, b)|_p of numbers >= 0, and its derivatives.
vec3 p_norm(float a, float b, float p) {
  float most = max(max(a, b), 1e-30);
  vec2 logs = log2(max(vec2(a, b) / most, vec2(1e-37))); // one of them 0
  float rest = log2(1.0 + exp2(p * min(logs.x, logs.y))) / p;
  return vec3(most * exp2(rest), exp2((p - 1.0) * (logs - rest)));
}

// g and its gradient; power = 2 / (e1, e2).
vec4 gauge(vec3 q, vec2 power) {
  vec3 flat_ = p_norm(abs(q.x), abs(q.y), power.y);
  vec3 all = p_norm(flat_.x, abs(q.z), power.x);
  return vec4(all.x, sign(q) * vec3(all.y * flat_.yz, all.z));
}

const float converged = 2e-7; // of g: about what exp2 and log2 leave
const int most_steps = 40;

// The first s >= range.x on l + s d with g = 1; beyond range.y where there is none.
float first_root(vec3 l, vec3 d, vec2 range, vec2 power) {
  float s = range.x, miss = range.y + abs(range.y) + 1.0;
  int steps = 0;
  bool going = range.x <= range.y;
  if (!going) s = miss;
  do {
    vec4 g = gauge(l + s * d, power);
    float slope = dot(g.yzw, d), over = g.x - 1.0;
    bool found = over <= converged, lost = !found && slope >= 0.0;
    float next = s - over / min(slope, -1e-30);
    bool refine = found && -slope > 0.05 * length(d); // a last step, where it is sound
    ++steps;
    going = going && !found && !lost && steps < most_steps && next > s;
    s = (lost && over > 1e-6) || (steps == most_steps && over > 1e-5) ? miss : going || refine ? next : s;
    going = going && s <= range.y;
  } while (going);
  return s;
}

// Where the ray is within the cube around the solid.
vec2 within_cube(vec3 l, vec3 d) {
  vec3 inverse = 1.0 / mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20)));
  vec3 a = (-1.0 - l) * inverse, b = (1.0 - l) * inverse, lo = min(a, b), hi = max(a, b);
  return vec2(max(lo.x, max(lo.y, lo.z)), min(hi.x, min(hi.y, hi.z)));
}

bool intersect(Ray ray, Particle p, out Interval hit) {
  UnitRay u = unit_ray(ray, p);
  vec2 power = 2.0 / p.shape, cube = within_cube(u.l, u.d);
  float first = first_root(u.l, u.d, cube, power);
  bool met = first <= cube.y;
  float last = met ? -first_root(u.l, -u.d, vec2(-cube.y, -first), power) : 0.0;
  vec2 s = met ? vec2(first, max(first, last)) : vec2(0.0);
  hit = Interval(u.depth.x + (u.depth.y + s.x), u.depth.x + (u.depth.y + s.y), vec4(u.l, 0.0), vec4(s, 0.0, 0.0));
  return met;
}

vec3 outward_normal(Ray ray, Particle p, Interval hit, bool exit) {
  vec3 d = (to_own(ray.direction) * axes_of(p)) / p.size;
  return normal_from_unit(gauge(hit.local.xyz + (exit ? hit.ends.y : hit.ends.x) * d, 2.0 / p.shape).yzw, p);
}

// The distance to the surface point behind the one nearest to the center: never less than the true one.
bool passes_thin(Ray ray, Particle p, Interval hit, float radius) {
  vec3 q = hit.local.xyz + hit.ends.x * ((to_own(ray.direction) * axes_of(p)) / p.size);
  float beyond = max(gauge(q, 2.0 / p.shape).x, 1.0);
  return least(p.size) < radius && length(q * p.size) * (1.0 - 1.0 / beyond) < radius;
}
Outline outline(Ray ray, Particle p, Interval hit) { Interval again; return sampled_outline(intersect(ray, p, again)); }

#ifdef TILES
#define TILE_LOOP
Proxy tile_proxy(Particle p) { return proxy(p); }

// Rays start in the plane of the center's depth, so that everything is as small as the particle: with m the direction to the
// center with z = 1, at z (x - m.x, y - m.y, 0) from it.
struct TileTest { vec4 a, b, c; }; // (m, z, 2 / e1), (rotation, 2 / e2), (semi-axes, alive)

TileTest tile_test(Particle p, bool alive) {
  vec2 m = orthographic ? p.center.xy : p.center.xy / p.center.z;
  return TileTest(vec4(m, p.center.z, 2.0 / p.shape.x), vec4(rodrigues(axes_of(p)), 2.0 / p.shape.y), vec4(p.size, alive ? 1.0 : 0.0));
}

bool tile_nearer(TileTest s, float x, float y, inout float key) {
  float k = orthographic ? 1.0 : s.a.z;
  mat3 axes = from_rodrigues(s.b.xyz);
  vec3 f = (vec3(k * (x - s.a.x), k * (y - s.a.y), 0.0) * axes) / s.c.xyz, d = (vec3(orthographic ? vec2(0.0) : vec2(x, y), 1.0) * axes) / s.c.xyz;
  float shift = -dot(f, d) / dot(d, d);
  vec3 l = f + shift * d;
  vec2 cube = within_cube(l, d);
  cube.y = s.c.w > 0.0 ? cube.y : -1e30;
  float ray2 = orthographic ? 1.0 : 1.0 + x * x + y * y;
  cube.y = (s.a.z + (shift + cube.x)) * ray2 < key ? cube.y : -1e30; // hidden: not solved
  float first = first_root(l, d, cube, vec2(s.a.w, s.b.w));
  float entry = (s.a.z + (shift + first)) * ray2;
  bool nearer = first <= cube.y && entry < key;
  key = nearer ? entry : key;
  return nearer;
}

vec3 normal_at(Ray ray, Particle p, float t) { return normal_from_unit(gauge((own_point(ray, p.center, t) * axes_of(p)) / p.size, 2.0 / p.shape).yzw, p); }
#endif
