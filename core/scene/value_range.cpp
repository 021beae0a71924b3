// SPDX-License-Identifier: MIT
#include "core/scene/value_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mote {
namespace {
constexpr std::size_t most_values = std::size_t{1} << 20;
}

double ValueScale::operator()(double value) const {
  if (std::isnan(value)) return value;
  if (logarithmic && value <= 0.0) return -std::numeric_limits<double>::infinity();
  if (low == high) return 0.0;
  return logarithmic ? (std::log(value) - std::log(low)) / (std::log(high) - std::log(low)) : (value - low) / (high - low);
}

void RangeCollector::take(double value) {
  if (!std::isfinite(value) || (positive_ && value <= 0.0)) return;
  low_ = std::min(low_, value);
  high_ = std::max(high_, value);
  if (!keep_ || seen_++ % stride_ != 0) return;
  values_.push_back(value);
  if (values_.size() < most_values) return;
  for (std::size_t i = 0; 2 * i < values_.size(); ++i) values_[i] = values_[2 * i];
  values_.resize(values_.size() / 2);
  stride_ *= 2;
}

void RangeCollector::add(const Attribute& attribute, std::uint64_t count, const std::vector<bool>& rows) {
  for (std::uint64_t row = 0; row < count; ++row)
    if (rows.empty() || rows[row]) take(attribute.at(row));
}

double RangeCollector::percentile(double percent) {
  if (values_.empty()) return 0.0;
  const double at = std::clamp(percent, 0.0, 100.0) / 100.0 * static_cast<double>(values_.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(at);
  std::nth_element(values_.begin(), values_.begin() + below, values_.end());
  const double first = values_[static_cast<std::size_t>(below)];
  const double part = at - static_cast<double>(below);
  if (part == 0.0) return first;
  return first + part * (*std::min_element(values_.begin() + below + 1, values_.end()) - first);
}

} // namespace mote
