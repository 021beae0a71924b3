// SPDX-License-Identifier: MIT
#include "core/data/dataset.hpp"

#include <algorithm>
#include <limits>

namespace mote::data {

std::string_view to_string(ColumnType type) {
  switch (type) {
  case ColumnType::Double: return "double";
  case ColumnType::Int: return "int";
  case ColumnType::Text: return "text";
  }
  return "text";
}

std::uint64_t Column::rows() const {
  const std::uint64_t values_held = std::visit(
      [](const auto& held) -> std::uint64_t {
        if constexpr (std::is_same_v<std::decay_t<decltype(held)>, TextColumn>)
          return held.codes.size();
        else
          return held.size();
      },
      values);
  return components ? values_held / components : 0;
}

double Column::number(std::uint64_t row, std::uint32_t component) const {
  const std::uint64_t at = row * components + component;
  if (const auto* reals = std::get_if<std::vector<double>>(&values)) return (*reals)[at];
  if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&values))
    return static_cast<double>((*whole)[at]);
  return std::numeric_limits<double>::quiet_NaN();
}

const Column* Frame::find(std::string_view name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

} // namespace mote::data
