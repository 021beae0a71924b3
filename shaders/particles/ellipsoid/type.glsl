// SPDX-License-Identifier: MIT
// Particle type `ellipsoid`: record of oriented.glsl with the semi-axes. Formulas: method book, sections 3.5 (shift in own
// space, then rotate and scale, then shift again where it is the unit sphere) and 4.1 (bounds of affine balls).
const int record_vec4s = 3;
#define FINE_AXES
#include "particles/oriented.glsl"

bool drawable(Particle p) { return least(p.size) > 0.0; }

mat3 half_axes(Particle p) {
  mat3 axes = axes_of(p);
  return mat3(axes[0] * p.size.x, axes[1] * p.size.y, axes[2] * p.size.z);
}
Proxy proxy(Particle p) { return affine_proxy(p.center, half_axes(p)); }

bool intersect(Ray ray, Particle p, out Interval hit) {
  UnitRay u = unit_ray(ray, p);
  float distance = length(u.l), d2 = (1.0 - distance) * (1.0 + distance);
  float h = sqrt(max(d2, 0.0) / dot(u.d, u.d));
  hit = Interval(u.depth.x + (u.depth.y - h), u.depth.x + (u.depth.y + h), vec4(u.l, h), vec4(0.0));
  return d2 >= 0.0;
}

// From the local hit point.
vec3 outward_normal(Ray ray, Particle p, Interval hit, bool exit) {
  FineAxes fine = fine_axes(p.x, p.y, p.turn);
  vec3 d = in_axes(to_own(ray.direction), vec3(0.0), fine) / p.size;
  vec3 gradient = hit.local.xyz + (exit ? hit.local.w : -hit.local.w) * d;
  return normal_from_own((fine.high + fine.low) * (gradient * (least(p.size) / p.size)));
}

// To first order: with q = |x / size| the surface is (q - 1) / |grad q| away, which is never more than the true distance, since q is convex.
bool passes_thin(Ray ray, Particle p, Interval hit, float radius) {
  float q = length(hit.local.xyz);
  return least(p.size) < radius && (q - 1.0) * q < radius * length(hit.local.xyz / p.size);
}
Outline outline(Ray ray, Particle p, Interval hit) { Interval again; return sampled_outline(intersect(ray, p, again)); }

#ifdef AFFINE
#include "particles/affine_caster.glsl"
void pack_caster(Particle p, out vec4 caster[CASTER_VEC4S]) {
  mat3 axes = half_axes(p);
  pack_sheared_ellipsoid(p.center, mat3(from_own(axes[0]), from_own(axes[1]), from_own(axes[2])), caster);
}
#endif

#ifdef TILES
Proxy tile_proxy(Particle p) { return proxy(p); }

// With M = 1 / size * axes^T (to where it is the unit sphere), c the center and the ray d = m + u, m the direction to the center with
// z = 1: A = |M d|^2 is a polynomial in u, M d . M c = z (its constant part + half its linear part), and the discriminant
// A - |M u x M c|^2 cancels nothing but at the outline. Orthographic: the ray starts at u in the plane of the center's depth, A = |M z|^2.
struct TileTest { vec4 a, b, c; }; // (m, z, A's constant), (A: u.x, u.y, u.x^2, u.x u.y), (A: u.y^2; |M u x M c|^2: u.x^2, u.x u.y, u.y^2)

TileTest tile_test(Particle p, bool alive) {
  mat3 axes = transpose(axes_of(p));
  vec3 x = axes[0] / p.size, y = axes[1] / p.size, z = axes[2] / p.size; // columns of M
  vec2 m = orthographic ? p.center.xy : p.center.xy / p.center.z;
  vec3 to_center = orthographic ? z : m.x * x + m.y * y + z;
  float k = orthographic ? 1.0 : p.center.z;
  vec3 xc = k * cross(x, to_center), yc = k * cross(y, to_center);
  float constant = alive ? dot(to_center, to_center) : -1e30;
  return TileTest(vec4(m, p.center.z, constant), vec4(2.0 * dot(x, to_center), 2.0 * dot(y, to_center), dot(x, x), 2.0 * dot(x, y)),
                  vec4(dot(y, y), dot(xc, xc), 2.0 * dot(xc, yc), dot(yc, yc)));
}

bool tile_nearer(TileTest s, float x, float y, inout float key) {
  float ux = x - s.a.x, uy = y - s.a.y;
  float off = ux * (ux * s.c.y + uy * s.c.z) + uy * uy * s.c.w;
  float linear = ux * s.b.x + uy * s.b.y;
  float A = orthographic ? s.a.w : s.a.w + linear + (ux * (ux * s.b.z + uy * s.b.w) + uy * uy * s.c.x);
  float q = A - off, root = sqrt(max(q, 0.0));
  float b = orthographic ? -0.5 * linear : s.a.z * (s.a.w + 0.5 * linear);
  float t = orthographic ? s.a.z + (b - root) / A : (b - root) / A;
  float entry = orthographic ? t : t * (1.0 + x * x + y * y);
  bool nearer = q >= 0.0 && A > 0.0 && entry < key;
  key = nearer ? entry : key;
  return nearer;
}

vec3 normal_at(Ray ray, Particle p, float t) { return normal_from_unit((own_point(ray, p.center, t) * axes_of(p)) / p.size, p); }
#endif
