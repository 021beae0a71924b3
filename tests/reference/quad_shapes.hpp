// SPDX-License-Identifier: MIT
// The surfaces of core/reference/shapes.hpp in 113-bit arithmetic, from their definitions: all points where a
// line meets a surface that bounds the solid, kept where they belong to its boundary, nearest and farthest taken.
// No frames, no intervals, nothing of the code under test. `grow` scales every length of the solid
// (of each part of the arrow about its own middle) by 1 + grow: what a backward error of that size does.
#pragma once

#include "random_shapes.hpp"
#include "scenes.hpp"

#include <array>
#include <optional>
#include <string_view>

namespace mote::test {

using Q3 = Point<quad>;
inline Q3 operator+(const Q3& a, const Q3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Q3 operator-(const Q3& a, const Q3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Q3 operator*(quad s, const Q3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Q3 q3(const glm::dvec3& v) { return {quad(v.x), quad(v.y), quad(v.z)}; }
inline quad length(const Q3& v) { return root(dot(v, v)); }
inline glm::dvec3 to_double(const Q3& v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }
inline quad magnitude(quad x) { return x < quad(0) ? -x : x; }

struct QuadHits {
  bool hit{};
  quad t_in{}, t_out{};
  Q3 n_in{}, n_out{}; // outward, any length
  void add(quad t, const Q3& n) {
    if (!hit || t < t_in) t_in = t, n_in = n;
    if (!hit || t > t_out) t_out = t, n_out = n;
    hit = true;
  }
};

// Roots of a t^2 + 2 b t + c.
inline std::array<std::optional<quad>, 2> roots(quad a, quad b, quad c) {
  if (a == quad(0)) return {b != quad(0) ? std::optional(-c / (quad(2) * b)) : std::nullopt, std::nullopt};
  const quad discriminant = b * b - a * c;
  if (discriminant < quad(0)) return {};
  return {(-b - root(discriminant)) / a, (-b + root(discriminant)) / a};
}

// Side (and disks) of a truncated cone from m - h to m + h with end radii r0, r1.
inline void add_frustum(QuadHits& hits, const Q3& o, const Q3& d, const Q3& m, const Q3& h, quad r0, quad r1, bool disks) {
  const quad half = length(h);
  if (!(half > quad(0))) return;
  const Q3 u = (quad(1) / half) * h, f = o - m;
  const quad middle = (r0 + r1) / quad(2), slope = (r1 - r0) / (quad(2) * half), fz = dot(f, u), dz = dot(d, u);
  const Q3 fp = f - fz * u, dp = d - dz * u;
  const quad fr = middle + slope * fz, dr = slope * dz;
  for (const auto& t : roots(dot(dp, dp) - dr * dr, dot(fp, dp) - fr * dr, dot(fp, fp) - fr * fr)) {
    if (!t || magnitude(fz + *t * dz) > half || fr + *t * dr < quad(0)) continue;
    const Q3 across = fp + *t * dp;
    const quad away = length(across);
    hits.add(*t, away > quad(0) ? (quad(1) / away) * across - slope * u : quad(slope > quad(0) ? -1 : 1) * u);
  }
  if (!disks || dz == quad(0)) return;
  for (const int sign : {-1, 1}) {
    const quad t = (quad(sign) * half - fz) / dz;
    if (length(fp + t * dp) <= (sign < 0 ? r0 : r1)) hits.add(t, quad(sign) * u);
  }
}

inline std::array<Q3, 3> axes_of(const glm::vec4& q) {
  const quad x = quad(q.x), y = quad(q.y), z = quad(q.z), w = quad(q.w), n = x * x + y * y + z * z + w * w;
  const quad i = quad(1) / n, two = quad(2) * i;
  return {Q3{(w * w + x * x - y * y - z * z) * i, (x * y + w * z) * two, (x * z - w * y) * two},
          Q3{(x * y - w * z) * two, (w * w - x * x + y * y - z * z) * i, (y * z + w * x) * two},
          Q3{(x * z + w * y) * two, (y * z - w * x) * two, (w * w - x * x - y * y + z * z) * i}};
}
inline Q3 in_axes(const std::array<Q3, 3>& a, const Q3& v) { return {dot(a[0], v), dot(a[1], v), dot(a[2], v)}; }
inline Q3 from_axes(const std::array<Q3, 3>& a, const Q3& v) { return v.x * a[0] + v.y * a[1] + v.z * a[2]; }

inline void add_box(QuadHits& hits, const Q3& o, const Q3& d, const std::array<Q3, 3>& axes, const std::array<quad, 3>& half) {
  for (std::size_t k = 0; k < 3; ++k)
    for (const int sign : {-1, 1}) {
      const quad dk = dot(axes[k], d);
      if (dk == quad(0)) continue;
      const quad t = (quad(sign) * half[k] - dot(axes[k], o)) / dk;
      const Q3 p = o + t * d;
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      if (magnitude(dot(axes[i], p)) <= half[i] && magnitude(dot(axes[j], p)) <= half[j]) hits.add(t, quad(sign) * axes[k]);
    }
}

// `o`: the ray's origin minus the particle's center. All types but the superquadric.
inline QuadHits quad_hits(std::string_view type, const Record& r, Q3 o, const Q3& d, double grow) {
  QuadHits hits;
  const quad g = quad(1) + quad(grow), shift = -dot(o, d) / dot(d, d);
  o = o + shift * d;
  const auto size = [&](float x) { return g * quad(x); };
  if (type == "capsule") {
    const Q3 h = g * q3(glm::dvec3(r[1]));
    const quad radius = size(r[1].w), hh = dot(h, h);
    add_frustum(hits, o, d, {}, h, radius, radius, false);
    for (const int sign : {-1, 1}) {
      const Q3 f = o - quad(sign) * h;
      for (const auto& t : roots(dot(d, d), dot(f, d), dot(f, f) - radius * radius))
        if (t && quad(sign) * dot(o + *t * d, h) >= hh) hits.add(*t, f + *t * d);
    }
  } else if (type == "polyline") { // where the ray meets the capsule or a plane, and is in all three
    const Q3 h = g * q3(glm::dvec3(r[1]));
    const quad radius = size(r[1].w), hh = dot(h, h);
    const std::array<Q3, 2> normals{quad(-1) * q3(glm::dvec3(r[2])), q3(glm::dvec3(r[3]))};
    const auto height = [&](std::size_t k, const Q3& p) { return dot(p - quad(k == 0 ? -1 : 1) * h, normals[k]); };
    const auto from_axis = [&](const Q3& p) {
      const quad along = dot(p, h) / hh;
      return p - (along < quad(-1) ? quad(-1) : along > quad(1) ? quad(1) : along) * h;
    };
    QuadHits whole = quad_hits("capsule", r, o, d, grow);
    const quad tiny = quad(1e-25) * radius;
    for (const auto& [t, n] : {std::pair(whole.t_in, whole.n_in), std::pair(whole.t_out, whole.n_out)}) {
      const Q3 p = o + t * d;
      if (whole.hit && height(0, p) <= tiny && height(1, p) <= tiny) hits.add(t, n);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const quad slope = dot(d, normals[k]);
      if (slope == quad(0)) continue;
      const quad t = -height(k, o) / slope;
      const Q3 p = o + t * d;
      if (length(from_axis(p)) <= radius && height(1 - k, p) <= tiny) hits.add(t, normals[k]);
    }
  } else if (type == "cylinder" || type == "cone") {
    add_frustum(hits, o, d, {}, g * q3(glm::dvec3(r[1])), size(r[1].w), size(r[2].x), type == "cone" || r[2].y == 0.0f);
  } else if (type == "arrow") {
    const Q3 h = q3(glm::dvec3(r[1]));
    const quad half = length(h), head = quad(r[2].y) < quad(2) * half ? quad(r[2].y) : quad(2) * half;
    const quad part = head / (quad(2) * half); // half the head in units of h
    add_frustum(hits, o, d, -part * h, (g * (quad(1) - part)) * h, size(r[1].w), size(r[1].w), true);
    add_frustum(hits, o, d, (quad(1) - part) * h, (g * part) * h, size(r[2].x), quad(0), true);
  } else if (type == "box") {
    add_box(hits, o, d, axes_of(r[1]), {size(r[2].x), size(r[2].y), size(r[2].z)});
  } else if (type == "ellipsoid" || type == "sphere") {
    const bool ball = type == "sphere";
    const auto axes = ball ? axes_of({0, 0, 0, 1}) : axes_of(r[1]);
    const glm::vec3 a = ball ? glm::vec3(r[0].w) : glm::vec3(r[2]);
    const auto scaled = [&](const Q3& v) { return Q3{v.x / size(a.x), v.y / size(a.y), v.z / size(a.z)}; };
    const Q3 so = scaled(in_axes(axes, o)), sd = scaled(in_axes(axes, d));
    for (const auto& t : roots(dot(sd, sd), dot(so, sd), dot(so, so) - quad(1)))
      if (t) hits.add(*t, from_axes(axes, scaled(so + *t * sd)));
  }
  hits.t_in = hits.t_in + shift;
  hits.t_out = hits.t_out + shift;
  return hits;
}

// exp by halving and a series, log by Halley's steps from double, x^p of them; x >= 0.
inline quad quad_exp(quad x) {
  int halvings = 0;
  for (; magnitude(x) > quad(0.01); ++halvings) x = x * quad(0.5);
  quad sum = quad(1), term = quad(1);
  for (int i = 1; i < 18; ++i) sum = sum + (term = term * x / quad(i));
  for (; halvings > 0; --halvings) sum = sum * sum;
  return sum;
}
inline quad quad_log(quad x) {
  quad y = quad(std::log(static_cast<double>(x)));
  for (int i = 0; i < 2; ++i) {
    const quad e = quad_exp(y);
    y = y + quad(2) * (x - e) / (x + e);
  }
  return y;
}
inline quad quad_pow(quad x, quad p) {
  if (!(x > quad(0))) return p == quad(0) ? quad(1) : quad(0);
  if (static_cast<double>(p) * std::log(static_cast<double>(x)) < -700.0) return quad(0);
  return quad_exp(p * quad_log(x));
}

// The superquadric's gauge g = F^(e1 / 2) (1 on the surface, homogeneous of degree 1) with its gradient, at o + t d.
struct QuadGauge {
  quad value{};
  Q3 gradient{}; // in the data set's axes
};
inline QuadGauge quad_gauge(const Record& r, const Q3& at) {
  const auto axes = axes_of(r[1]);
  const Q3 p = in_axes(axes, at);
  const quad x = magnitude(p.x) / quad(r[2].x), y = magnitude(p.y) / quad(r[2].y), z = magnitude(p.z) / quad(r[2].z);
  const quad p1 = quad(2) / quad(r[3].x), p2 = quad(2) / quad(r[3].y), one = quad(1);
  const auto norm = [&](quad a, quad b, quad power) {
    const quad most = a > b ? a : b;
    return most > quad(0) ? most * quad_pow(quad_pow(a / most, power) + quad_pow(b / most, power), one / power) : quad(0);
  };
  const quad flat = norm(x, y, p2), g = norm(flat, z, p1);
  const auto slope = [&](quad a, quad value, quad power) { return value > quad(0) ? quad_pow(a / value, power - one) : quad(0); };
  const quad outer = slope(flat, g, p1);
  const auto sign = [](quad v) { return v < quad(0) ? quad(-1) : v > quad(0) ? quad(1) : quad(0); };
  const Q3 local{outer * slope(x, flat, p2) * sign(p.x) / quad(r[2].x), outer * slope(y, flat, p2) * sign(p.y) / quad(r[2].y),
                 slope(z, g, p1) * sign(p.z) / quad(r[2].z)};
  return {g, from_axes(axes, local)};
}

} // namespace mote::test
