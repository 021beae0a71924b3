// SPDX-License-Identifier: MIT
#include "core/color/curve_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mote {

namespace {
constexpr std::uint32_t nodes_per_sign = CurveTable::cells_per_sign + 1;

float node(std::uint32_t i) {
  return std::bit_cast<float>((CurveTable::first_cell + i) << CurveTable::shift) - CurveTable::bias;
}
} // namespace

CurveTable::CurveTable(const std::function<void(std::span<float>)>& evaluate) {
  std::vector<float> values(std::size_t{2} * nodes_per_sign * 3);
  for (std::uint32_t i = 0; i < 2 * nodes_per_sign; ++i) {
    const float x = i < nodes_per_sign ? node(i) : -node(i - nodes_per_sign);
    std::fill_n(values.begin() + std::size_t{i} * 3, 3, x);
  }
  evaluate(values);
  usable_ = std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  data_.resize(std::size_t{3} * cells * 2);
  for (std::uint32_t channel = 0; channel < 3; ++channel)
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
      const std::uint32_t at = cell < cells_per_sign ? cell : nodes_per_sign + cell - cells_per_sign;
      const float value = values[std::size_t{at} * 3 + channel],
                  next = values[std::size_t{at + 1} * 3 + channel];
      float* entry = &data_[(std::size_t{channel} * cells + cell) * 2];
      entry[0] = value;
      entry[1] = next - value;
    }
  const auto row = static_cast<std::ptrdiff_t>(cells) * 2;
  if (std::equal(data_.begin(), data_.begin() + row, data_.begin() + row) &&
      std::equal(data_.begin(), data_.begin() + row, data_.begin() + 2 * row)) {
    rows_ = 1;
    data_.resize(static_cast<std::size_t>(row));
  }
}

float CurveTable::operator()(std::uint32_t channel, float x) const {
  const auto bits = std::bit_cast<std::uint32_t>(std::min(std::fabs(x) + bias, largest));
  const std::uint32_t cell = (bits >> shift) - first_cell + (x < 0.0f ? cells_per_sign : 0u);
  const std::uint32_t row = rows_ == 1 ? 0u : channel;
  const float* entry = &data_[(std::size_t{row} * cells + cell) * 2];
  return entry[0] + entry[1] * (static_cast<float>(bits & ((1u << shift) - 1u)) * 0x1p-17f);
}

} // namespace mote
