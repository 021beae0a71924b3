// SPDX-License-Identifier: MIT
#include "core/color/srgb.hpp"
#include "core/data/elements.hpp"
#include "core/scene/attributes.hpp"
#include "core/scene/codes.hpp"
#include "core/scene/colormaps.hpp"
#include "core/scene/particle_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mote {
namespace {

constexpr std::uint32_t opaque = 0xFF000000u;

// 0xRRGGBB -> RGBA with R in the lowest byte
std::uint32_t pack(std::uint32_t rgb) { return (rgb >> 16 & 0xFFu) | (rgb & 0xFF00u) | (rgb & 0xFFu) << 16 | opaque; }
std::uint32_t pack(double r, double g, double b) {
  return std::uint32_t{to_8bit(r)} | std::uint32_t{to_8bit(g)} << 8 | std::uint32_t{to_8bit(b)} << 16 | opaque;
}

std::vector<std::uint32_t> element_colors(const data::TextColumn& text, const FrameOrigin& origin, Diagnostics& diagnostics) {
  std::vector<std::uint32_t> by_code, out;
  std::vector<std::string> unknown;
  for (const std::string& symbol : text.dictionary) {
    const data::Element* element = data::find_element(symbol);
    by_code.push_back(pack(element ? element->color : data::unknown_color));
    if (!element) unknown.push_back(symbol);
  }
  if (!unknown.empty())
    diagnostics.warning(code::element_unknown, origin.contents, fmt::format("no element is called {}: drawn in pink", list_of(unknown)));
  out.reserve(text.codes.size());
  for (std::uint32_t c : text.codes) out.push_back(by_code[c]);
  return out;
}

std::vector<std::uint32_t> type_colors(const Attribute& type, std::uint64_t rows) {
  std::vector<std::uint32_t> out(rows);
  const double first = type.is_text() ? 1.0 : 0.0; // kinds count from 0, types from 1
  for (std::uint64_t row = 0; row < rows; ++row) out[row] = pack(data::type_color(static_cast<std::int64_t>(type.at(row) + first)));
  return out;
}

// Three numbers per row, 0..1, or 0..255 when any is above 1.
std::vector<std::uint32_t> file_colors(const data::Column& color, std::uint64_t rows) {
  double largest = 0.0;
  for (std::uint64_t row = 0; row < rows; ++row)
    for (std::uint32_t k = 0; k < 3; ++k) largest = std::max(largest, color.number(row, k));
  const double scale = largest > 1.0 ? 1.0 / 255.0 : 1.0;
  std::vector<std::uint32_t> out(rows);
  for (std::uint64_t row = 0; row < rows; ++row)
    out[row] = pack(color.number(row, 0) * scale, color.number(row, 1) * scale, color.number(row, 2) * scale);
  return out;
}

std::vector<std::uint32_t> palette_colors(std::uint64_t rows) {
  std::array<std::uint32_t, 8> packed{};
  for (std::size_t i = 0; i < packed.size(); ++i)
    packed[i] = pack(generated_palette[i][0], generated_palette[i][1], generated_palette[i][2]);
  std::vector<std::uint32_t> out(rows);
  for (std::uint64_t row = 0; row < rows; ++row) out[row] = packed[row % packed.size()];
  return out;
}

// Kinds of things and whole numbers without a range take the entries of a categorical map in turn.
std::vector<std::uint32_t> category_colors(const Attribute& attribute, const ColorMap& map, std::uint64_t rows) {
  std::vector<std::uint32_t> out(rows);
  for (std::uint64_t row = 0; row < rows; ++row) out[row] = pack(map.category(static_cast<std::int64_t>(attribute.at(row))));
  return out;
}

std::vector<std::uint32_t> mapped_colors(const data::Frame& frame, const Mapping& mapping, const FrameOrigin& origin,
                                         Diagnostics& diagnostics) {
  const std::optional<Attribute> attribute = find_attribute(frame, mapping.attribute.value);
  ColorMap map;
  if (!attribute || !find_color_map(mapping.map.value, map)) { // the map was checked when the scene was read
    const std::vector<std::string> names = attribute_names(frame);
    diagnostics.error(code::attribute_missing, mapping.attribute.loc,
                      fmt::format("{} has no attribute '{}'", origin.name, mapping.attribute.value),
                      {did_you_mean(mapping.attribute.value, names), fmt::format("Attributes: {}", list_of(names))});
    return {};
  }
  if (map.categories && !mapping.range && (attribute->is_text() || attribute->is_whole()))
    return category_colors(*attribute, map, frame.count);
  if (attribute->is_text()) {
    diagnostics.error(code::attribute_is_text, mapping.attribute.loc,
                      fmt::format("the attribute '{}' of {} holds text; the map '{}' needs numbers", mapping.attribute.value,
                                  origin.name, mapping.map.value),
                      {"map = \"tab10\" gives each word a color of its own"});
    return {};
  }
  const auto [low, high] = mapping.range ? *mapping.range : finite_range(*attribute, frame.count).value_or(std::pair{0.0, 1.0});
  std::vector<std::uint32_t> out(frame.count);
  std::uint64_t skipped = 0;
  for (std::uint64_t row = 0; row < frame.count; ++row) {
    const double value = attribute->at(row);
    if (std::isnan(value)) ++skipped;
    out[row] = pack(std::isnan(value) ? not_a_number_color : map.at(high == low ? 0.0 : (value - low) / (high - low)));
  }
  if (skipped)
    diagnostics.warning(code::value_not_finite, origin.contents,
                        fmt::format("{} of {} particles have NaN as '{}': drawn in magenta", skipped, frame.count, mapping.attribute.value));
  return out;
}

} // namespace

ParticleColors particle_colors(const data::Frame& frame, const ColorDesc& rule, bool generated, const FrameOrigin& origin,
                               Diagnostics& diagnostics) {
  const data::Column* element = frame.find("element");
  const auto* symbols = element ? std::get_if<data::TextColumn>(&element->values) : nullptr;
  switch (rule.rule) {
  case ColorRule::Constant: return {{}, rule.constant};
  case ColorRule::Mapped: return {mapped_colors(frame, rule.mapping, origin, diagnostics)};
  case ColorRule::Element:
    if (symbols) return {element_colors(*symbols, origin, diagnostics)};
    diagnostics.error(code::element_missing, rule.loc, fmt::format("{} has no elements to color by", origin.name),
                      {fmt::format("Attributes: {}", list_of(attribute_names(frame)))});
    return {};
  case ColorRule::Auto: break;
  }
  if (generated) return {palette_colors(frame.count)};
  if (const data::Column* color = frame.find("color"); color && color->components >= 3) return {file_colors(*color, frame.count)};
  if (symbols) return {element_colors(*symbols, origin, diagnostics)};
  if (const auto type = find_attribute(frame, "type")) return {type_colors(*type, frame.count)};
  return {};
}

} // namespace mote
