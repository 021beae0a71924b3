// SPDX-License-Identifier: MIT
// The reference against 113-bit arithmetic: hit decisions, depths, normals.
#include "core/reference/shapes.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace mote {
namespace {

using namespace mote::test;

double angle(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Every pixel of the view against brute force in Real. Returns the number of pixels hit.
template <class Real>
std::size_t expect_same(const Scene& scene, const View& view, double depth_tolerance = 1e-12,
                        double angle_tolerance = 1e-8) {
  const ReferencePicture picture = render_reference(scene, view);
  const PlainSpheres<Real> plain(scene, view);
  std::size_t hit = 0, wrong = 0, shown = 0;
  for (std::uint32_t y = 0; y < view.size.height; ++y)
    for (std::uint32_t x = 0; x < view.size.width; ++x) {
      const std::size_t i = std::size_t{y} * view.size.width + x;
      const Plain p = plain.at(view, x, y);
      hit += p.id != reference_no_id;
      const bool same = picture.id[i] == p.id;
      const bool near_enough = p.id == reference_no_id
                                   ? std::isinf(picture.depth[i])
                                   : std::abs(picture.depth[i] - p.t) <= depth_tolerance * p.t &&
                                         angle(picture.normal[i], p.normal) <= angle_tolerance;
      if ((same && near_enough) || picture.ambiguous[i]) continue;
      ++wrong;
      if (++shown <= 3)
        ADD_FAILURE() << "pixel " << x << "," << y << ": id " << picture.id[i] << " depth "
                      << picture.depth[i] << ", exactly " << p.id << " at " << p.t << ", normals "
                      << angle(picture.normal[i], p.normal) << " rad apart";
    }
  EXPECT_EQ(wrong, 0u);
  std::size_t ambiguous = 0;
  for (const std::uint8_t a : picture.ambiguous) ambiguous += a;
  EXPECT_LE(ambiguous, picture.ambiguous.size() / 50);
  return hit;
}

constexpr Size2d small{48, 36};

TEST(ReferenceExact, PerspectiveEqualsQuadArithmetic) {
  const Scene scene = scene_of(random_balls(300, 5.0, 0.2, 0.9));
  EXPECT_GT(expect_same<quad>(scene, look({12, -9, 7}, {0, 0, 0}, small)), 500u);
}

TEST(ReferenceExact, OrthographicEqualsQuadArithmetic) {
  const Scene scene = scene_of(random_balls(300, 5.0, 0.2, 0.9));
  EXPECT_GT(expect_same<quad>(scene, look_parallel({12, -9, 7}, {0, 0, 0}, small, 9.0)), 500u);
}

TEST(ReferenceExact, EyeInsideSpheres) {
  std::vector<Ball> balls = random_balls(200, 5.0, 0.3, 1.2);
  balls.push_back({{0.1, 0.1, 0.0}, 0.7});
  balls.push_back({{0.0, 0.0, 0.0}, 30.0});
  EXPECT_EQ(expect_same<quad>(scene_of(balls), look({0, 0, 0}, {1, 2, 0.3}, small, 80.0)), 48u * 36u);
}

TEST(ReferenceExact, NearCutShowsTheInside) {
  const Scene scene = scene_of(random_balls(200, 5.0, 0.3, 1.2));
  View view = look({0, -8, 0}, {0, 0, 0}, small);
  view.near_cut = 7.0;
  EXPECT_GT(expect_same<quad>(scene, view), 300u);
  view.near_cut = 0.0;
  view.far_cut = 7.5;
  EXPECT_GT(expect_same<quad>(scene, view), 300u);
}

TEST(ReferenceExact, SampleOffsetIsHonored) {
  const Scene scene = scene_of(random_balls(200, 5.0, 0.3, 1.2));
  View view = look({0, -12, 0}, {0, 0, 0}, small);
  view.sample_offset = {17.25, -3.0};
  expect_same<quad>(scene, view);
}

TEST(ReferenceExact, TurnedScaledAndMirroredInstances) {
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  const std::vector<glm::dmat4> instances{glm::dmat4(1),
                                          glm::translate(glm::dmat4(1), glm::dvec3(6, 1, 0)) * turn *
                                              glm::scale(glm::dmat4(1), glm::dvec3(0.5)),
                                          glm::translate(glm::dmat4(1), glm::dvec3(-6, 1, 2)) * turn *
                                              glm::scale(glm::dmat4(1), glm::dvec3(-1.5, 1.5, 1.5))};
  const Scene scene = scene_of(random_balls(80, 2.0, 0.2, 0.7), instances);
  EXPECT_GT(expect_same<quad>(scene, look({2, -16, 5}, {0, 0, 0}, small), 1e-12, 1e-7), 400u);
}

TEST(ReferenceExact, MillionUnitsAway) {
  const glm::dvec3 there(1e6, -2e6, 3e6);
  const Scene scene = scene_of(random_balls(300, 5.0, 0.2, 0.9, 1, there));
  EXPECT_GT(expect_same<quad>(scene, look(there + glm::dvec3(12, -9, 7), there, small), 1e-9, 1e-5), 500u);
}

// Grazing and central rays at every distance: the decision equals 113-bit arithmetic, and the errors obey the
// law of the local form (t within some 1e-16 of the distance; normals independent of it, but for grazing).
TEST(ReferenceExact, SphereIntersectorAgainstQuad) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1), log_miss(-9, -1);
  const reference::Shape& sphere = *reference::find_shape("sphere");
  std::size_t hits = 0;
  for (const double distance : {0.3, 2.0, 1e2, 1e4, 1e6})
    for (int i = 0; i < 4000; ++i) {
      const glm::dvec3 center =
          glm::normalize(glm::dvec3(unit(random), unit(random), unit(random))) * distance;
      const glm::dvec3 aside =
          glm::normalize(glm::cross(center, glm::dvec3(unit(random), unit(random), unit(random))));
      const double graze = std::pow(10.0, log_miss(random)) * (i % 2 ? 1 : -1);
      const glm::dvec3 direction = center + aside * (i % 4 < 2 ? 1.0 + graze : unit(random));
      const reference::Particle p{center, 1.0, {}};
      const auto found = sphere.intersect(p, {glm::dvec3(0), direction});
      const Point<quad> d{direction.x, direction.y, direction.z}, c{center.x, center.y, center.z};
      const quad a = dot(d, d), b = dot(d, c), discriminant = b * b - a * (dot(c, c) - quad(1));
      const double margin = static_cast<double>(discriminant / a);
      if (std::abs(margin) < 1e-15 * distance) continue; // within rounding of the silhouette
      ASSERT_EQ(found.has_value(), discriminant > quad(0)) << "distance " << distance << " margin " << margin;
      if (!found) continue;
      ++hits;
      const quad h = root(discriminant);
      const double length = glm::length(direction);
      const double grazing = std::sqrt(std::max(margin, 1e-30));
      EXPECT_LT(std::abs(static_cast<double>(quad(found->t_in) - (b - h) / a)) * length,
                4e-15 * distance / std::min(1.0, grazing) + 1e-15);
      EXPECT_LT(std::abs(static_cast<double>(quad(found->t_out) - (b + h) / a)) * length,
                4e-15 * distance / std::min(1.0, grazing) + 1e-15);
      const quad t = (b - h) / a;
      const glm::dvec3 n(static_cast<double>(t * d.x - c.x), static_cast<double>(t * d.y - c.y),
                         static_cast<double>(t * d.z - c.z));
      EXPECT_LT(angle(n, sphere.normal(p, {glm::dvec3(0), direction}, false)),
                1e-15 * std::max(1.0, distance) / std::min(1.0, grazing) + 1e-15);
    }
  EXPECT_GT(hits, 8000u);
}

} // namespace
} // namespace mote
