// SPDX-License-Identifier: MIT
#include "core/chart/chart.hpp"

#include <algorithm>
#include <cmath>

namespace mote::chart {
namespace {

bool finite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); }
bool beats(const Point& a, const Point& b) { return finite(a) && a.x <= b.x && a.y <= b.y && (a.x < b.x || a.y < b.y); }

bool beaten(const Panel& panel, const Point& point) {
  for (const Series& series : panel.series)
    for (const Point& other : series.points)
      if (beats(other, point)) return true;
  return false;
}

} // namespace

void mark_front(Chart& chart) {
  for (Panel& panel : chart.panels)
    for (Series& series : panel.series)
      for (Point& point : series.points) point.front = panel.trade_off && finite(point) && !beaten(panel, point);
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, values.size()) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::string label(const Axis& axis) { return axis.unit.empty() ? axis.quantity : axis.quantity + " [" + axis.unit + "]"; }

} // namespace mote::chart
