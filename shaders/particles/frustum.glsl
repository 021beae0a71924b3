// SPDX-License-Identifier: MIT
// Types `cylinder` and `cone`: a round body between two discs around an axis. Record: (center relative to the chunk, radius of the
// bounding ball), (h, radius at center - h), (radius at center + h, ends, -, -); the axis runs from center - h to center + h. ends 1:
// the side alone, a surface with two faces. Formulas: method book, sections 3.2 (intersection) and 4.2 (bounds).
// The including type.glsl says MAY_BE_OPEN.
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
  float radius, radius_end;
  bool open;
  vec3 rest, h_rest; // what rounding took from center and h; 0 but for NEAR_EYE
};

Particle shaped(vec3 center, float bound, vec3 rest, vec3 h_rest, vec4 first, vec4 second) {
  return Particle(center, bound, first.xyz, first.w, second.x, MAY_BE_OPEN && second.y == 1.0, rest, h_rest);
}
#ifdef NEAR_EYE
Particle place_near(vec4 record[record_vec4s], Placement at, vec4 near[4]) {
  return shaped(near[0].xyz, near[0].w, near[1].xyz, near[2].yzw, near[3], vec4(scaled(at, record[2].x), record[2].yzw));
}
Particle unpack(vec4 payload[payload_vec4s]) {
  return shaped(payload[0].xyz, payload[0].w, payload[3].xyz, vec3(payload[2].zw, payload[3].w), payload[1], payload[2]);
}
#else
Particle place(vec4 record[record_vec4s], Placement at) {
  return shaped(placed_center(at, record[0].xyz), scaled(at, record[0].w), vec3(0.0), vec3(0.0), vec4(turned(at, record[1].xyz), scaled(at, record[1].w)),
                vec4(scaled(at, record[2].x), record[2].yzw));
}
Particle unpack(vec4 payload[payload_vec4s]) { return shaped(payload[0].xyz, payload[0].w, vec3(0.0), vec3(0.0), payload[1], payload[2]); }
#endif
void pack(Particle p, out vec4 payload[payload_vec4s]) {
  payload[0] = vec4(p.center, p.bound);
  payload[1] = vec4(p.h, p.radius);
  payload[2] = vec4(p.radius_end, p.open ? 1.0 : 0.0, p.h_rest.xy);
#ifdef NEAR_EYE
  payload[3] = vec4(p.rest, p.h_rest.z);
#endif
}

bool drawable(Particle p) { return max(p.radius, p.radius_end) > 0.0 && length(p.h) > 0.0; }

Proxy proxy(Particle p) {
  vec3 h = from_own(p.h), u = axis_of(p.h).u;
  float z_min = p.center.z - abs(h.z) - ball_depth(max(p.radius, p.radius_end));
  return hull_proxy(united(disc_proxy(p.center - h, u, p.radius), disc_proxy(p.center + h, u, p.radius_end)), z_min, p.center, p.bound);
}

float middle_radius(Particle p) { return 0.5 * (p.radius + p.radius_end); }
float slope_of(Particle p, Axis axis) { return (p.radius_end - p.radius) / (2.0 * axis.half_length); }

#ifdef NEAR_EYE
float settled(Ray ray, Particle p, bool disc, float z, float t) {
  return disc ? onto_disc(ray, p.center, p.rest, p.h, p.h_rest, z, 0.0, t)
              : onto_side(ray, p.center, p.rest, p.h, p.h_rest, vec2(p.radius, 0.0), vec2(p.radius_end, 0.0), t);
}
#endif

bool intersect(Ray ray, Particle p, out Interval hit) {
  OwnRay own = own_ray(ray, p.center, p.rest);
  Axis axis = axis_of(p.h);
  FrustumStretch in_ = inside_frustum(axial(own, axis), axis.u, middle_radius(p), slope_of(p, axis), 0.0, -axis.half_length, axis.half_length);
  if (MAY_BE_OPEN && p.open) { // of the side's two points, those between the ends
    bool met = in_.s.x <= in_.s.y, first = met && !in_.disc.x, last = met && !in_.disc.y;
    vec2 s = vec2(first ? in_.s.x : in_.s.y, last ? in_.s.y : in_.s.x);
    vec3 n_in = first ? in_.first : in_.last, n_out = last ? in_.last : in_.first; // both faces: turned to the ray
    in_.s = first || last ? s : vec2(beyond, -beyond);
    in_.first = dot(n_in, own.d) > 0.0 ? -n_in : n_in;
    in_.last = dot(n_out, own.d) < 0.0 ? -n_out : n_out;
  }
  bool met = in_.s.x <= in_.s.y;
  hit = interval_of(own, met ? in_.s : vec2(0.0), in_.first, in_.last, vec2(0.0));
#ifdef NEAR_EYE
  float ahead = dot(own.d, p.h) > 0.0 ? 1.0 : -1.0;
  bool open = MAY_BE_OPEN && p.open;
  hit.t_in = met ? settled(ray, p, in_.disc.x && !open, -ahead, hit.t_in) : hit.t_in;
  hit.t_out = met ? settled(ray, p, in_.disc.y && !open, ahead, hit.t_out) : hit.t_out;
#endif
  return met;
}
vec3 outward_normal(Ray ray, Particle p, Interval hit, bool exit) { return normal_from_own(exit ? hit.ends.xyz : hit.local.xyz); }

bool passes_thin(Ray ray, Particle p, Interval hit, float radius) {
  OwnRay own = own_ray(ray, p.center, p.rest);
  Axis axis = axis_of(p.h);
  return max(p.radius, p.radius_end) < radius && distance_to_axis(own, axial(own, axis), axis.u, -axis.half_length, axis.half_length) < radius;
}
Outline outline(Ray ray, Particle p, Interval hit) { Interval again; return sampled_outline(intersect(ray, p, again)); }

#ifdef TILES
#define TILE_TOUCHES
bool tile_touches(Particle p, vec2 middle, float reach) { return segment_touches(p.center, p.h, max(p.radius, p.radius_end), middle, reach); }

Proxy tile_proxy(Particle p) {
  vec3 u = axis_of(p.h).u;
  return united(disc_proxy(p.center - p.h, u, p.radius), disc_proxy(p.center + p.h, u, p.radius_end));
}

// Rays start in the plane of the center's depth, as those of the capsule do.
struct TileTest { vec4 a, b, c; }; // (m, z, slope), (axis, half length), (radius in the middle, open, alive, -)

TileTest tile_test(Particle p, bool alive) {
  Axis axis = axis_of(p.h);
  vec2 m = orthographic ? p.center.xy : p.center.xy / p.center.z;
  float slope = abs(p.radius_end - p.radius) > 2e-6 * p.radius ? slope_of(p, axis) : 0.0; // radii that are all but equal
  return TileTest(vec4(m, p.center.z, slope), vec4(axis.u, axis.half_length), vec4(middle_radius(p), p.open ? 1.0 : 0.0, alive ? 1.0 : 0.0, 0.0));
}

bool tile_nearer(TileTest s, float x, float y, inout float key) {
  vec2 d = orthographic ? vec2(0.0) : vec2(x, y);
  TileRay r = tile_ray((orthographic ? 1.0 : s.a.z) * (vec2(x, y) - s.a.xy), d, s.b.xyz);
  vec2 side = tile_round(r, s.c.x, s.a.w, 0.0), slab = tile_between(r, -s.b.w, s.b.w), both_ = both(side, slab);
  bool met = both_.x <= both_.y && s.c.z > 0.0;
  float entry = both_.x;
  if (MAY_BE_OPEN) {
    bool first = side.x >= slab.x, last = side.y <= slab.y;
    met = met && (s.c.y == 0.0 || first || last);
    entry = s.c.y == 0.0 || first ? entry : side.y;
  }
  entry = (s.a.z + entry) * r.d_d;
  bool nearer = met && entry < key;
  key = nearer ? entry : key;
  return nearer;
}

vec3 normal_at(Ray ray, Particle p, float t) {
  Axis axis = axis_of(p.h);
  float half_length = p.open ? beyond : axis.half_length;
  vec3 n = nearest_face(own_point(ray, p.center, t), axis.u, middle_radius(p), slope_of(p, axis), 0.0, -half_length, half_length).xyz;
  return normal_from_own(p.open && dot(n, to_own(ray.direction)) > 0.0 ? -n : n);
}
#endif
