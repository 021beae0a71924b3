// SPDX-License-Identifier: MIT
// Particle type `sphere`: record (center relative to its chunk, radius). Formulas: method book,
// sections 3.1 (intersection, form N) and 4.1 (bounds; for spheres Mara & McGuire, JCGT 2(2), 2013).
// With AFFINE the placement is no similarity and the sphere becomes an ellipsoid: affine.glsl.

#include "particles/bounds.glsl"

#ifndef AFFINE
#define CASTER_VEC4S 1
#endif
const int record_vec4s = 1;
#ifdef NEAR_EYE
const int payload_vec4s = 3;
#else
const int payload_vec4s = 1;
#endif

struct Particle {
  vec3 center; // view space
  float radius;
#ifdef NEAR_EYE
  vec3 rest;   // center - float32(center)
  vec2 power;  // |center|^2 - radius^2, formed in double, as a sum of two floats (AFFINE: where the ellipsoid is the unit sphere)
#endif
};

#ifdef NEAR_EYE
Particle place_near(vec4 record[record_vec4s], Placement at, vec4 near[4]) {
  return Particle(near[0].xyz, near[0].w, near[1].xyz, vec2(near[1].w, near[2].x));
}
Particle unpack(vec4 payload[payload_vec4s]) {
  return Particle(payload[0].xyz, payload[0].w, payload[1].xyz, vec2(payload[1].w, payload[2].x));
}
void pack(Particle p, out vec4 payload[payload_vec4s]) {
  payload[0] = vec4(p.center, p.radius);
  payload[1] = vec4(p.rest, p.power.x);
  payload[2] = vec4(p.power.y, 0.0, 0.0, 0.0);
}
#else
Particle place(vec4 record[record_vec4s], Placement at) {
  precise vec3 center = at.linear * record[0].xyz + at.origin;
#ifdef AFFINE
  return Particle(center, record[0].w);
#else
  return Particle(center, record[0].w * at.scale);
#endif
}
Particle unpack(vec4 payload[payload_vec4s]) { return Particle(payload[0].xyz, payload[0].w); }
void pack(Particle p, out vec4 payload[payload_vec4s]) { payload[0] = vec4(p.center, p.radius); }
#endif

bool drawable(Particle p) { return p.radius > 0.0; }
Proxy proxy(Particle p) { return ball_proxy(p.center, p.radius); }

#ifdef AFFINE
#include "affine.glsl"
#else

// The interval of the ray inside the sphere. Misses give false.
#ifdef NEAR_EYE
// Form P in numbers of twice the precision: the product of the roots is the power of the eye, which a difference of the
// roots' middle and half chord would lose where the surface is much nearer than the center; the other root is a sum of equal
// signs. Rays that graze a surface divide the rounding of everything here by the angle of incidence.
bool intersect(Ray ray, Particle p, out Interval hit) {
  if (orthographic) { // already at the point nearest to the center: no distance enters
    vec3 l = vec3((ray.origin.xy - p.center.xy) + (ray.rest.xy - p.rest.xy), 0.0);
    float distance = length(l);
    float d2 = (p.radius - distance) * (p.radius + distance);
    float h = sqrt(max(d2, 0.0));
    hit = Interval(p.center.z - h, p.center.z + h, vec4(l, h), vec4(0.0));
    return d2 >= 0.0;
  }
  vec2 d_d = dot_pair(ray.direction, ray.rest, ray.direction, ray.rest);
  vec2 b = dot_pair(p.center, p.rest, ray.direction, ray.rest);
  vec2 d2 = minus(times(b, b), times(d_d, p.power));
  float root = sqrt(max(d2.x, 0.0));
  float q = b.x + (b.x >= 0.0 ? root + b.y : b.y - root);
  float t1 = q / d_d.x, t2 = p.power.x / q;
  vec3 l = along_minus(divided(b, d_d), ray.direction, ray.rest, p.center, p.rest);
  hit = Interval(min(t1, t2), max(t1, t2), vec4(l, root / d_d.x), vec4(0.0));
  return d2.x >= 0.0;
}
#else
bool intersect(Ray ray, Particle p, out Interval hit) {
  vec3 l;
  vec2 middle; // a sum: its first part has few bits, so that only one rounding is as large as the distance's
  if (orthographic) { // already at the point nearest to the center: no distance enters
    l = vec3(ray.origin.xy - p.center.xy, 0.0);
    middle = vec2(p.center.z, 0.0);
  } else {
    shift_in_parts(ray.origin - p.center, ray.direction, l, middle);
  }
  float distance = length(l);
  float d2 = (p.radius - distance) * (p.radius + distance); // never r^2 - l^2: cancels at the limb
  float h = sqrt(max(d2, 0.0) * (1.0 / dot(ray.direction, ray.direction)));
  hit = Interval(middle.x + (middle.y - h), middle.x + (middle.y + h), vec4(l, h), vec4(0.0));
  return d2 >= 0.0;
}
#endif

// From the local hit point, never from hit - center, which would lose the ratio distance / radius.
vec3 outward_normal(Ray ray, Particle p, Interval hit, bool exit) {
  float h = exit ? hit.local.w : -hit.local.w;
  return (hit.local.xyz + h * ray.direction) * (1.0 / p.radius);
}

// Is the sphere thinner than `radius`, and does the ray pass it nearer than that? A miss has its interval at that place.
bool passes_thin(Ray ray, Particle p, Interval hit, float radius) { return p.radius < radius && length(hit.local.xyz) < radius; }

// Where the pixel of a ray lies to the sphere's outline on the image, in pixels (method book, section 8.4): to first
// order F / |grad F| of F = (d.m)^2 - (d.d)(|m|^2 - r^2), from what the hit has, without cancellation.
Outline outline(Ray ray, Particle p, Interval hit) {
  vec3 l = hit.local.xyz;
  float distance = length(l), d2 = (p.radius - distance) * (p.radius + distance), focal = frame.viewport.z;
  float middle = 0.5 * (hit.t_in + hit.t_out);
  vec2 outward = orthographic ? l.xy : middle * l.xy - d2 / dot(ray.direction, ray.direction) * ray.direction.xy;
  float slope = max(length(outward), 1e-30);
  Outline o;
  o.inside = orthographic ? focal * (p.radius - distance) : focal * d2 / (2.0 * slope);
  o.inward = -outward / slope;
  o.radius = focal * p.radius / (orthographic ? 1.0 : p.center.z);
  o.offset = orthographic ? focal * (p.center.xy - ray.origin.xy) : focal * (p.center.xy / p.center.z - ray.direction.xy);
  return o;
}
#endif

#ifdef TILES
// Casters of a shadow map that are thinner than a texel are widened to own the texels beside them, too.
float tile_radius(Particle p) {
  return proxy_slack > 0.0 ? max(p.radius, proxy_slack * frame.viewport.w * (orthographic ? 1.0 : p.center.z)) : p.radius;
}

Proxy tile_proxy(Particle p) { return tile_ball(p.center, tile_radius(p)); }

// Along the ray m + u, m the direction to the center with z = 1, everything is a polynomial in u and small where the
// ray is near the sphere: with A = |m|^2, r the radius and z the center's depth, the ray's d = |m + u|^2 t has the roots
//   b -+ sqrt(q),   b = z (A + m.u),   q = r^2 |m + u|^2 - z^2 (A u.u - (m.u)^2)
// (q is the quadratic's discriminant over 4; |d x c|^2 written without the term that cancels). Orthographic: m is the
// center, |ray| = 1, b = z, q = r^2 - u.u.
struct TileTest { vec4 a, b, c; };

// The outline runs at q = 0; what q can be at most so near to it as one may run through a ray's pixel: |grad q| <= 2 z r A there,
// and q falls faster outside, by at most z^2 A u.u. Orthographic: z = A = 1.
#ifdef ANALYTIC_EDGES
float tile_band; // in tangents: outline_reach
float outline_band(float r, float z, float A) { return A * z * tile_band * (2.0 * r + z * tile_band); }
#else
float outline_band(float r, float z, float A) { return 0.0; }
#endif

TileTest tile_test(Particle p, bool alive) {
  float z = p.center.z, r = tile_radius(p), r2 = r * r;
  if (orthographic) return TileTest(vec4(p.center.xy, alive ? r2 : -1e30, z), vec4(0.0, 0.0, -1.0, -1.0), vec4(0.0, 0.0, 0.0, outline_band(r, 1.0, 1.0)));
  vec2 m = p.center.xy / z;
  float A = 1.0 + dot(m, m), z2 = z * z;
  return TileTest(vec4(m, alive ? r2 * A : -1e30, z * A),
                  vec4(2.0 * r2 * m, r2 - z2 * (1.0 + m.y * m.y), r2 - z2 * (1.0 + m.x * m.x)),
                  vec4(2.0 * z2 * m.x * m.y, z * m, outline_band(r, z, A)));
}

vec3 normal_at(Ray ray, Particle p, float t) { return (t * ray.direction + (ray.origin - p.center)) * (1.0 / p.radius); }

// (q, b) of the pixel of a ray (x, y, 1).
vec2 tile_terms(TileTest s, float x, float y) {
  float ux = x - s.a.x, uy = y - s.a.y;
  return vec2((s.a.z + ux * (s.b.x + ux * s.b.z)) + uy * ((s.b.y + ux * s.c.x) + uy * s.b.w), (s.a.w + ux * s.c.y) + uy * s.c.z);
}

bool tile_nearer(TileTest s, float x, float y, inout float key) {
  vec2 t = tile_terms(s, x, y);
  float entry = t.y - sqrt(max(t.x, 0.0));
  bool nearer = t.x >= 0.0 && entry < key;
  key = nearer ? entry : key;
  return nearer;
}

#ifdef ANALYTIC_EDGES
Meeting tile_meets(TileTest s, float x, float y) {
  vec2 t = tile_terms(s, x, y);
  return Meeting(t.y - sqrt(max(t.x, 0.0)), t.x >= 0.0, abs(t.x) < s.c.w);
}

// As outline() below. Along its gradient the polynomial q is a quadratic again, whose nearer root is where the outline runs.
Outline tile_outline(Particle p, float x, float y, float focal) {
  Outline o;
  vec2 ray = vec2(x, y);
  if (orthographic) {
    vec2 u = ray - p.center.xy;
    float distance = length(u);
    return Outline(focal * (p.radius - distance), distance > 0.0 ? u / -distance : vec2(1.0, 0.0), focal * p.radius, -focal * u);
  }
  float z = p.center.z, r2 = p.radius * p.radius, z2 = z * z;
  vec2 m = p.center.xy / z, u = ray - m;
  float A = 1.0 + dot(m, m), m_u = dot(m, u);
  float q = r2 * (1.0 + dot(ray, ray)) - z2 * (A * dot(u, u) - m_u * m_u);
  vec2 slope = 2.0 * (r2 * ray - z2 * (A * u - m_u * m));
  float steep = length(slope);
  o.inward = steep > 0.0 ? slope / steep : vec2(1.0, 0.0);
  float m_n = dot(m, o.inward), bend = 2.0 * (r2 - z2 * (A - m_n * m_n));
  o.inside = focal * 2.0 * q / (steep + sqrt(max(steep * steep - 2.0 * bend * q, 1e-30)));
  o.radius = focal * p.radius / z;
  o.offset = -focal * u;
  return o;
}

float tile_entry(Particle p, float x, float y) {
  vec2 t = tile_terms(tile_test(p, true), x, y);
  return t.y - sqrt(max(t.x, 0.0));
}
#endif
#endif
#ifdef SHADOW_RAY
// As below in mask_ids.frag, with less: no distance of a shadow ray is large.
#define HAS_BLOCKS
#include "shadow/casters.glsl"
bool blocks(vec3 origin, vec3 direction, float t_max, Particle p) { return sphere_blocks(origin, direction, t_max, vec4(p.center, p.radius)); }
#endif
