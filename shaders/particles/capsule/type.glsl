// SPDX-License-Identifier: MIT
// Particle type `capsule`: all points nearer than a radius to a segment. Record: (center relative to the chunk, radius of the
// bounding ball), (h, radius); the segment runs from center - h to center + h. Formulas: method book, sections 3.4 (the union of a
// cylinder and two balls, all from one shifted origin) and 4.2 (bounds). Without length it is a sphere.
#include "particles/axial.glsl"
#include "particles/touches.glsl"

#define CASTER_VEC4S 2
const int record_vec4s = 2;
#ifdef NEAR_EYE
const int payload_vec4s = 4;
#else
const int payload_vec4s = 2;
#endif

struct Particle {
  vec3 center; // view space
  float bound;
  vec3 h;      // own space, as all that follows
  float radius;
#ifdef NEAR_EYE
  vec3 rest, h_rest; // what rounding took from center and h
#endif
};

#ifdef NEAR_EYE
Particle place_near(vec4 record[record_vec4s], Placement at, vec4 near[4]) {
  return Particle(near[0].xyz, near[0].w, near[3].xyz, near[3].w, near[1].xyz, near[2].yzw);
}
Particle unpack(vec4 payload[payload_vec4s]) { return Particle(payload[0].xyz, payload[0].w, payload[1].xyz, payload[1].w, payload[2].xyz, payload[3].xyz); }
#else
Particle place(vec4 record[record_vec4s], Placement at) {
  return Particle(placed_center(at, record[0].xyz), scaled(at, record[0].w), turned(at, record[1].xyz), scaled(at, record[1].w));
}
Particle unpack(vec4 payload[payload_vec4s]) { return Particle(payload[0].xyz, payload[0].w, payload[1].xyz, payload[1].w); }
#endif
void pack(Particle p, out vec4 payload[payload_vec4s]) {
  payload[0] = vec4(p.center, p.bound);
  payload[1] = vec4(p.h, p.radius);
#ifdef NEAR_EYE
  payload[2] = vec4(p.rest, 0.0);
  payload[3] = vec4(p.h_rest, 0.0);
#endif
}

bool drawable(Particle p) { return p.radius > 0.0; }

Proxy proxy(Particle p) {
  vec3 h = from_own(p.h);
  float z_min = p.center.z - abs(h.z) - ball_depth(p.radius);
  return hull_proxy(united(ball_proxy(p.center - h, p.radius), ball_proxy(p.center + h, p.radius)), z_min, p.center, p.bound);
}

OwnRay ray_of(Ray ray, Particle p) {
#ifdef NEAR_EYE
  return own_ray(ray, p.center, p.rest);
#else
  return own_ray(ray, p.center, vec3(0.0));
#endif
}

bool intersect(Ray ray, Particle p, out Interval hit) {
  OwnRay own = ray_of(ray, p);
  Axis axis = axis_of(p.h);
  Stretch in_ = inside_capsule(own, axial(own, axis), axis, p.h, p.radius);
  bool met = in_.s.x <= in_.s.y;
  hit = interval_of(own, met ? in_.s : vec2(0.0), in_.first, in_.last, vec2(0.0));
#ifdef NEAR_EYE
  hit.t_in = met ? onto_capsule(ray, p.center, p.rest, p.h, p.h_rest, p.radius, hit.t_in) : hit.t_in;
  hit.t_out = met ? onto_capsule(ray, p.center, p.rest, p.h, p.h_rest, p.radius, hit.t_out) : hit.t_out;
#endif
  return met;
}
vec3 outward_normal(Ray ray, Particle p, Interval hit, bool exit) { return normal_from_own(exit ? hit.ends.xyz : hit.local.xyz); }

bool passes_thin(Ray ray, Particle p, Interval hit, float radius) {
  OwnRay own = ray_of(ray, p);
  Axis axis = axis_of(p.h);
  return p.radius < radius && distance_to_axis(own, axial(own, axis), axis.u, -axis.half_length, axis.half_length) < radius;
}
Outline outline(Ray ray, Particle p, Interval hit) { Interval again; return sampled_outline(intersect(ray, p, again)); }

#ifdef TILES
#define TILE_TOUCHES
bool tile_touches(Particle p, vec2 middle, float reach) { return segment_touches(p.center, p.h, p.radius, middle, reach); }

Proxy tile_proxy(Particle p) { return united(tile_ball(p.center - p.h, p.radius), tile_ball(p.center + p.h, p.radius)); }

// Rays start where they meet the plane of the center's depth, so that everything is as small as the particle: with m the
// direction to the center with z = 1, that point lies at f = z (x - m.x, y - m.y, 0) from it. Where the endless cylinder is
// entered beyond an end, the ball there is met instead.
struct TileTest { vec4 a, b, c; }; // (m, z, -), (axis, half length), (radius^2, -, -, -)

TileTest tile_test(Particle p, bool alive) {
  Axis axis = axis_of(p.h);
  vec2 m = orthographic ? p.center.xy : p.center.xy / p.center.z;
  return TileTest(vec4(m, p.center.z, 0.0), vec4(axis.u, axis.half_length), vec4(alive ? p.radius * p.radius : -1e30, 0.0, 0.0, 0.0));
}

bool tile_nearer(TileTest s, float x, float y, inout float key) {
  float k = orthographic ? 1.0 : s.a.z, dx = orthographic ? 0.0 : x, dy = orthographic ? 0.0 : y;
  float fx = k * (x - s.a.x), fy = k * (y - s.a.y);
  float d_d = 1.0 + dx * dx + dy * dy, f_d = fx * dx + fy * dy;
  float fz = fx * s.b.x + fy * s.b.y, dz = dx * s.b.x + dy * s.b.y + s.b.z;
  vec3 dxu = vec3(dy * s.b.z - s.b.y, s.b.x - dx * s.b.z, dx * s.b.y - dy * s.b.x);
  float a = max(dot(dxu, dxu), 1e-14), across = fx * dxu.x + fy * dxu.y;
  float q = s.c.x * a - across * across;
  float side = (fz * dz - f_d - sqrt(max(q, 0.0))) / a;
  float z = fz + side * dz, end = clamp(z, -s.b.w, s.b.w);
  float gx = fx - end * s.b.x, gy = fy - end * s.b.y, gz = -end * s.b.z;
  float g_d = gx * dx + gy * dy + gz, ball = g_d * g_d - d_d * (gx * gx + gy * gy + gz * gz - s.c.x);
  bool within = z == end;
  float entry = (s.a.z + (within ? side : (-g_d - sqrt(max(ball, 0.0))) / d_d)) * d_d;
  bool nearer = q >= 0.0 && (within || ball >= 0.0) && entry < key;
  key = nearer ? entry : key;
  return nearer;
}

vec3 normal_at(Ray ray, Particle p, float t) { return capsule_normal(own_point(ray, p.center, t), p.h, p.radius); }
#endif
