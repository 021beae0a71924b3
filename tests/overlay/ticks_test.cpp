// SPDX-License-Identifier: MIT
#include "core/overlay/ticks.hpp"

#include <gmock/gmock.h>

namespace mote::overlay {
namespace {

using testing::ElementsAre;

std::vector<std::string> labels(double low, double high, int wanted, bool logarithmic = false) {
  std::vector<std::string> out;
  for (const Tick& tick : ticks(low, high, wanted, logarithmic)) out.push_back(tick.label);
  return out;
}

TEST(Ticks, RoundStepsAndNoMoreDigitsThanTheyNeed) {
  EXPECT_THAT(labels(0, 10, 5), ElementsAre("0", "2", "4", "6", "8", "10"));
  EXPECT_THAT(labels(-1, 1, 4), ElementsAre("−1.0", "−0.5", "0", "0.5", "1.0"));
  EXPECT_THAT(labels(0.013, 0.021, 4), ElementsAre("0.014", "0.016", "0.018", "0.020"));
  EXPECT_THAT(labels(1000.2, 1000.9, 3), ElementsAre("1000.5"));
  EXPECT_THAT(labels(10, 0, 2), ElementsAre("0", "5", "10")); // turned around
}

TEST(Ticks, PowersForLargeAndSmallNumbers) {
  EXPECT_THAT(labels(0, 4e-7, 4), ElementsAre("0", "10⁻⁷", "2×10⁻⁷", "3×10⁻⁷", "4×10⁻⁷"));
  EXPECT_THAT(labels(0, 3e6, 3), ElementsAre("0", "10⁶", "2×10⁶", "3×10⁶"));
  EXPECT_EQ(number_label(-1.5e12, 1e11), "−1.5×10¹²");
}

TEST(Ticks, Logarithmic) {
  EXPECT_THAT(labels(1e-3, 1e3, 7, true), ElementsAre("0.001", "0.01", "0.1", "1", "10", "100", "1000"));
  EXPECT_THAT(labels(1, 60, 5, true), ElementsAre("1", "2", "5", "10", "20", "50"));
  EXPECT_THAT(labels(3, 4.5, 3, true), ElementsAre("3.0", "3.5", "4.0", "4.5")); // less than a decade: as others
  EXPECT_TRUE(ticks(0, 5, 5, true).empty());
}

TEST(Ticks, WhatIsNoRange) {
  EXPECT_THAT(labels(3.25, 3.25, 5), ElementsAre("3.25"));
  EXPECT_TRUE(ticks(0, INFINITY, 5, false).empty());
  EXPECT_TRUE(ticks(NAN, 1, 5, false).empty());
  EXPECT_LE(ticks(1.0, std::nextafter(1.0, 2.0), 5, false).size(), 100u);
}

TEST(Ticks, LengthsAndUnits) {
  EXPECT_EQ(round_length(7.9), 5.0);
  EXPECT_EQ(round_length(0.0021), 0.002);
  EXPECT_EQ(round_length(10.0), 10.0);
  EXPECT_EQ(round_length(0.0), 0.0);
  EXPECT_EQ(unit_label("A"), "Å");
  EXPECT_EQ(unit_label("A^2"), "Å²");
  EXPECT_EQ(unit_label("eV/A"), "eV/Å");
  EXPECT_EQ(unit_label("A/m"), "A/m"); // amperes
  EXPECT_EQ(unit_label("um"), "µm");
  EXPECT_EQ(unit_label("nm/ps"), "nm/ps");
}

} // namespace
} // namespace mote::overlay
