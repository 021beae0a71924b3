// SPDX-License-Identifier: MIT
// Barr's superellipsoid (IEEE CG&A 1981):
//   (|x/a|^(2/e2) + |y/b|^(2/e2))^(e2/e1) + |z/c|^(2/e1) = 1,   0 < e1, e2 <= 2.
//
// g = F^(e1/2) is a nested p-norm: with r = |(x, y)|_p2 it is |(r, z)|_p1, p = 2/e >= 1. So g is convex along any
// ray, and Newton's steps on g - 1 from outside approach the surface without passing it; where the slope is
// not negative while g > 1, the ray misses. Powers are taken of ratios in [0, 1] only.
#include "core/reference/shapes_local.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace mote::reference {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// |(x, y)|_p of numbers >= 0 and its derivatives.
struct PNorm {
  double value{}, dx{}, dy{};
};
PNorm p_norm(double x, double y, double p) {
  const double most = std::max(x, y);
  if (!(most > 0.0)) return {};
  const double value = most * std::pow(1.0 + std::pow(std::min(x, y) / most, p), 1.0 / p);
  return {value, std::pow(x / value, p - 1.0), std::pow(y / value, p - 1.0)};
}

struct Norm {
  double value{};
  glm::dvec3 gradient{0};
};
Norm nested_norm(const glm::dvec3& q, double p1, double p2) {
  const PNorm flat = p_norm(std::abs(q.x), std::abs(q.y), p2);
  const PNorm all = p_norm(flat.value, std::abs(q.z), p1);
  return {all.value, glm::sign(q) * glm::dvec3(all.dx * flat.dx, all.dx * flat.dy, all.dy)};
}

// Where the solid is g <= 1, with the ray moved near before and after scaling (as the ellipsoid's).
struct Scaled {
  glm::dmat3 axes{1};
  glm::dvec3 a{1};
  double p1{1}, p2{1};
  double t{};
  glm::dvec3 l{0}, d{0};
};
Scaled scaled(const Particle& p, const Ray& ray) {
  Scaled s;
  s.axes = rotation_of(p.record[1]);
  s.a = xyz(p, 2);
  s.p1 = 2.0 / double(p.record[3].x);
  s.p2 = 2.0 / double(p.record[3].y);
  const Nearest first = nearest(ray.origin - p.center, ray.direction);
  s.d = into(s.axes, ray.direction) / s.a;
  const Nearest second = nearest(into(s.axes, first.l) / s.a, s.d);
  s.l = second.l;
  s.t = first.t + second.t;
  return s;
}

// Where the line meets the cube around the solid.
std::optional<Interval> within_cube(const glm::dvec3& l, const glm::dvec3& d) {
  Interval in{-infinity, infinity};
  for (int k = 0; k < 3; ++k) {
    if (d[k] == 0.0) {
      if (std::abs(l[k]) > 1.0) return std::nullopt;
      continue;
    }
    const auto [low, high] = std::minmax({(-1.0 - l[k]) / d[k], (1.0 - l[k]) / d[k]});
    in.t_in = std::max(in.t_in, low);
    in.t_out = std::min(in.t_out, high);
  }
  return in.t_in <= in.t_out ? std::optional(in) : std::nullopt;
}

// The first t >= from with g(l + t d) <= 1; nullopt: none up to `to`. A point of contact of order n makes the steps
// shrink by (n - 1) / n only, hence the number of steps.
std::optional<double> first_root(const Scaled& s, const glm::dvec3& d, double from, double to) {
  double t = from;
  for (int step = 0; step < 1000; ++step) {
    const Norm g = nested_norm(s.l + t * d, s.p1, s.p2);
    if (g.value <= 1.0) return t;
    const double slope = glm::dot(g.gradient, d);
    if (slope >= 0.0) return std::nullopt;
    const double next = t + (1.0 - g.value) / slope;
    if (!(next > t)) return t;
    if (next > to) return std::nullopt;
    t = next;
  }
  return t;
}

bool usable(const Particle& p) {
  const glm::dvec3 a = xyz(p, 2);
  const auto exponent = [](float e) { return e > 0.0f && e <= 2.0f; };
  return a.x > 0.0 && a.y > 0.0 && a.z > 0.0 && exponent(p.record[3].x) && exponent(p.record[3].y);
}

std::optional<Interval> along(const Scaled& s) {
  const auto cube = within_cube(s.l, s.d);
  if (!cube) return std::nullopt;
  const auto in = first_root(s, s.d, cube->t_in, cube->t_out);
  if (!in) return std::nullopt;
  const auto out = first_root(s, -s.d, -cube->t_out, -*in);
  return Interval{*in, out ? -*out : *in}; // a tangent may be lost to rounding from one side
}

std::optional<Interval> intersect(const Particle& p, const Ray& ray) {
  if (!usable(p)) return std::nullopt;
  const Scaled s = scaled(p, ray);
  const auto i = along(s);
  if (!i) return std::nullopt;
  return Interval{s.t + i->t_in, s.t + i->t_out};
}

glm::dvec3 normal(const Particle& p, const Ray& ray, bool exit) {
  const Scaled s = scaled(p, ray);
  const auto i = along(s);
  if (!i) return glm::dvec3(0);
  const glm::dvec3 q = s.l + (exit ? i->t_out : i->t_in) * s.d;
  return glm::normalize(s.axes * (nested_norm(q, s.p1, s.p2).gradient / s.a));
}

// How far the solid reaches along v: the dual norm of v in its axes, which nests the exponents p / (p - 1).
double reach(const glm::dvec3& v, double p1, double p2) {
  const auto dual = [](double x, double y, double p) {
    return p > 1.0 ? p_norm(x, y, p / (p - 1.0)).value : std::max(x, y);
  };
  return dual(dual(std::abs(v.x), std::abs(v.y), p2), std::abs(v.z), p1);
}

Bounds bounds(const Particle& p) {
  if (!usable(p)) return box_around(p.center, glm::dvec3(0));
  const glm::dmat3 rows = glm::transpose(rotation_of(p.record[1])); // column k: axis k of space in the solid's frame
  const glm::dvec3 a = xyz(p, 2);
  const double p1 = 2.0 / double(p.record[3].x), p2 = 2.0 / double(p.record[3].y);
  return box_around(p.center, {reach(rows[0] * a, p1, p2), reach(rows[1] * a, p1, p2), reach(rows[2] * a, p1, p2)});
}

double curvature(const Particle& p) { // edges are rounded by about e a / 2; smooth for e = 1
  const glm::dvec3 a = xyz(p, 2);
  const double e = std::min({double(p.record[3].x), double(p.record[3].y), 2.0 - double(p.record[3].x),
                             2.0 - double(p.record[3].y), 1.0});
  const double least = std::min({a.x, a.y, a.z});
  return std::max(e, 1e-3) * least * least / std::max({a.x, a.y, a.z});
}

} // namespace

constexpr Shape superquadric_shape{"superquadric", bounds, intersect, normal, curvature};

} // namespace mote::reference
