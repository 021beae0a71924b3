// SPDX-License-Identifier: MIT
// Where a number lies on an axis of a picture, and which numbers are written beside it. A logarithmic axis keeps a
// strip below its range for zeros and, on both kinds, one above for what is not finite. Pure.
#pragma once

#include "core/chart/chart.hpp"
#include "core/overlay/ticks.hpp"

namespace mote::chart {

struct Scale {
  double low{1}, high{10};  // of what is finite (and above 0, if logarithmic), rounded outward
  bool logarithmic{};
  bool zeros{};             // a strip for values of 0 or less, logarithmic only
  bool failures{};          // a strip for values that are not finite
  std::vector<overlay::Tick> ticks{};
};
// Of the values on this axis; `wanted` labels.
Scale make_scale(const Panel& panel, bool x, int wanted);

// 0 at the low end of the axis, 1 at the high end; strips included.
double place(const Scale& scale, double value);

} // namespace mote::chart
