// SPDX-License-Identifier: MIT
// Particle type `arrow`: a cylinder (shaft) and a cone (head) on one axis, as one solid with one nearest hit. Record: (center
// relative to the chunk, radius of the bounding ball), (h, shaft radius), (head radius, head length, -, -); the tail is at center - h,
// the tip at center + h. Formulas: method book, sections 3.3 and 4.2. The solid is not convex: its interval runs from the
// first entry to the last exit.
#include "particles/axial.glsl"
#include "particles/touches.glsl"

#define CASTER_VEC4S 3
const int record_vec4s = 3;
#ifdef NEAR_EYE
const int payload_vec4s = 4;
#else
const int payload_vec4s = 3;
#endif

struct Particle {
  vec3 center; // view space
  float bound;
  vec3 h;      // own space, as all that follows
  float shaft, head, head_length;
  vec3 rest, h_rest; // what rounding took from center and h; 0 but for NEAR_EYE
};

Particle shaped(vec3 center, float bound, vec3 rest, vec3 h_rest, vec4 first, vec4 second) {
  return Particle(center, bound, first.xyz, first.w, second.x, second.y, rest, h_rest);
}
#ifdef NEAR_EYE
Particle place_near(vec4 record[record_vec4s], Placement at, vec4 near[4]) {
  return shaped(near[0].xyz, near[0].w, near[1].xyz, near[2].yzw, near[3],
                vec4(scaled(at, record[2].x), scaled(at, record[2].y), 0.0, 0.0));
}
Particle unpack(vec4 payload[payload_vec4s]) {
  return shaped(payload[0].xyz, payload[0].w, payload[3].xyz, vec3(payload[2].zw, payload[3].w), payload[1], payload[2]);
}
#else
Particle place(vec4 record[record_vec4s], Placement at) {
  return shaped(placed_center(at, record[0].xyz), scaled(at, record[0].w), vec3(0.0), vec3(0.0), vec4(turned(at, record[1].xyz), scaled(at, record[1].w)),
                vec4(scaled(at, record[2].x), scaled(at, record[2].y), 0.0, 0.0));
}
Particle unpack(vec4 payload[payload_vec4s]) { return shaped(payload[0].xyz, payload[0].w, vec3(0.0), vec3(0.0), payload[1], payload[2]); }
#endif
void pack(Particle p, out vec4 payload[payload_vec4s]) {
  payload[0] = vec4(p.center, p.bound);
  payload[1] = vec4(p.h, p.shaft);
  payload[2] = vec4(p.head, p.head_length, p.h_rest.xy);
#ifdef NEAR_EYE
  payload[3] = vec4(p.rest, p.h_rest.z);
#endif
}

bool drawable(Particle p) { return max(p.shaft, p.head) > 0.0 && length(p.h) > 0.0; }

float base_of(Particle p, Axis axis) { return axis.half_length - p.head_length; } // z of the head's base
float slope_of(Particle p) { return p.head_length > 0.0 ? -p.head / p.head_length : 0.0; }

Proxy proxy(Particle p) {
  Axis axis = axis_of(p.h);
  vec3 h = from_own(p.h), base = p.center + from_own(base_of(p, axis) * axis.u);
  float z_min = p.center.z - abs(h.z) - ball_depth(max(p.shaft, p.head));
  Proxy parts = united(united(disc_proxy(p.center - h, axis.u, p.shaft), disc_proxy(base, axis.u, max(p.shaft, p.head))), disc_proxy(p.center + h, axis.u, 0.0));
  return hull_proxy(parts, z_min, p.center, p.bound);
}

#ifdef NEAR_EYE
float settled(Ray ray, Particle p, bool head, bool disc, bool tail, float t) {
  vec2 shaft = vec2(p.shaft, 0.0), low = divided(times(vec2(2.0 * p.head, 0.0), length_in_pairs(p.h, p.h_rest)), vec2(max(p.head_length, 1e-30), 0.0));
  return disc ? onto_disc(ray, p.center, p.rest, p.h, p.h_rest, tail ? -1.0 : 1.0, tail ? 0.0 : p.head_length, t)
              : onto_side(ray, p.center, p.rest, p.h, p.h_rest, head ? low : shaft, head ? vec2(0.0) : shaft, t);
}
#endif

bool intersect(Ray ray, Particle p, out Interval hit) {
  OwnRay own = own_ray(ray, p.center, p.rest);
  Axis axis = axis_of(p.h);
  AxialRay r = axial(own, axis);
  float base = base_of(p, axis);
  FrustumStretch shaft = inside_frustum(r, axis.u, p.shaft, 0.0, 0.0, -axis.half_length, base);
  FrustumStretch head = inside_frustum(r, axis.u, p.head, slope_of(p), base, base, axis.half_length);
  bool on_shaft = shaft.s.x <= shaft.s.y, on_head = head.s.x <= head.s.y;
  bool in_head = on_head && (!on_shaft || head.s.x <= shaft.s.x), out_head = on_head && (!on_shaft || head.s.y >= shaft.s.y);
  vec2 s = vec2(in_head ? head.s.x : shaft.s.x, out_head ? head.s.y : shaft.s.y);
  bool met = on_shaft || on_head;
  hit = interval_of(own, met ? s : vec2(0.0), in_head ? head.first : shaft.first, out_head ? head.last : shaft.last, vec2(0.0));
#ifdef NEAR_EYE
  bool ahead = r.dz > 0.0; // discs are the tail's and the head's base
  hit.t_in = met ? settled(ray, p, in_head, in_head ? head.disc.x : shaft.disc.x, !in_head && ahead, hit.t_in) : hit.t_in;
  hit.t_out = met ? settled(ray, p, out_head, out_head ? head.disc.y : shaft.disc.y, !out_head && !ahead, hit.t_out) : hit.t_out;
#endif
  return met;
}
vec3 outward_normal(Ray ray, Particle p, Interval hit, bool exit) { return normal_from_own(exit ? hit.ends.xyz : hit.local.xyz); }

bool passes_thin(Ray ray, Particle p, Interval hit, float radius) {
  OwnRay own = own_ray(ray, p.center, p.rest);
  Axis axis = axis_of(p.h);
  return max(p.shaft, p.head) < radius && distance_to_axis(own, axial(own, axis), axis.u, -axis.half_length, axis.half_length) < radius;
}
Outline outline(Ray ray, Particle p, Interval hit) { Interval again; return sampled_outline(intersect(ray, p, again)); }

#ifdef TILES
#define TILE_TOUCHES
bool tile_touches(Particle p, vec2 middle, float reach) { return segment_touches(p.center, p.h, max(p.shaft, p.head), middle, reach); }

Proxy tile_proxy(Particle p) {
  Axis axis = axis_of(p.h);
  return united(united(disc_proxy(p.center - p.h, axis.u, p.shaft), disc_proxy(p.center + base_of(p, axis) * axis.u, axis.u, max(p.shaft, p.head))),
                disc_proxy(p.center + p.h, axis.u, 0.0));
}

// Rays start in the plane of the center's depth, as those of the capsule do.
struct TileTest { vec4 a, b, c; }; // (m, z, alive), (axis, half length), (shaft, head, base, head's slope)

TileTest tile_test(Particle p, bool alive) {
  Axis axis = axis_of(p.h);
  vec2 m = orthographic ? p.center.xy : p.center.xy / p.center.z;
  return TileTest(vec4(m, p.center.z, alive ? 1.0 : 0.0), vec4(axis.u, axis.half_length), vec4(p.shaft, p.head, base_of(p, axis), slope_of(p)));
}

bool tile_nearer(TileTest s, float x, float y, inout float key) {
  TileRay r = tile_ray((orthographic ? 1.0 : s.a.z) * (vec2(x, y) - s.a.xy), orthographic ? vec2(0.0) : vec2(x, y), s.b.xyz);
  vec2 shaft = both(tile_round(r, s.c.x, 0.0, 0.0), tile_between(r, -s.b.w, s.c.z));
  vec2 head = both(tile_round(r, s.c.y, s.c.w, s.c.z), tile_between(r, s.c.z, s.b.w));
  float entry = min(shaft.x <= shaft.y ? shaft.x : beyond, head.x <= head.y ? head.x : beyond);
  float depth = (s.a.z + entry) * r.d_d;
  bool nearer = entry < beyond && s.a.w > 0.0 && depth < key;
  key = nearer ? depth : key;
  return nearer;
}

vec3 normal_at(Ray ray, Particle p, float t) {
  Axis axis = axis_of(p.h);
  vec3 q = own_point(ray, p.center, t);
  float base = base_of(p, axis);
  vec4 shaft = nearest_face(q, axis.u, p.shaft, 0.0, 0.0, -axis.half_length, base), head = nearest_face(q, axis.u, p.head, slope_of(p), base, base, axis.half_length);
  return normal_from_own(shaft.w < head.w ? shaft.xyz : head.xyz);
}
#endif
