// SPDX-License-Identifier: MIT
// Particle types from files: what is between a user's type.glsl (functions.glsl) and the rest. Record: that of oriented.glsl with
// up to three lengths and two numbers.
const int record_vec4s = 4;
#define HANDED
#include "particles/oriented.glsl"
#include "particles/user/functions.glsl"

bool type_alarm = false; // with show_depth_violation: hit() gave NaN, and phases show that
#define HAS_ALARM

Shape shape_of(Particle p) { return shape_from(real3(p.size), real2(p.shape)); }

bool drawable(Particle p) { return p.bound > 0.0; }
Proxy proxy(Particle p) { return box_proxy(p, vec3(bound(shape_of(p))) * (1.0 + 1e-6)); }

// NaN is a miss.
bool intersect(Ray ray, Particle p, out Interval found) {
  OwnRay own = ray_of(ray, p);
  mat3 axes = axes_of(p);
  real t_in = real(0.0), t_out = real(0.0);
  bool met = hit(shape_of(p), real3(own.f * axes), real3(own.d * axes), t_in, t_out);
  vec2 s = vec2(t_in, t_out);
#ifndef SHADOW_RAY
  type_alarm = show_depth_violation && met && (isnan(s.x) || isnan(s.y));
#endif
  met = met && s.x <= s.y;
  found = interval_of(own, met ? s : vec2(0.0), vec2(0.0));
  return met || type_alarm;
}

vec3 outward_normal(Ray ray, Particle p, Interval at, bool exit) {
  mat3 axes = axes_of(p);
  return normal_from_own(axes * vec3(surface(shape_of(p), real3(interval_point(ray, at, exit) * axes))));
}

// Particles that are thin everywhere; parts that are thin may be lost between the texels of a shadow map.
bool passes_thin(Ray ray, Particle p, Interval at, float radius) { return p.bound < radius && length(ray_of(ray, p).f) < radius; }
Outline outline(Ray ray, Particle p, Interval at) { Interval again; return sampled_outline(intersect(ray, p, again)); }

#ifdef TILES
#define TILE_LOOP
Proxy tile_proxy(Particle p) { return proxy(p); }

// Rays start in the plane of the center's depth, as those of the superquadric do.
struct TileTest { vec4 a, b, c; }; // (m, z, number), (rotation, number), (lengths, hand: 0 where no ray meets it)

TileTest tile_test(Particle p, bool alive) {
  vec2 m = orthographic ? p.center.xy : p.center.xy / p.center.z;
  return TileTest(vec4(m, p.center.z, p.shape.x), vec4(rodrigues(mat3(p.x, p.y, cross(p.x, p.y))), p.shape.y), vec4(p.size, alive ? p.hand : 0.0));
}

bool tile_nearer(TileTest s, float x, float y, inout float key) {
  float k = orthographic ? 1.0 : s.a.z;
  mat3 axes = from_rodrigues(s.b.xyz);
  axes[2] *= s.c.w;
  vec3 f = vec3(k * (x - s.a.x), k * (y - s.a.y), 0.0) * axes, d = vec3(orthographic ? vec2(0.0) : vec2(x, y), 1.0) * axes;
  float shift = -dot(f, d) / max(dot(d, d), 1e-30);
  real t_in = real(0.0), t_out = real(0.0);
  bool met = hit(shape_from(real3(s.c.xyz), real2(s.a.w, s.b.w)), real3(f + shift * d), real3(d), t_in, t_out);
  bool alarm = show_depth_violation && met && (isnan(float(t_in)) || isnan(float(t_out)));
  float entry = (s.a.z + (alarm ? shift : shift + float(t_in))) * (orthographic ? 1.0 : 1.0 + x * x + y * y);
  bool nearer = s.c.w != 0.0 && ((met && t_in <= t_out) || alarm) && entry < key;
  key = nearer ? entry : key;
  return nearer;
}

vec3 normal_at(Ray ray, Particle p, float t) {
  mat3 axes = axes_of(p);
  return normal_from_own(axes * vec3(surface(shape_of(p), real3(own_point(ray, p.center, t) * axes))));
}
#endif
