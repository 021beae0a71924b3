// SPDX-License-Identifier: MIT
// docs/errata.md: for each error of the course documents, the right form holds and the printed one does not.
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

namespace mote {
namespace {

using glm::dmat4, glm::dvec2, glm::dvec3, glm::dvec4;

TEST(Errata, TheYRowOfYuv) {
  EXPECT_NEAR(0.299 + 0.587 + 0.114, 1.0, 1e-12);
  EXPECT_GT(0.299 + 0.587 + 0.144, 1.02) << "as printed: white brighter than white";
  EXPECT_NEAR(-0.14713 - 0.28887 + 0.436, 0.0, 1e-12) << "grays have no chroma";
  EXPECT_NEAR(0.615 - 0.51499 - 0.10001, 0.0, 1e-12);
}

TEST(Errata, TheViewportSample) {
  const dvec2 viewport(1024, 512), sample = viewport * (dvec2(0.2, 0.2) * 0.5 + 0.5);
  EXPECT_NEAR(sample.x, 614.4, 1e-12);
  EXPECT_NEAR(sample.y, 307.2, 1e-12);
  EXPECT_NE(std::floor(sample.x), 613.0);
}

TEST(Errata, RotationAboutAPoint) {
  const dvec3 point(4, 4, 1);
  const dmat4 turn = glm::rotate(dmat4(1), glm::radians(90.0), dvec3(0, 0, 1)), there = glm::translate(dmat4(1), point), back = glm::translate(dmat4(1), -point);
  const dmat4 right = there * turn * back, printed = back * turn * there;
  EXPECT_LT(glm::length(dvec3(right * dvec4(point, 1)) - point), 1e-12) << "points of the axis stay";
  EXPECT_LT(glm::length(dvec3(right * dvec4(5, 4, 1, 1)) - dvec3(4, 5, 1)), 1e-12);
  EXPECT_GT(glm::length(dvec3(printed * dvec4(point, 1)) - point), 1.0);
}

// A ray through the silhouette's plane at q in (0, 1), the eye at 5 radii.
TEST(Errata, BetaTakesTheCenter) {
  const double kappa = 5.0, rho = std::sqrt(1.0 - 1.0 / (kappa * kappa));
  double trap = 0.0;
  for (double q = 0.0; q < 1.0; q += 0.01) {
    const dvec2 p(rho * q, kappa - 1.0 / kappa), center(0, kappa);
    auto residual = [&](double distance) {
      const double beta = std::sqrt(1.0 - q * q) / distance;
      return std::abs(glm::length(p / (1.0 + beta) - center) - 1.0);
    };
    EXPECT_LT(residual(glm::length(center)), 1e-12) << q;
    trap = std::max(trap, residual(glm::length(p)));
  }
  EXPECT_GT(trap, 0.01);
}

TEST(Errata, SkewedAxesNeedASolve) {
  const dvec3 u(2, 0, 0), v(1, 3, 0), p = 0.25 * u + 0.5 * v;
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), det = uu * vv - uv * uv;
  EXPECT_NEAR((vv * glm::dot(p, u) - uv * glm::dot(p, v)) / det, 0.25, 1e-12);
  EXPECT_NEAR((uu * glm::dot(p, v) - uv * glm::dot(p, u)) / det, 0.5, 1e-12);
  EXPECT_GT(std::abs(glm::dot(p, u) / uu - 0.25), 0.1) << "two dot products";
  EXPECT_GT(std::abs(glm::length(glm::cross(u, v)) - 1.0), 1.0) << "N is no unit vector by itself";
}

TEST(Errata, TangentMustBeUnit) {
  const double epsilon = 1e-6;
  auto uses_z = [&](const dvec3& t) { return t.x * t.x + t.y * t.y > epsilon; };
  const dvec3 short_axis = 1e-4 * glm::normalize(dvec3(1, 0, 1));
  EXPECT_FALSE(uses_z(short_axis)) << "a short axis in small units seems to be along z";
  EXPECT_TRUE(uses_z(glm::normalize(short_axis)));
}

TEST(Errata, TheCylinderAxis) {
  const dvec3 p1(1, 2, 3), p2(4, 2, -1), axis = p2 - p1, printed = p1 - p2;
  EXPECT_EQ(p1 + 1.0 * axis, p2);
  EXPECT_NE(p1 + 1.0 * printed, p2);
  const dvec3 middle = 0.5 * (p1 + p2);
  EXPECT_NEAR(glm::dot(middle - p1, axis) / glm::dot(axis, axis), 0.5, 1e-12);
  EXPECT_LT(glm::dot(middle - p1, printed) / glm::dot(printed, printed), 0.0) << "the middle of the cylinder is cut away";
}

// Moeller and Trumbore's test as the lecture has it, with its last comparison of the distance along the ray.
std::optional<double> intersect(dvec3 v1, dvec3 v2, dvec3 v3, dvec3 origin, dvec3 direction) {
  const double epsilon = 1e-12;
  const dvec3 edge1 = v2 - v1, edge2 = v3 - v1, p = glm::cross(direction, edge2);
  const double det = glm::dot(edge1, p);
  if (std::abs(det) < epsilon) return {};
  const dvec3 t = origin - v1, q = glm::cross(t, edge1);
  const double u = glm::dot(t, p) / det, v = glm::dot(direction, q) / det, mu = glm::dot(edge2, q) / det;
  if (u < 0 || v < 0 || u + v > 1 || mu <= epsilon) return {};
  return mu;
}
TEST(Errata, TheTriangleComparesItsParameter) {
  const dvec3 a(0, 0, 5), b(1, 0, 5), c(0, 1, 5);
  EXPECT_NEAR(intersect(a, b, c, {0.2, 0.2, 0}, {0, 0, 1}).value_or(-1), 5.0, 1e-12);
  EXPECT_FALSE(intersect(a, b, c, {0.2, 0.2, 10}, {0, 0, 1})) << "behind the origin";
  EXPECT_FALSE(intersect(a, b, c, {0.8, 0.8, 0}, {0, 0, 1}));
}

// Every test that the page names is here.
TEST(Errata, TheDocumentNamesTestsThatExist) {
  const std::string text = (std::ostringstream() << std::ifstream(MOTE_SOURCE_DIR "/docs/errata.md").rdbuf()).str();
  const testing::TestSuite* suite = nullptr;
  for (int i = 0; i < testing::UnitTest::GetInstance()->total_test_suite_count(); ++i)
    if (std::string_view(testing::UnitTest::GetInstance()->GetTestSuite(i)->name()) == "Errata") suite = testing::UnitTest::GetInstance()->GetTestSuite(i);
  ASSERT_NE(suite, nullptr);
  std::size_t named = 0;
  for (int i = 0; i < suite->total_test_count(); ++i) named += text.find(std::string("`Errata.") + suite->GetTestInfo(i)->name() + "`") != std::string::npos;
  EXPECT_EQ(named + 1, static_cast<std::size_t>(suite->total_test_count()));
}

} // namespace
} // namespace mote
