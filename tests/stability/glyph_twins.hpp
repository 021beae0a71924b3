// SPDX-License-Identifier: MIT
// Naive formulas for particles with an axis, in the number type asked for: float is what a first version of a renderer would
// do, double is close enough to the truth at the distances of the tests.
#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <optional>

namespace mote::test::twin {

template <class T> using Vec = glm::vec<3, T>;

// A closed cylinder around `center`, unit axis u; the eye is the origin.
template <class T> struct Rod {
  Vec<T> center, u;
  T half_length, radius;
};
template <class T> Rod<T> rod(const glm::dvec3& center, const glm::dvec3& h, double radius) {
  return {Vec<T>(center), glm::normalize(Vec<T>(h)), static_cast<T>(glm::length(h)), static_cast<T>(radius)};
}
// The side's nearer root by the quadratic formula from the eye.
template <class T> T side_root(const Rod<T>& c, const Vec<T>& d) {
  const Vec<T> fp = c.u * glm::dot(c.center, c.u) - c.center, dp = d - c.u * glm::dot(d, c.u);
  const T a = glm::dot(dp, dp), b = glm::dot(fp, dp), k = glm::dot(fp, fp) - c.radius * c.radius;
  return (-b - std::sqrt(b * b - a * k)) / a;
}
// Side and discs, each accepted by a comparison of its own.
template <class T> std::optional<T> nearest(const Rod<T>& c, const Vec<T>& d) {
  std::optional<T> best;
  const T fz = -glm::dot(c.center, c.u), dz = glm::dot(d, c.u), t = side_root(c, d);
  if (t > 0 && std::abs(fz + t * dz) <= c.half_length) best = t;
  for (const T s : {T(-1), T(1)}) {
    const T at = (s * c.half_length - fz) / dz;
    const Vec<T> p = (at * d - c.center) - c.u * (fz + at * dz);
    if (at > 0 && glm::dot(p, p) <= c.radius * c.radius && (!best || at < *best)) best = at;
  }
  return best;
}

// The side of a cone with its apex at center + h, of `radius` at center - h: the nearer root, if it lies between.
template <class T> std::optional<T> cone_side(const Rod<T>& c, const Vec<T>& d) {
  const T k = c.radius / (2 * c.half_length);
  const Vec<T> f = -(c.center + c.u * c.half_length);
  const T fz = glm::dot(f, c.u), dz = glm::dot(d, c.u);
  const T a = glm::dot(d, d) - (1 + k * k) * dz * dz, b = glm::dot(f, d) - (1 + k * k) * fz * dz, e = glm::dot(f, f) - (1 + k * k) * fz * fz;
  const T t = (-b - std::sqrt(b * b - a * e)) / a, z = fz + t * dz;
  if (!(t > 0 && z <= 0 && z >= -2 * c.half_length)) return {};
  return t;
}

// The inside-outside function of a superquadric as it stands in the books.
template <class T> T superquadric(const Vec<T>& p, T e1, T e2) {
  return std::pow(std::pow(std::abs(p.x), 2 / e2) + std::pow(std::abs(p.y), 2 / e2), e2 / e1) + std::pow(std::abs(p.z), 2 / e1);
}

} // namespace mote::test::twin
