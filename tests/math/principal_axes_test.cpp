// SPDX-License-Identifier: MIT
#include "core/math/principal_axes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mote {
namespace {

std::array<double, 3> sorted(const glm::dvec3& v) {
  std::array<double, 3> out{v.x, v.y, v.z};
  std::sort(out.begin(), out.end());
  return out;
}

void expect_orthonormal(const glm::dmat3& m) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(glm::dot(m[i], m[j]), i == j ? 1.0 : 0.0, 1e-14);
  EXPECT_NEAR(glm::determinant(m), 1.0, 1e-14) << "right-handed";
}

glm::dmat3 random_rotation(std::mt19937& random) {
  std::normal_distribution<double> n;
  const glm::dvec3 x = glm::normalize(glm::dvec3(n(random), n(random), n(random)));
  const glm::dvec3 y = glm::normalize(glm::cross(x, glm::dvec3(n(random), n(random), n(random))));
  return {x, y, glm::cross(x, y)};
}

// linear = U S V^T: the lengths are S to full relative precision, however different, and the image is the same.
TEST(PrincipalAxes, FindsWhatWentIn) {
  std::mt19937 random(5);
  for (const glm::dvec3 lengths : {glm::dvec3(1, 1, 1), glm::dvec3(3, 2, 1), glm::dvec3(1, 1, 1e-6), glm::dvec3(1e8, 1, 1), glm::dvec3(1e-20, 2e-20, 1e-18)})
    for (int i = 0; i < 50; ++i) {
      const glm::dmat3 u = random_rotation(random), v = random_rotation(random);
      glm::dmat3 s(0.0);
      for (int k = 0; k < 3; ++k) s[k][k] = lengths[k];
      const glm::dmat3 linear = u * s * glm::transpose(v);
      const PrincipalAxes found = principal_axes(linear);
      expect_orthonormal(found.axes);
      const auto want = sorted(lengths), got = sorted(found.lengths);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(got[k], want[k], 1e-14 * want[2] + 1e-8 * want[k]);
      // Both maps take the unit ball to the same ellipsoid: linear linear^T agrees.
      glm::dmat3 back = found.axes;
      for (int k = 0; k < 3; ++k) back[k] *= found.lengths[k];
      const glm::dmat3 a = linear * glm::transpose(linear), b = back * glm::transpose(back);
      for (int k = 0; k < 3; ++k) EXPECT_LT(glm::length(a[k] - b[k]), 1e-13 * want[2] * want[2]);
    }
}

TEST(PrincipalAxes, FlatMapsHaveAZeroLength) {
  for (const glm::dmat3& flat : {glm::dmat3(0.0), glm::dmat3(1, 0, 0, 0, 0, 0, 0, 0, 0), glm::dmat3(1, 0, 0, 2, 0, 0, 0, 0, 1)}) {
    const PrincipalAxes found = principal_axes(flat);
    expect_orthonormal(found.axes);
    EXPECT_NEAR(found.shortest(), 0.0, 1e-15);
  }
}

} // namespace
} // namespace mote
