// SPDX-License-Identifier: MIT
// From values to numbers in [0, 1]: which values are the ends (fixed, of the data, percentiles, symmetric
// about zero), linear or logarithmic. Colors, radii and opacities are mapped through this. Values only.
#pragma once

#include "core/scene/attributes.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace mote {

enum class RangeRule : std::uint8_t {
  Series,     // least to largest finite value of the series ("auto")
  Frame,      // of the frame that is drawn
  Fixed,      // ends as given
  Percentile, // of the series, ends are percents
  Symmetric,  // -m to m, m = the largest absolute value of the series
};

// Ends and what lies between them. Logarithmic scales have both ends above 0.
struct ValueScale {
  double low{0.0}, high{1.0};
  bool logarithmic{};
  // 0 at low, 1 at high, beyond [0, 1] outside, NaN for NaN; 0 everywhere when both ends are the same.
  // Logarithmic: values at or below 0 are below every range (-infinity).
  [[nodiscard]] double operator()(double value) const;
};

// Values of an attribute over several frames, as much of them as ranges need. Memory is bounded: beyond
// 2^20 values, percentiles are those of every k-th one.
class RangeCollector {
public:
  // `positive`: only values above 0 count (logarithmic). `rows`: those that are drawn; empty: all.
  RangeCollector(bool keep_values, bool positive) : keep_(keep_values), positive_(positive) {}
  void add(const Attribute& attribute, std::uint64_t count, const std::vector<bool>& rows);
  [[nodiscard]] bool empty() const { return !(low_ <= high_); }
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }
  [[nodiscard]] double percentile(double percent); // linear between the nearest ranks; needs keep_values

private:
  void take(double value);
  bool keep_, positive_;
  double low_{1e308}, high_{-1e308};
  std::vector<double> values_{};
  std::uint64_t seen_{}, stride_{1};
};

} // namespace mote
