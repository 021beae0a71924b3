// SPDX-License-Identifier: MIT
#include "core/chart/scale.hpp"

#include <algorithm>
#include <cmath>

namespace mote::chart {
namespace {

constexpr double strip = 0.06; // of the axis, for zeros and for failures

// Outward to powers of ten; a short range to 1, 2, 5 times one.
void round_logarithmic(Scale& s) {
  const bool wide = s.high / s.low > 30.0;
  auto rounded = [&](double value, bool up) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    double best = up ? power * 10.0 : power;
    if (!wide)
      for (const double m : {2.0, 5.0})
        if (up ? (m * power >= value && m * power < best) : m * power <= value) best = m * power;
    if (up && power >= value) best = power;
    return best;
  };
  s.low = rounded(s.low * (1.0 + 1e-12), false);
  s.high = rounded(s.high * (1.0 - 1e-12), true);
  if (!(s.high > s.low)) s.high = s.low * 10.0;
}

void round_linear(Scale& s) {
  if (s.low > 0.0) s.low = 0.0;
  if (s.high <= s.low) s.high = s.low + 1.0;
  const std::vector<overlay::Tick> rough = overlay::ticks(s.low, s.high, 6, false);
  const double step = rough.size() > 1 ? rough[1].value - rough[0].value : s.high - s.low;
  s.low = std::floor(s.low / step + 1e-9) * step;
  s.high = std::ceil(s.high / step - 1e-9) * step;
}

} // namespace

Scale make_scale(const Panel& panel, bool x, int wanted) {
  Scale s;
  s.logarithmic = x ? panel.x.logarithmic : panel.y.logarithmic;
  double low = INFINITY, high = -INFINITY;
  for (const Series& series : panel.series)
    for (const Point& point : series.points) {
      const double value = x ? point.x : point.y;
      if (!std::isfinite(value)) s.failures = true;
      else if (s.logarithmic && value <= 0.0) s.zeros = true;
      else {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  if (low <= high) {
    s.low = low;
    s.high = high;
  }
  s.logarithmic ? round_logarithmic(s) : round_linear(s);
  s.ticks = overlay::ticks(s.low, s.high, wanted, s.logarithmic);
  return s;
}

double place(const Scale& s, double value) {
  const double bottom = s.zeros ? strip : 0.0, top = s.failures ? 1.0 - strip : 1.0;
  if (!std::isfinite(value)) return 1.0;
  if (s.logarithmic && value <= 0.0) return 0.0;
  const double t = s.logarithmic ? std::log(value / s.low) / std::log(s.high / s.low) : (value - s.low) / (s.high - s.low);
  return bottom + (top - bottom) * t;
}

} // namespace mote::chart
