// SPDX-License-Identifier: MIT
// Naive formulas in float32 on the processor: what a first version of a renderer would do. Tests show that they fail.
#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <optional>

namespace mote::test::twin {

// Nearest root of the quadratic of the books; f: ray origin minus center.
inline std::optional<float> quadratic(glm::vec3 f, float r, glm::vec3 d) {
  const float a = glm::dot(d, d), b = 2.0f * glm::dot(d, f), c = glm::dot(f, f) - r * r, D = b * b - 4.0f * a * c;
  if (!(D >= 0.0f)) return {};
  return (-b - std::sqrt(D)) / (2.0f * a);
}
// From the perpendicular; m: center minus ray origin.
inline std::optional<float> perpendicular(glm::vec3 m, float r, glm::vec3 d) {
  const float ia = 1.0f / glm::dot(d, d), s = glm::dot(m, d) * ia;
  const glm::vec3 l = m - d * s;
  const float D = r * r - glm::dot(l, l);
  if (!(D >= 0.0f)) return {};
  return s - std::sqrt(D * ia);
}
// The same in double, twice: with the distance first, without cancellation.
inline std::optional<double> exact(glm::dvec3 m, double r, glm::dvec3 d) {
  const double dd = glm::dot(d, d), b = glm::dot(m, d), power = (glm::length(m) - r) * (glm::length(m) + r);
  const glm::dvec3 l = m - d * (b / dd);
  const double square = (r - glm::length(l)) * (r + glm::length(l));
  if (square < 0.0) return {};
  return power / (b + std::sqrt(square * dd));
}
// Does a ray hit an ellipsoid around the origin: by its explicit quadric matrix, and where it is the unit sphere. `linear`: its half
// axes as columns.
inline bool quadric(glm::dvec3 f, const glm::dmat3& linear, glm::dvec3 d) {
  const glm::dmat3 inverse = glm::inverse(linear);
  const glm::mat3 q(glm::transpose(inverse) * inverse);
  const glm::vec3 o(f), e(d);
  const float a = glm::dot(e, q * e), b = glm::dot(e, q * o), c = glm::dot(o, q * o) - 1.0f;
  return b * b - a * c >= 0.0f;
}
inline bool quadric_exact(glm::dvec3 f, const glm::dmat3& linear, glm::dvec3 d) {
  const glm::dmat3 inverse = glm::inverse(linear);
  const glm::dvec3 o = inverse * f, e = inverse * d, l = o - e * (glm::dot(o, e) / glm::dot(e, e));
  return glm::length(l) <= 1.0;
}
// Depth of a projection matrix, near 0.1, far 1e6, as float32 keeps it.
inline float standard_depth(double z) {
  constexpr float n = 0.1f, f = 1e6f;
  const float zf = static_cast<float>(z);
  return (f / (f - n) * zf - f * n / (f - n)) / zf;
}

} // namespace mote::test::twin
