// SPDX-License-Identifier: MIT
// Ranges, places and ticks of axes by known answers.
#include "core/chart/scale.hpp"

#include <gmock/gmock.h>

namespace mote::chart {
namespace {

Scale scale_of(const std::vector<double>& values, bool logarithmic) {
  Panel panel{.title = "", .x = {"x", "", logarithmic}, .y = {}, .series = {{"m", false, {}}}};
  for (const double v : values) panel.series[0].points.push_back({"", v, 1.0});
  return make_scale(panel, true, 6);
}
std::vector<double> values(const Scale& s) {
  std::vector<double> out;
  for (const overlay::Tick& t : s.ticks) out.push_back(t.value);
  return out;
}
using testing::DoubleNear;
using testing::ElementsAre;

TEST(Scale, WideLogarithmicRangesEndAtPowersOfTen) {
  const Scale s = scale_of({3e-7, 40.0}, true);
  EXPECT_NEAR(s.low, 1e-7, 1e-20);
  EXPECT_NEAR(s.high, 100.0, 1e-9);
  EXPECT_DOUBLE_EQ(place(s, s.low), 0.0);
  EXPECT_DOUBLE_EQ(place(s, s.high), 1.0);
  EXPECT_NEAR(place(s, 1e-7 * std::pow(10.0, 4.5)), 0.5, 1e-12);
  for (const overlay::Tick& t : s.ticks) EXPECT_NEAR(std::log10(t.value), std::round(std::log10(t.value)), 1e-9);
}
TEST(Scale, ShortLogarithmicRangesEndAtOneTwoFive) {
  const Scale s = scale_of({2.3, 17.0}, true);
  EXPECT_DOUBLE_EQ(s.low, 2.0);
  EXPECT_DOUBLE_EQ(s.high, 20.0);
  EXPECT_THAT(values(s), ElementsAre(DoubleNear(2, 1e-9), DoubleNear(5, 1e-9), DoubleNear(10, 1e-9), DoubleNear(20, 1e-9)));
}
TEST(Scale, PowersOfTenAreTheirOwnEnds) {
  const Scale s = scale_of({10.0, 1e6}, true);
  EXPECT_DOUBLE_EQ(s.low, 10.0);
  EXPECT_DOUBLE_EQ(s.high, 1e6);
}
TEST(Scale, LinearRangesBeginAtZeroAndEndAtAStep) {
  const Scale s = scale_of({3.0, 17.0}, false);
  EXPECT_DOUBLE_EQ(s.low, 0.0);
  EXPECT_DOUBLE_EQ(s.high, 20.0);
  EXPECT_NEAR(place(s, 5.0), 0.25, 1e-12);
}
TEST(Scale, ZerosAndFailuresHaveStripsOfTheirOwn) {
  const Scale s = scale_of({0.0, 1e-3, 1.0, INFINITY, NAN}, true);
  EXPECT_TRUE(s.zeros);
  EXPECT_TRUE(s.failures);
  EXPECT_EQ(place(s, 0.0), 0.0);
  EXPECT_EQ(place(s, INFINITY), 1.0);
  EXPECT_EQ(place(s, NAN), 1.0);
  EXPECT_GT(place(s, 1e-3), 0.03);
  EXPECT_LT(place(s, 1.0), 0.97);
}
TEST(Scale, OneValueAndNoneHaveARangeToo) {
  for (const bool logarithmic : {true, false}) {
    EXPECT_GT(scale_of({5.0}, logarithmic).high, scale_of({5.0}, logarithmic).low);
    EXPECT_GT(scale_of({}, logarithmic).high, scale_of({}, logarithmic).low);
    EXPECT_GT(scale_of({0.0}, logarithmic).high, scale_of({0.0}, logarithmic).low);
  }
}

} // namespace
} // namespace mote::chart
