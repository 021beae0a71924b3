// SPDX-License-Identifier: MIT
#include "core/math/principal_axes.hpp"

#include <algorithm>
#include <cmath>

namespace mote {
namespace {

// Turns columns p and q of `m` in their plane until they are orthogonal. True if that changed anything.
bool orthogonalize(glm::dmat3& m, int p, int q) {
  const double a = glm::dot(m[p], m[p]), b = glm::dot(m[q], m[q]), c = glm::dot(m[p], m[q]);
  if (!(std::abs(c) > 1e-16 * std::sqrt(a * b))) return false;
  const double zeta = (b - a) / (2.0 * c);
  const double t = (zeta >= 0.0 ? 1.0 : -1.0) / (std::abs(zeta) + std::sqrt(1.0 + zeta * zeta));
  const double cosine = 1.0 / std::sqrt(1.0 + t * t), sine = cosine * t;
  const glm::dvec3 old = m[p];
  m[p] = cosine * old - sine * m[q];
  m[q] = sine * old + cosine * m[q];
  return true;
}

// A unit vector orthogonal to the unit vector v.
glm::dvec3 any_orthogonal(const glm::dvec3& v) {
  const glm::dvec3 away = std::abs(v.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(v, away));
}

} // namespace

PrincipalAxes principal_axes(const glm::dmat3& linear) {
  double size = 0.0;
  for (int k = 0; k < 3; ++k) size = std::max(size, glm::length(linear[k]));
  PrincipalAxes out;
  if (!(size > 0.0) || !std::isfinite(size)) {
    out.lengths = glm::dvec3(0);
    return out;
  }
  glm::dmat3 m = linear / size;
  for (int sweep = 0; sweep < 30; ++sweep) {
    const bool xy = orthogonalize(m, 0, 1), xz = orthogonalize(m, 0, 2), yz = orthogonalize(m, 1, 2);
    if (!xy && !xz && !yz) break;
  }
  for (int k = 0; k < 3; ++k) out.lengths[k] = glm::length(m[k]);
  // The two longest give directions; the third is orthogonal to them, whatever rounding left of it.
  int last = 0;
  for (int k = 1; k < 3; ++k)
    if (out.lengths[k] <= out.lengths[last]) last = k;
  const int i = (last + 1) % 3, j = (last + 2) % 3;
  const int longer = out.lengths[i] >= out.lengths[j] ? i : j, shorter = i + j - longer;
  out.axes[longer] = m[longer] / out.lengths[longer];
  const glm::dvec3 rest = m[shorter] - out.axes[longer] * glm::dot(out.axes[longer], m[shorter]);
  out.axes[shorter] = glm::length(rest) > 0.0 ? glm::normalize(rest) : any_orthogonal(out.axes[longer]);
  out.axes[last] = glm::cross(out.axes[i], out.axes[j]);
  out.lengths *= size;
  return out;
}

} // namespace mote
