// SPDX-License-Identifier: MIT
// The Pareto front and percentiles by known answers.
#include "core/chart/chart.hpp"

#include <gmock/gmock.h>

namespace mote::chart {
namespace {

using testing::ElementsAre;

Chart chart_of(std::vector<std::pair<double, double>> points, bool trade_off = true) {
  Chart c;
  Panel panel{.title = "p", .x = {"time", "ms"}, .y = {"error", ""}, .trade_off = trade_off, .series = {}};
  for (const auto& [x, y] : points) panel.series.push_back({"m", false, {{"", x, y}}}); // each its own method: the front is the panel's
  c.panels = {panel};
  return c;
}
std::vector<bool> front(Chart c) {
  mark_front(c);
  std::vector<bool> out;
  for (const Series& s : c.panels[0].series) out.push_back(s.points[0].front);
  return out;
}

TEST(Front, IsWhatNoOtherPointBeats) {
  EXPECT_THAT(front(chart_of({{1, 9}, {2, 5}, {3, 6}, {4, 1}, {5, 1}})), ElementsAre(true, true, false, true, false));
}
TEST(Front, EqualPointsDoNotBeatEachOther) { EXPECT_THAT(front(chart_of({{1, 1}, {1, 1}, {1, 2}})), ElementsAre(true, true, false)); }
TEST(Front, ZeroErrorBeatsWhatIsSlowerOnly) { EXPECT_THAT(front(chart_of({{2, 0}, {1, 3}, {3, 0}})), ElementsAre(true, true, false)); }
TEST(Front, WhatFailedIsNeverOnIt) {
  EXPECT_THAT(front(chart_of({{1, INFINITY}, {2, 5}, {0.5, NAN}})), ElementsAre(false, true, false));
}
TEST(Front, OnlyPanelsOfATradeOffHaveOne) { EXPECT_THAT(front(chart_of({{1, 9}, {2, 5}}, false)), ElementsAre(false, false)); }

TEST(Percentile, IsTheNearestRank) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  EXPECT_EQ(percentile(values, 0.99), 99.0);
  EXPECT_EQ(percentile(values, 0.5), 50.0);
  EXPECT_EQ(percentile(values, 1.0), 100.0);
  EXPECT_EQ(percentile({7.0}, 0.01), 7.0);
  EXPECT_EQ(percentile({}, 0.5), 0.0);
}

TEST(Label, HasItsUnit) {
  EXPECT_EQ(label({"time", "ms"}), "time [ms]");
  EXPECT_EQ(label({"ratio", ""}), "ratio");
}

} // namespace
} // namespace mote::chart
