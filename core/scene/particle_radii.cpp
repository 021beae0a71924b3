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

std::vector<double> mapped_radii(const FrameContext& context, const RadiusDesc& rule, Diagnostics& diagnostics) {
  const std::optional<Attribute> attribute = wanted_attribute(context, rule.mapping.attribute, true, diagnostics);
  if (!attribute) return {};
  std::vector<double> radii(context.frame.count);
  if (rule.rule == RadiusRule::Attribute) {
    for (std::uint64_t row = 0; row < radii.size(); ++row) radii[row] = attribute->at(row);
    return radii;
  }
  const ValueScale scale = value_scale(context, rule.mapping, *attribute, diagnostics);
  const auto [from, to] = rule.mapping.to;
  for (std::uint64_t row = 0; row < radii.size(); ++row) {
    const double t = scale(attribute->at(row));
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

std::vector<double> particle_radii(const FrameContext& context, const RadiusDesc& rule, Diagnostics& diagnostics) {
  const data::Frame& frame = context.frame;
  const data::Column* elements = frame.find("element");
  const bool has_elements = elements && elements->type() == data::ColumnType::Text;
  switch (rule.rule) {
  case RadiusRule::Constant: return std::vector<double>(frame.count, rule.constant);
  case RadiusRule::Attribute:
  case RadiusRule::Mapped: return mapped_radii(context, rule, diagnostics);
  case RadiusRule::Element:
    if (has_elements) return element_radii(frame, *elements);
    diagnostics.error(code::element_missing, rule.loc, fmt::format("{} has no elements to take radii from", context.name),
                      {fmt::format("Attributes: {}", list_of(attribute_names(frame)))});
    return {};
  case RadiusRule::Auto: break;
  }
  if (const data::Column* radius = frame.find("radius"); radius && radius->components == 1) {
    if (const auto* values = std::get_if<std::vector<double>>(&radius->values)) return *values;
    RadiusDesc by_column;
    by_column.rule = RadiusRule::Attribute;
    by_column.mapping.attribute = {"radius", context.contents};
    return mapped_radii(context, by_column, diagnostics);
  }
  if (has_elements) return element_radii(frame, *elements);
  if (context.usual_radius) return std::vector<double>(frame.count, *context.usual_radius);
  const data::Column* position = frame.find("position");
  const auto* values = position ? std::get_if<std::vector<double>>(&position->values) : nullptr;
  const std::optional<double> distance = values ? data::median_neighbor_distance(*values) : std::nullopt;
  return std::vector<double>(frame.count, distance ? 0.5 * *distance : lone_radius);
}

} // namespace mote
