// SPDX-License-Identifier: MIT
// Particle type `polyline`: one segment of a chain of capsules. Record: (center relative to the chunk, radius of the bounding ball),
// (h, radius), (n, 0) of the plane at center - h, (n, 0) of the one at center + h: where a neighbor goes on, the segment ends at the
// plane that halves the angle with it, so that a chain's segments share its inside without overlap. A zero vector: the chain
// ends there, with the capsule's ball. What a plane cuts off is the neighbor's; the cut is an inner end, no surface (interface.glsl).
// A neighbor with which no plane shares the inside (too short, of another radius) stands in the plane's place as its (h, radius > 0): an
// opaque segment overlaps with it, of a transparent one each ray shows what that neighbor leaves. Formulas: those of the capsule.
#include "particles/axial.glsl"

#define CASTER_VEC4S 4
#define HAS_INNER_ENDS
const int record_vec4s = 4;
#ifdef NEAR_EYE
const int payload_vec4s = 6;
#else
const int payload_vec4s = 4;
#endif

struct Particle {
  vec3 center; // view space
  float bound;
  vec3 h;      // own space, as all that follows
  float radius;
  vec4 low, high;    // (unit normals of the planes at -h and h, along the chain; or 0; 0); ORDERED: or (h, radius) of the neighbor there
  vec3 rest, h_rest; // what rounding took from center and h; 0 but for NEAR_EYE
};

vec3 unit_or_zero(vec3 v) { return dot(v, v) > 0.0 ? normalize(v) : vec3(0.0); }

vec4 joint(vec4 stored, Placement at) {
#ifdef ORDERED
  vec4 neighbor = vec4(turned(at, stored.xyz), scaled(at, stored.w));
#else
  vec4 neighbor = vec4(0.0);
#endif
  return stored.w > 0.0 ? neighbor : vec4(unit_or_zero(turned(at, stored.xyz)), 0.0);
}

Particle shaped(vec4 record[record_vec4s], Placement at, vec4 ball, vec4 first, vec3 rest, vec3 h_rest) {
  return Particle(ball.xyz, ball.w, first.xyz, first.w, joint(record[2], at), joint(record[3], at), rest, h_rest);
}
#ifdef NEAR_EYE
Particle place_near(vec4 record[record_vec4s], Placement at, vec4 near[4]) { return shaped(record, at, near[0], near[3], near[1].xyz, near[2].yzw); }
#else
Particle place(vec4 record[record_vec4s], Placement at) {
  return shaped(record, at, vec4(placed_center(at, record[0].xyz), scaled(at, record[0].w)), vec4(turned(at, record[1].xyz), scaled(at, record[1].w)), vec3(0.0), vec3(0.0));
}
#endif
Particle unpack(vec4 payload[payload_vec4s]) {
  vec3 rest = vec3(0.0), h_rest = vec3(0.0);
#ifdef NEAR_EYE
  rest = payload[4].xyz;
  h_rest = payload[5].xyz;
#endif
  return Particle(payload[0].xyz, payload[0].w, payload[1].xyz, payload[1].w, payload[2], payload[3], rest, h_rest);
}
void pack(Particle p, out vec4 payload[payload_vec4s]) {
  payload[0] = vec4(p.center, p.bound);
  payload[1] = vec4(p.h, p.radius);
  payload[2] = p.low;
  payload[3] = p.high;
#ifdef NEAR_EYE
  payload[4] = vec4(p.rest, 0.0);
  payload[5] = vec4(p.h_rest, 0.0);
#endif
}

bool drawable(Particle p) { return p.radius > 0.0; }

Proxy proxy(Particle p) {
  vec3 h = from_own(p.h);
  float z_min = p.center.z - abs(h.z) - ball_depth(p.radius);
  return hull_proxy(united(ball_proxy(p.center - h, p.radius), ball_proxy(p.center + h, p.radius)), z_min, p.center, p.bound);
}

// The two sides of a joint lie on each other by this part of the radius: no ray passes between them.
const float lap = 1e-5;

// Keeps what lies before the plane through `at`: the interval's ends, and whether they are inner ones now.
void cut_by(vec3 f, vec3 d, vec3 at, vec3 n, float radius, inout vec2 s, inout vec2 inner) {
  float g = dot(f - at, n), slope = dot(d, n), along = -g / (slope != 0.0 ? slope : 1e-30);
  bool first = g + s.x * slope > lap * radius, last = g + s.y * slope > lap * radius;
  bool gone = first && last;
  inner = vec2(first ? 1.0 : inner.x, last ? 1.0 : inner.y);
  s = gone ? vec2(beyond, -beyond) : vec2(first ? along : s.x, last ? along : s.y);
}

void cut_by_planes(OwnRay own, Particle p, vec3 low, vec3 high, inout vec2 s, inout vec2 inner) {
  if (s.x <= s.y) cut_by(own.f, own.d, p.h, high, p.radius, s, inner);
  if (s.x <= s.y) cut_by(own.f, own.d, -p.h, -low, p.radius, s, inner);
}

#ifdef ORDERED
// Within the capsule (h, radius) around a center, all in own space.
Stretch inside_other(OwnRay own, vec3 center, vec4 h_radius) {
  vec3 f, f_rest, l, l_rest;
  vec2 moved;
  two_sum(own.f, -center, f, f_rest);
  shift_in_pairs(f, f_rest + own.rest, own.d, l, l_rest, moved);
  OwnRay there = OwnRay(l, own.d, vec2(0.0), l_rest);
  Axis axis = axis_of(h_radius.xyz);
  Stretch found = inside_capsule(there, axial(there, axis), axis, h_radius.xyz, h_radius.w);
  found.s += moved.x + moved.y;
  return found;
}

// What a ray has within both this segment (from whole.x to whole.y) and a neighbor (n) belongs to the one that it enters first, so that each
// keeps one stretch and every end within the other is an inner one. Ends nearer than `tie` are one: the earlier segment of the chain has it.
void leave_to(vec2 n, vec2 whole, float tie, bool earlier, inout vec2 s, inout vec2 inner) {
  float e = earlier ? tie : -tie;
  bool overlap = n.x <= n.y && n.x < whole.y && n.y > whole.x;
  bool first = overlap && n.x < whole.x - e, last = overlap && n.y > whole.y + e, moved = first && n.y > s.x;
  inner = vec2(moved ? 1.0 : inner.x, last ? 1.0 : inner.y);
  s = first && last ? vec2(beyond, -beyond) : vec2(moved ? min(n.y, s.y) : s.x, s.y);
}

// A loop whose first turn is the segment's own: most have no neighbor to look at.
Stretch stretch_of(OwnRay own, Particle p, out vec2 s, out vec2 inner) {
  int turn = 0, turns = 1 + (p.low.w > 0.0 ? 1 : 0) + (p.high.w > 0.0 ? 1 : 0);
  Stretch in_;
  inner = vec2(0.0);
  do {
    bool mine = turn == 0, behind = turn == 1 && p.low.w > 0.0;
    vec4 other = behind ? p.low : p.high;
    vec3 center = behind ? -(p.h + other.xyz) : p.h + other.xyz;
    Stretch found = inside_other(own, mine ? vec3(0.0) : center, mine ? vec4(p.h, p.radius) : other);
    if (mine) {
      in_ = found;
      s = found.s;
      cut_by_planes(own, p, p.low.w > 0.0 ? vec3(0.0) : p.low.xyz, p.high.w > 0.0 ? vec3(0.0) : p.high.xyz, s, inner);
    } else {
      float tie = lap * (p.radius + length(p.h) + other.w + length(other.xyz)) / length(own.d);
      leave_to(found.s, in_.s, tie, !behind, s, inner);
    }
    ++turn;
  } while (turn < turns);
  return in_;
}
#else
Stretch stretch_of(OwnRay own, Particle p, out vec2 s, out vec2 inner) {
  Axis axis = axis_of(p.h);
  Stretch in_ = inside_capsule(own, axial(own, axis), axis, p.h, p.radius);
  s = in_.s;
  inner = vec2(0.0);
  cut_by_planes(own, p, p.low.xyz, p.high.xyz, s, inner);
  return in_;
}
#endif

bool intersect(Ray ray, Particle p, out Interval hit) {
  OwnRay own = own_ray(ray, p.center, p.rest);
  vec2 s, inner;
  Stretch in_ = stretch_of(own, p, s, inner);
  vec2 whole = in_.s;
  bool met = s.x <= s.y;
  hit = interval_of(own, met ? s : whole.x <= whole.y ? vec2(whole.x) : vec2(0.0), in_.first, in_.last, inner);
#ifdef NEAR_EYE
  hit.t_in = met && inner.x == 0.0 ? onto_capsule(ray, p.center, p.rest, p.h, p.h_rest, p.radius, hit.t_in) : hit.t_in;
  hit.t_out = met && inner.y == 0.0 ? onto_capsule(ray, p.center, p.rest, p.h, p.h_rest, p.radius, hit.t_out) : hit.t_out;
#endif
  return met;
}
bool inner_end(Interval hit, bool exit) { return (exit ? hit.ends.w : hit.local.w) > 0.0; }
vec3 outward_normal(Ray ray, Particle p, Interval hit, bool exit) { return normal_from_own(exit ? hit.ends.xyz : hit.local.xyz); }


bool passes_thin(Ray ray, Particle p, Interval hit, float radius) {
  OwnRay own = own_ray(ray, p.center, p.rest);
  Axis axis = axis_of(p.h);
  return p.radius < radius && distance_to_axis(own, axial(own, axis), axis.u, -axis.half_length, axis.half_length) < radius;
}
Outline outline(Ray ray, Particle p, Interval hit) { Interval again; return sampled_outline(intersect(ray, p, again)); }

#ifdef TILES
Proxy tile_proxy(Particle p) { return united(tile_ball(p.center - p.h, p.radius), tile_ball(p.center + p.h, p.radius)); }

// Unit vectors on an octahedron (Cigolle et al., JCGT 3(2), 2014); zero as 9.
vec2 folded(vec3 n) {
  vec2 p = n.xy / max(abs(n.x) + abs(n.y) + abs(n.z), 1e-30);
  vec2 sign_ = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  return dot(n, n) > 0.0 ? (n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * sign_) : vec2(9.0);
}
vec3 unfolded(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  vec2 sign_ = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * sign_;
  return p.x > 2.0 ? vec3(0.0) : normalize(n);
}

// Rays start in the plane of the center's depth, as those of the capsule do; the axis is h itself, so that 12 floats hold it all.
struct TileTest { vec4 a, b, c; }; // (m, z, radius: negative where no ray meets it), (h, -), (planes at -h and h)

TileTest tile_test(Particle p, bool alive) {
  vec2 m = orthographic ? p.center.xy : p.center.xy / p.center.z;
  return TileTest(vec4(m, p.center.z, alive ? p.radius : -1.0), vec4(p.h, 0.0), vec4(folded(p.low.xyz), folded(p.high.xyz)));
}

bool tile_nearer(TileTest s, float x, float y, inout float key) {
  float k = orthographic ? 1.0 : s.a.z, radius = s.a.w;
  vec3 f = vec3(k * (x - s.a.x), k * (y - s.a.y), 0.0), d = vec3(orthographic ? vec2(0.0) : vec2(x, y), 1.0);
  float d_d = dot(d, d), f_d = dot(f, d);
  Axis axis = axis_of(s.b.xyz);
  TileRay r = tile_ray(f.xy, d.xy, axis.u);
  float a = max(r.dp2, 1e-14), q = radius * radius * a - r.across * r.across;
  float side = (r.fz * r.dz - f_d - sqrt(max(q, 0.0))) / a;
  float z = r.fz + side * r.dz, end = clamp(z, -axis.half_length, axis.half_length);
  vec3 g = f - end * axis.u;
  float g_d = dot(g, d), ball = g_d * g_d - d_d * (dot(g, g) - radius * radius);
  bool within = z == end;
  float t = within ? side : (-g_d - sqrt(max(ball, 0.0))) / d_d, entry = (s.a.z + t) * d_d;
  vec3 at = f + t * d; // behind a plane it is the neighbor's
  bool own = dot(at - s.b.xyz, unfolded(s.c.zw)) <= lap * radius && dot(at + s.b.xyz, unfolded(s.c.xy)) >= -lap * radius;
  bool nearer = radius > 0.0 && q >= 0.0 && (within || ball >= 0.0) && own && entry < key;
  key = nearer ? entry : key;
  return nearer;
}

vec3 normal_at(Ray ray, Particle p, float t) { return capsule_normal(own_point(ray, p.center, t), p.h, p.radius); }
#endif
