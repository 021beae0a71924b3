// SPDX-License-Identifier: MIT
// Ellipsoid and box: solids with three axes of their own, turned by a quaternion.
#include "core/reference/shapes_local.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace mote::reference {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Where the ellipsoid is the unit ball. The ray is moved near in data units first, then scaled, then
// moved again: the scaled offset of a distant eye would lose the ratio of the axes.
struct Scaled {
  glm::dmat3 axes{1};
  glm::dvec3 a{1};  // semi-axes
  double t{};       // parameter of l
  glm::dvec3 l{0}, d{0};
};
Scaled scaled(const Particle& p, const Ray& ray) {
  Scaled s;
  s.axes = rotation_of(p.record[1]);
  s.a = xyz(p, 2);
  const Nearest first = nearest(ray.origin - p.center, ray.direction);
  s.d = into(s.axes, ray.direction) / s.a;
  const Nearest second = nearest(into(s.axes, first.l) / s.a, s.d);
  s.l = second.l;
  s.t = first.t + second.t;
  return s;
}

// Half the chord of the unit ball, in the ray's parameter; nullopt: missed.
std::optional<double> half_chord(const Scaled& s) {
  const double distance = glm::length(s.l), squared = (1.0 - distance) * (1.0 + distance) / glm::dot(s.d, s.d);
  return squared >= 0.0 ? std::optional(std::sqrt(squared)) : std::nullopt;
}

bool positive(const glm::dvec3& a) { return a.x > 0.0 && a.y > 0.0 && a.z > 0.0; }

std::optional<Interval> ellipsoid_intersect(const Particle& p, const Ray& ray) {
  if (!positive(xyz(p, 2))) return std::nullopt;
  const Scaled s = scaled(p, ray);
  const auto h = half_chord(s);
  if (!h) return std::nullopt;
  return Interval{s.t - *h, s.t + *h};
}

glm::dvec3 ellipsoid_normal(const Particle& p, const Ray& ray, bool exit) {
  const Scaled s = scaled(p, ray);
  const double h = half_chord(s).value_or(0.0);
  return glm::normalize(s.axes * ((s.l + (exit ? h : -h) * s.d) / s.a));
}

Bounds ellipsoid_bounds(const Particle& p) {
  const glm::dmat3 axes = rotation_of(p.record[1]);
  const glm::dvec3 a = xyz(p, 2);
  const glm::dvec3 x = axes[0] * a.x, y = axes[1] * a.y, z = axes[2] * a.z;
  return box_around(p.center, glm::sqrt(x * x + y * y + z * z));
}

double ellipsoid_curvature(const Particle& p) {
  const glm::dvec3 a = xyz(p, 2);
  const double least = std::min({a.x, a.y, a.z});
  return least * least / std::max({a.x, a.y, a.z});
}

// Slabs (Kay and Kajiya 1986), with the axes of the faces that end the interval.
struct Face {
  double t{};
  int axis{};
};
struct Slabs {
  glm::dmat3 axes{1};
  Face in{-infinity}, out{infinity};
  double t{};
};
std::optional<Slabs> slabs(const Particle& p, const Ray& ray) {
  Slabs s;
  s.axes = rotation_of(p.record[1]);
  const glm::dvec3 half = xyz(p, 2);
  const Nearest n = nearest(ray.origin - p.center, ray.direction);
  const glm::dvec3 l = into(s.axes, n.l), d = into(s.axes, ray.direction);
  s.t = n.t;
  for (int k = 0; k < 3; ++k) {
    if (d[k] == 0.0) {
      if (std::abs(l[k]) > half[k]) return std::nullopt;
      continue;
    }
    Face low{(-half[k] - l[k]) / d[k], k}, high{(half[k] - l[k]) / d[k], k};
    if (low.t > high.t) std::swap(low, high);
    if (low.t > s.in.t) s.in = low;
    if (high.t < s.out.t) s.out = high;
  }
  return s.in.t <= s.out.t ? std::optional(s) : std::nullopt;
}

std::optional<Interval> box_intersect(const Particle& p, const Ray& ray) {
  const auto s = slabs(p, ray);
  if (!s) return std::nullopt;
  return Interval{s->t + s->in.t, s->t + s->out.t};
}

glm::dvec3 box_normal(const Particle& p, const Ray& ray, bool exit) {
  const auto s = slabs(p, ray);
  if (!s) return glm::dvec3(0);
  // By the ray's direction, not by which plane it was: those of a plate are one.
  const glm::dvec3 axis = s->axes[exit ? s->out.axis : s->in.axis];
  return (glm::dot(axis, ray.direction) >= 0.0) == exit ? axis : -axis;
}

Bounds box_bounds(const Particle& p) {
  const glm::dmat3 axes = rotation_of(p.record[1]);
  const glm::dvec3 half = xyz(p, 2);
  return box_around(p.center, glm::abs(axes[0]) * half.x + glm::abs(axes[1]) * half.y + glm::abs(axes[2]) * half.z);
}

double least_half(const Particle& p) {
  const glm::dvec3 half = xyz(p, 2);
  return std::min({half.x, half.y, half.z});
}

} // namespace

constexpr Shape ellipsoid_shape{"ellipsoid", ellipsoid_bounds, ellipsoid_intersect, ellipsoid_normal, ellipsoid_curvature};
constexpr Shape box_shape{"box", box_bounds, box_intersect, box_normal, least_half};

} // namespace mote::reference
