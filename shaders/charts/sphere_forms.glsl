// SPDX-License-Identifier: MIT
// Ways to intersect a ray with a sphere in float32, one of them by FORM; the eye is the origin. Letters are those of the
// method book, section 3.1. What mote draws with is form 13, from common/exact.glsl; most others are here to be
// compared with.
#ifndef MOTE_SPHERE_FORMS_GLSL
#define MOTE_SPHERE_FORMS_GLSL
#include "common/exact.glsl"

struct Hit {
  bool hit;
  vec3 normal, normal_low; // the rest beyond float32 in _low: form 10 only
  float t, t_low;
};
struct Given {
  vec3 center;
  float radius;
  vec3 direction;
  vec3 x, y; // directions that span the plane of the silhouette, and the place on it in units of its radius: forms 8, 9
  vec2 q;
};

Hit missed() { return Hit(false, vec3(0.0), vec3(0.0), 0.0, 0.0); }
Hit hit_at(float t, vec3 normal) { return Hit(true, normal, vec3(0.0), t, 0.0); }

Hit solve(Given g) {
  vec3 m = g.center, d = g.direction, f = -m;
  float r = g.radius;
#if FORM == 0 // A: the quadratic formula as it stands in every book
  float a = dot(d, d), b = 2.0 * dot(d, f), c = dot(f, f) - r * r, D = b * b - 4.0 * a * c;
  if (D < 0.0) return missed();
  float t = (-b - sqrt(D)) / (2.0 * a);
  return hit_at(t, normalize(t * d - m));
#elif FORM == 1 // B: the lecture's, for unit directions
  float b = dot(d, f), c = dot(f, f) - r * r, D = b * b - c;
  if (D < 0.0) return missed();
  float t = -b - sqrt(D);
  return hit_at(t, normalize(t * d - m));
#elif FORM == 2 // C: the root without cancellation in its sum; the discriminant still cancels
  float a = dot(d, d), b = dot(d, f), c = dot(f, f) - r * r, D = b * b - a * c;
  if (D < 0.0) return missed();
  float q = -b + (b > 0.0 ? -sqrt(D) : sqrt(D)), t = min(c / q, q / a);
  return hit_at(t, normalize(t * d - m));
#elif FORM == 4 // E: Haines, Guenther, Akenine-Moeller 2019
  float a = dot(d, d), b = dot(d, f), c = dot(f, f) - r * r;
  vec3 l = f - d * (b / a);
  float D = r * r - dot(l, l);
  if (D < 0.0) return missed();
  float q = -b + (b > 0.0 ? -sqrt(a * D) : sqrt(a * D)), t = min(c / q, q / a);
  return hit_at(t, normalize(t * d - m));
#elif FORM == 5 // F: from the perpendicular, with the local normal
  float ia = 1.0 / dot(d, d), s = dot(m, d) * ia;
  vec3 l = m - d * s;
  float D = r * r - dot(l, l);
  if (D < 0.0) return missed();
  float h = sqrt(D * ia);
  return hit_at(s - h, (-(d * h) - l) / r);
#elif FORM == 6 || FORM == 12 // G with fma(), and without
  float ia = 1.0 / dot(d, d), s = dot(m, d) * ia;
#if FORM == 6
  vec3 l = fma(vec3(s), d, -m);
  float e = dot(l, d) * ia;
  l = fma(vec3(-e), d, l);
#else
  precise vec3 l = d * s - m;
  precise float e = dot(l, d) * ia;
  l = l - d * e;
#endif
  float distance = length(l), D = (r - distance) * (r + distance);
  if (D < 0.0) return missed();
  float h = sqrt(D * ia);
  return hit_at(s - (e + h), (l - h * d) / r);
#elif FORM == 8 || FORM == 9 // the exercise's silhouette parameter q: I with the normal from the world, J from the local point
  vec3 e = -m;
  float ratio2 = r * r / dot(e, e);
  vec3 p = e * ratio2 + (g.x * g.q.x + g.y * g.q.y) * (sqrt(1.0 - ratio2) * r);
  float beta = r * sqrt(1.0 - dot(g.q, g.q)) / sqrt(dot(e, e)), lambda = 1.0 / (1.0 + beta);
  float t = length(p - e) * lambda / length(d);
#if FORM == 8
  return hit_at(t, normalize(e + (p - e) * lambda));
#else
  return hit_at(t, (p + (e - p) * (beta * lambda)) / r);
#endif
#elif FORM == 10 // K: the quadratic formula in double
  dvec3 md = dvec3(m), dd = dvec3(d);
  double a = dot(dd, dd), b = -dot(dd, md), c = dot(md, md) - double(r) * double(r), D = b * b - a * c;
  if (D < 0.0) return missed();
  double t = (-b - sqrt(D)) / a;
  dvec3 n = (t * dd - md) / double(r);
  vec3 high = vec3(n);
  return Hit(true, high, vec3(n - dvec3(high)), float(t), float(t - double(float(t))));
#elif FORM == 11 // L: coefficients and discriminant as sums of two floats
  vec3 zero = vec3(0.0);
  vec2 a = dot_pair(d, zero, d, zero), b = dot_pair(d, zero, f, zero), c = minus(dot_pair(f, zero, f, zero), two_product(r, r));
  float D = minus(times(b, b), times(a, c)).x;
  if (D < 0.0) return missed();
  float t = c.x / (sqrt(D) - b.x - b.y);
  return hit_at(t, normalize(t * d - m));
#elif FORM == 13 || FORM == 14 // N: split arithmetic; as shaders/particles/sphere/type.glsl. 14: roots and quotients 2.5 ulp off
#if FORM == 14
  const float off = 1.0 + 1.5e-7;
#else
  const float off = 1.0;
#endif
  vec3 l;
  vec2 middle;
  shift_in_parts(f, d, l, middle);
  float distance = length(l) * off, D = (r - distance) * (r + distance);
  if (D < 0.0) return missed();
  float h = sqrt(D / dot(d, d) * off) * off;
  return hit_at(middle.x + (middle.y - h), (l - h * d) / r * off);
#endif
}

#endif
