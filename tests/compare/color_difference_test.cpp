// SPDX-License-Identifier: MIT
// CIEDE2000 against pairs published by Sharma, Wu and Dalal (2005), sRGB and L*a*b* against known values.
#include "core/compare/color_difference.hpp"

#include <gtest/gtest.h>

namespace mote::compare {
namespace {

TEST(ColorDifference, PublishedPairs) {
  struct Case {
    glm::dvec3 a, b;
    double expected;
  };
  const Case cases[] = {
      {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
      {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
      {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
      {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
      {{50, 0, 0}, {50, -1, 2}, 2.3669},
      {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0009}, 7.1792},
      {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0011}, 7.2195},
      {{50, -0.0010, 2.4900}, {50, 0.0009, -2.4900}, 4.8045},
      {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
      {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
      {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
      {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
      {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
      {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
      {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
  };
  for (const Case& c : cases) {
    EXPECT_NEAR(ciede2000(c.a, c.b), c.expected, 5.1e-5) << c.a.x << " " << c.a.y << " " << c.a.z;
    EXPECT_NEAR(ciede2000(c.b, c.a), c.expected, 5.1e-5);
  }
}

TEST(ColorDifference, SrgbToLab) {
  const glm::dvec3 white = lab_from_srgb(glm::dvec3(1)), black = lab_from_srgb(glm::dvec3(0));
  EXPECT_NEAR(glm::distance(white, glm::dvec3(100, 0, 0)), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(black, glm::dvec3(0)), 0.0, 1e-9);
  const glm::dvec3 red = lab_from_srgb({1, 0, 0}); // 53.24, 80.09, 67.20
  EXPECT_NEAR(red.x, 53.24, 0.02);
  EXPECT_NEAR(red.y, 80.09, 0.05);
  EXPECT_NEAR(red.z, 67.20, 0.05);
}

TEST(ColorDifference, SrgbCurveIsItsOwnInverse) {
  EXPECT_NEAR(srgb_encode(0.21404114048223255), 0.5, 1e-12);
  for (const double x : {0.0, 0.001, 0.02, 0.5, 1.0}) EXPECT_NEAR(srgb_decode(srgb_encode(x)), x, 1e-7);
  EXPECT_DOUBLE_EQ(srgb_encode(7.0), 1.0);
  EXPECT_EQ(srgb_encode(-1.0), 0.0);
}

} // namespace
} // namespace mote::compare
