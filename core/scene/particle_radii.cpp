// SPDX-License-Identifier: MIT
#include "core/data/elements.hpp"
#include "core/data/neighbors.hpp"
#include "core/scene/attributes.hpp"
#include "core/scene/codes.hpp"
#include "core/scene/particle_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote {
namespace {

constexpr double lone_radius = 0.5;            // of particles that have no neighbor to compare with
constexpr double unknown_element_radius = 2.0; // Angstrom

// The numeric attribute that a rule names, or nothing (reported).
std::optional<Attribute> number_attribute(const data::Frame& frame, const Located<std::string>& name, const FrameOrigin& origin,
                                          Diagnostics& diagnostics) {
  const std::optional<Attribute> attribute = find_attribute(frame, name.value);
  const std::vector<std::string> names = attribute_names(frame);
  if (!attribute) {
    diagnostics.error(code::attribute_missing, name.loc,
                      fmt::format("{} has no attribute '{}'", origin.name, name.value),
                      {did_you_mean(name.value, names), fmt::format("Attributes: {}", list_of(names))});
  } else if (attribute->is_text()) {
    diagnostics.error(code::attribute_is_text, name.loc,
                      fmt::format("the attribute '{}' of {} holds text; a radius needs numbers", name.value, origin.name));
    return std::nullopt;
  }
  return attribute;
}

std::vector<double> mapped_radii(const data::Frame& frame, const RadiusDesc& rule, const FrameOrigin& origin,
                                 Diagnostics& diagnostics) {
  const std::optional<Attribute> attribute = number_attribute(frame, rule.mapping.attribute, origin, diagnostics);
  if (!attribute) return {};
  std::vector<double> radii(frame.count);
  if (rule.rule == RadiusRule::Attribute) {
    for (std::uint64_t row = 0; row < frame.count; ++row) radii[row] = attribute->at(row);
    return radii;
  }
  const auto [low, high] = rule.mapping.range ? *rule.mapping.range : finite_range(*attribute, frame.count).value_or(std::pair{0.0, 1.0});
  const auto [from, to] = rule.mapping.to;
  for (std::uint64_t row = 0; row < frame.count; ++row) {
    const double value = attribute->at(row);
    const double t = high == low ? 0.0 : (value - low) / (high - low);
    radii[row] = std::isnan(t) ? t : from + (to - from) * std::clamp(t, 0.0, 1.0);
  }
  return radii;
}

std::vector<double> element_radii(const data::Frame& frame, const data::Column& elements) {
  const auto& text = std::get<data::TextColumn>(elements.values);
  const data::Column* position = frame.find("position");
  const double per_angstrom = position && position->unit == "nm" ? 0.1 : 1.0;
  std::vector<double> by_code;
  for (const std::string& symbol : text.dictionary) {
    const data::Element* element = data::find_element(symbol);
    const double radius = element ? double{element->vdw_radius()} : 0.0;
    by_code.push_back(per_angstrom * (radius > 0.0 ? radius : unknown_element_radius));
  }
  std::vector<double> radii(frame.count);
  for (std::uint64_t row = 0; row < frame.count; ++row) radii[row] = by_code[text.codes[row]];
  return radii;
}

} // namespace

std::vector<double> particle_radii(const data::Frame& frame, const RadiusDesc& rule, const FrameOrigin& origin,
                                   Diagnostics& diagnostics) {
  switch (rule.rule) {
  case RadiusRule::Constant: return std::vector<double>(frame.count, rule.constant);
  case RadiusRule::Attribute:
  case RadiusRule::Mapped: return mapped_radii(frame, rule, origin, diagnostics);
  case RadiusRule::Auto: break;
  }
  if (const data::Column* radius = frame.find("radius"); radius && radius->components == 1) {
    if (const auto* values = std::get_if<std::vector<double>>(&radius->values)) return *values;
    RadiusDesc by_column;
    by_column.rule = RadiusRule::Attribute;
    by_column.mapping.attribute = {"radius", origin.contents};
    return mapped_radii(frame, by_column, origin, diagnostics);
  }
  if (const data::Column* elements = frame.find("element"); elements && elements->type() == data::ColumnType::Text)
    return element_radii(frame, *elements);
  const data::Column* position = frame.find("position");
  const auto* values = position ? std::get_if<std::vector<double>>(&position->values) : nullptr;
  const std::optional<double> distance = values ? data::median_neighbor_distance(*values) : std::nullopt;
  return std::vector<double>(frame.count, distance ? 0.5 * *distance : lone_radius);
}

} // namespace mote
