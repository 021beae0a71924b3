// SPDX-License-Identifier: MIT
#include "core/scene/attributes.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace mote {

double Attribute::at(std::uint64_t row) const {
  if (is_text()) return std::get<data::TextColumn>(column->values).codes[row];
  if (component) return column->number(row, *component);
  if (column->components == 1) return column->number(row);
  double square = 0.0;
  for (std::uint32_t k = 0; k < column->components; ++k) square += column->number(row, k) * column->number(row, k);
  return std::sqrt(square);
}

namespace {

// "x" "y" "z" or a number -> component
std::optional<std::uint32_t> parse_component(std::string_view word, std::uint32_t components) {
  std::uint32_t index = 0;
  if (word.size() == 1 && word[0] >= 'x' && word[0] <= 'z') {
    index = static_cast<std::uint32_t>(word[0] - 'x');
  } else {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  }
  return index < components ? std::optional(index) : std::nullopt;
}

} // namespace

std::optional<Attribute> find_attribute(const data::Frame& frame, std::string_view name) {
  if (const data::Column* column = frame.find(name)) return Attribute{column, std::nullopt};
  if (name == "speed")
    if (const data::Column* velocity = frame.find("velocity")) return Attribute{velocity, std::nullopt};
  if (name == "type") // as users call the kind of a particle, whatever the file calls it
    if (const data::Column* element = frame.find("element")) return Attribute{element, std::nullopt};
  const std::size_t dot = name.rfind('.');
  const bool axis = name.size() == 1 && name[0] >= 'x' && name[0] <= 'z';
  if (!axis && dot == std::string_view::npos) return std::nullopt;
  const data::Column* column = frame.find(axis ? "position" : name.substr(0, dot));
  if (!column || column->type() == data::ColumnType::Text) return std::nullopt;
  const auto component = parse_component(axis ? name : name.substr(dot + 1), column->components);
  return component ? std::optional(Attribute{column, component}) : std::nullopt;
}

std::vector<std::string> attribute_names(const data::Frame& frame) {
  std::vector<std::string> names;
  for (const data::Column& column : frame.columns) names.push_back(column.name);
  return names;
}

std::optional<std::pair<double, double>> finite_range(const Attribute& attribute, std::uint64_t rows) {
  std::optional<std::pair<double, double>> range;
  for (std::uint64_t row = 0; row < rows; ++row) {
    const double value = attribute.at(row);
    if (!std::isfinite(value)) continue;
    if (!range) range = {value, value};
    range->first = std::min(range->first, value);
    range->second = std::max(range->second, value);
  }
  return range;
}

} // namespace mote
