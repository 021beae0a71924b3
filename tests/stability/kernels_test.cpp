// SPDX-License-Identifier: MIT
// Failure cases of arithmetic: the naive form and mote's, both as shaders on the device, against extended precision. Numbers of
// the bars: method book, sections 3.1, 5 and 6.
#include "app/charts/chroma.hpp"
#include "app/charts/errors.hpp"
#include "app/charts/kernel.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace mote::app {
namespace {

constexpr int naive = 0, haines = 4, perpendicular = 5, unfused = 12, mote = 13, silhouette_local = 9;
constexpr int world_matrix = 0, world_minus_eye = 1, chunk = 2, two_floats = 3, two_floats_loose = 4;
constexpr int standard = 0, reverse_infinite = 1;

class Stability : public testing::Test {
protected:
  static DrawingDevice& device() {
    static DrawingDevice one({.name = "", .validation = true});
    return one;
  }
  void TearDown() override { EXPECT_NO_THROW(device().check()) << "the validation layer is silent"; }
};

TEST_F(Stability, FC01_NormalsAtAnyDistance) {
  EXPECT_GT(sphere_errors(device(), naive, 1e2, false).normal, 2e-3);
  EXPECT_GT(sphere_errors(device(), naive, 1e4, false).missed, 10.0) << "holes";
  EXPECT_GT(sphere_errors(device(), haines, 1e5, false).normal, 1e-2);
  EXPECT_GT(sphere_errors(device(), perpendicular, 1e5, false).normal, 1e-2);
  for (const double kappa : {2.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
    const SphereErrors e = sphere_errors(device(), mote, kappa, false);
    EXPECT_LE(e.normal, kappa <= 1e4 ? 5e-7 : 2e-5) << kappa;
    if (kappa >= 10.0) {
      EXPECT_LE(e.ulps, 1.0) << kappa;
    }
    EXPECT_EQ(e.missed, 0.0) << kappa;
  }
}

TEST_F(Stability, FC02_GrazingRays) {
  EXPECT_GT(sphere_errors(device(), naive, 1e3, true).missed, 20.0);
  EXPECT_GT(sphere_errors(device(), haines, 1e3, true).missed, 0.5);
  EXPECT_GT(sphere_errors(device(), perpendicular, 1e3, true).missed, 0.5);
  for (const double kappa : {1e1, 1e2, 1e3, 1e4}) EXPECT_EQ(sphere_errors(device(), mote, kappa, true).missed, 0.0) << kappa;
}

// In beta = r sqrt(1 - q^2) / |e - p| the point p is the particle's center. Read as the point of the quad, the hit leaves the
// surface, little enough to pass a casual look.
TEST_F(Stability, FC03_TheBetaTrap) {
  double worst_right = 0.0;
  for (const double kappa : {2.0, 5.0, 25.0}) {
    double worst_trap = 0.0;
    for (double q = 0.0; q < 1.0; q += 0.01) {
      const double rho = std::sqrt(1.0 - 1.0 / (kappa * kappa)), pz = kappa - 1.0 / kappa, px = rho * q; // eye at the origin, center at (0, kappa)
      const double chord = std::sqrt(1.0 - q * q);
      auto residual = [&](double distance) {
        const double lambda = 1.0 / (1.0 + chord / distance);
        return std::abs(std::hypot(lambda * px, lambda * pz - kappa) - 1.0);
      };
      worst_right = std::max(worst_right, residual(kappa));
      worst_trap = std::max(worst_trap, residual(std::hypot(px, pz)));
    }
    EXPECT_GT(worst_trap, 1e-3) << kappa;
  }
  EXPECT_LE(worst_right, 1e-6);
  EXPECT_LE(sphere_errors(device(), silhouette_local, 25.0, false).normal, 5e-7) << "the right reading, as a shader";
  EXPECT_LE(sphere_errors(device(), mote, 25.0, false).normal, 5e-7);
}

TEST_F(Stability, FC04_FarFromTheOrigin) {
  EXPECT_GT(placement_error(device(), world_matrix, 1e6), 0.1) << "more than a pixel";
  EXPECT_GT(placement_error(device(), world_minus_eye, 1e6), 0.05);
  for (const double offset : {1.0, 1e3, 1e4, 1e5, 1e6, 1e7}) EXPECT_LE(placement_error(device(), chunk, offset), 2e-5) << offset;
}

TEST_F(Stability, FC05_ReassociationIsDetected) {
  EXPECT_GT(placement_error(device(), two_floats_loose, 1e6), 0.01);
  EXPECT_LE(placement_error(device(), two_floats, 1e6), 2e-5);
}

TEST_F(Stability, FC27_PlatesAMillionthApart) {
  auto wrong = [&](int encoding) {
    const std::array<gpu::ShaderDefine, 1> defines{{{"ENCODING", std::to_string(encoding)}}};
    std::vector<float> given;
    constexpr std::uint32_t plates = 1000;
    for (std::uint32_t i = 0; i < plates; ++i)
      for (const double z : {1000.0 * (1.0 + 1e-4 * i), 1000.0 * (1.0 + 1e-4 * i) * (1.0 + 1e-6)}) given.insert(given.end(), {static_cast<float>(z), 0.1f, 1e6f, 0.0f});
    const std::vector<float> depth = Kernel(device(), "charts/depth.comp", defines).run(given, 2 * plates, 1);
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < plates; ++i) {
      const float near = depth[8 * i], far = depth[8 * i + 4];
      count += encoding == reverse_infinite ? !(near > far) : !(near < far);
    }
    return count;
  };
  EXPECT_GT(wrong(standard), 500u);
  EXPECT_EQ(wrong(reverse_infinite), 0u);
}

TEST_F(Stability, FC26_DepthOverSixDecades) {
  EXPECT_GT(depth_error(device(), standard, 0, 4.0), 1e-4);
  EXPECT_GT(depth_error(device(), standard, 16, 4.0), 1e-2);
  EXPECT_GT(depth_error(device(), reverse_infinite, 24, 4.0), 1e-4) << "reverse-Z needs a float format";
  for (const double decade : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) EXPECT_LE(depth_error(device(), reverse_infinite, 0, decade), 1e-7) << decade;
}

// mote's form uses no fma(), so a fused one changes nothing of it; the form that hopes for one loses on devices without. Roots and
// quotients that err by what the specification allows (2.5 ulp: 1.5e-7) move the bar by as much and no law.
TEST_F(Stability, FC61_FmaAndLooseRoots) {
  EXPECT_GT(sphere_errors(device(), unfused, 1e4, false).normal, 1e-4);
  const int with_fma = 6;
  const bool fused = has_fused_fma(device());
  EXPECT_EQ(sphere_errors(device(), with_fma, 1e4, false).normal <= 5e-7, fused) << "fma() is " << (fused ? "fused" : "not fused");
  constexpr int mote_with_loose_roots = 14;
  for (const double kappa : {1e1, 1e2, 1e3, 1e4}) {
    const SphereErrors e = sphere_errors(device(), mote_with_loose_roots, kappa, false);
    EXPECT_LE(e.normal, 3 * 5e-7) << kappa;
    EXPECT_EQ(e.missed, 0.0) << kappa;
  }
}

// The mean of two hues on both sides of red is not their hue's mean; gray and black have no hue at all. mote mixes colors, never
// hues, and a table of the six knots is exact.
TEST_F(Stability, FC56_HuesAtTheSeam) {
  const double left = 0.995, right = 0.005;
  EXPECT_GT(glm::length(hue_color(0.5 * (left + right)) - glm::dvec3(1, 0, 0)), 1.0) << "cyan instead of red";
  EXPECT_LT(glm::length(0.5 * (hue_color(left) + hue_color(right)) - glm::dvec3(1, 0, 0)), 0.05);
  for (double h = 0.0; h < 1.0; h += 0.001) EXPECT_LT(glm::length(hue_from_table(HueTable::Knots, 6, h) - hue_color(h)), 1e-12) << h;
  EXPECT_GT(glm::length(hue_from_table(HueTable::Centers, 256, 1.0 / 6.0) - hue_color(1.0 / 6.0)), 1.0 / 255.0) << "a table of 256 that is not aligned";
  const std::array<gpu::ShaderDefine, 1> hsv{{{"MODEL", "3"}}};
  const std::vector<float> colors{0, 0, 0, 0, 0.5f, 0.5f, 0.5f, 0, 1, 1, 1, 0, 1, 0, 0, 0, 1, 0, 1e-7f, 0};
  for (const float error : Kernel(device(), "charts/color_models.comp", hsv).run(colors, 5, 1)) EXPECT_LE(std::abs(error), 1e-6f);
}

} // namespace
} // namespace mote::app
