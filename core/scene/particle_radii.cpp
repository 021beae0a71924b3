// SPDX-License-Identifier: MIT
#include "core/data/elements.hpp"
#include "core/data/neighbors.hpp"
#include "core/scene/attributes.hpp"
#include "core/scene/codes.hpp"
#include "core/scene/particle_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

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

// The diagonal of the box that holds the middle eight tenths of the particles along each axis, by 1024 of them spread evenly over
// the data: what a few stray ones do not change.
double usual_extent(std::span<const double> positions) {
  const std::size_t count = positions.size() / 3, step = std::max<std::size_t>(1, count / 1024);
  double squares = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> places;
    for (std::size_t i = 0; i < count; i += step)
      if (std::isfinite(positions[3 * i + axis])) places.push_back(positions[3 * i + axis]);
    if (places.empty()) continue;
    std::sort(places.begin(), places.end());
    const double width = places[places.size() - 1 - places.size() / 10] - places[places.size() / 10];
    squares += width * width;
  }
  return std::sqrt(squares);
}

// Of particles without one: half the median distance of nearest neighbors, and at least a thousandth of their extent, so that
// dense lines of points show.
double guessed_radius(std::span<const double> positions) {
  const std::optional<double> distance = data::median_neighbor_distance(positions);
  return distance ? std::max(0.5 * *distance, 1e-3 * usual_extent(positions)) : lone_radius;
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
  return std::vector<double>(frame.count, values ? guessed_radius(*values) : lone_radius);
}

} // namespace mote
