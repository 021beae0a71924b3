// SPDX-License-Identifier: MIT
#include "core/color/srgb.hpp"
#include "core/data/elements.hpp"
#include "core/scene/attributes.hpp"
#include "core/scene/codes.hpp"
#include "core/scene/colormap_files.hpp"
#include "core/scene/colormaps.hpp"
#include "core/scene/particle_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace mote {
namespace {

constexpr std::uint32_t opaque = 0xFF000000u;

// 0xRRGGBB -> RGBA with R in the lowest byte
std::uint32_t pack(std::uint32_t rgb) { return (rgb >> 16 & 0xFFu) | (rgb & 0xFF00u) | (rgb & 0xFFu) << 16 | opaque; }
std::uint32_t pack(double r, double g, double b) {
  return std::uint32_t{to_8bit(r)} | std::uint32_t{to_8bit(g)} << 8 | std::uint32_t{to_8bit(b)} << 16 | opaque;
}

std::vector<std::uint32_t> element_colors(const data::TextColumn& text, const FrameContext& context, Diagnostics& diagnostics) {
  std::vector<std::uint32_t> by_code, out;
  std::vector<std::string> unknown;
  for (const std::string& symbol : text.dictionary) {
    const data::Element* element = data::find_element(symbol);
    by_code.push_back(pack(element ? element->color : data::unknown_color));
    if (!element) unknown.push_back(symbol);
  }
  if (!unknown.empty())
    diagnostics.warning(code::element_unknown, context.contents, fmt::format("no element is called {}: drawn in pink", list_of(unknown)));
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

// A color map as a mapping names it: a shipped one, or a file.
struct ChosenMap {
  ColorMap map{};
  ColorMapFile file{};
};
std::optional<ChosenMap> choose_map(const FrameContext& context, const Mapping& mapping, Diagnostics& diagnostics) {
  ChosenMap chosen;
  std::string name = mapping.map.value;
  if (!is_color_map_file(name)) {
    if (find_color_map(name, chosen.map)) return chosen; // checked when the scene was read
    return std::nullopt;
  }
  if (name.ends_with("_r")) {
    name.resize(name.size() - 2);
    chosen.map.reversed = true;
  }
  try {
    chosen.file = read_color_map(context.folder / name, mapping.map.loc);
  } catch (const Failure& failure) {
    diagnostics.add(failure.diagnostic());
    return std::nullopt;
  }
  chosen.map.entries = chosen.file.entries;
  chosen.map.categories = chosen.file.categories;
  return chosen;
}

// The number of each kind: words in the order of the series, whole numbers as they are.
class Kinds {
public:
  Kinds(const FrameContext& context, const Mapping& mapping, const Attribute& attribute) : attribute_(attribute) {
    if (!attribute.is_text()) return;
    words_ = context.series ? context.series->words(mapping.attribute.value) : std::vector<std::string>{};
    const auto& text = std::get<data::TextColumn>(attribute.column->values);
    for (const std::string& word : text.dictionary) {
      const auto found = std::find(words_.begin(), words_.end(), word);
      by_code_.push_back(found - words_.begin());
      if (found == words_.end()) words_.push_back(word);
    }
  }
  [[nodiscard]] std::int64_t at(std::uint64_t row) const {
    const double value = attribute_.at(row);
    return attribute_.is_text() ? by_code_[static_cast<std::size_t>(value)] : static_cast<std::int64_t>(value);
  }
  [[nodiscard]] std::string name(std::int64_t kind) const { return attribute_.is_text() ? words_[static_cast<std::size_t>(kind)] : fmt::format("{}", kind); }

private:
  Attribute attribute_;
  std::vector<std::string> words_{};
  std::vector<std::int64_t> by_code_{};
};

constexpr std::size_t most_names = 24; // in a legend

// Kinds of things and whole numbers without a range take the entries of a categorical map in turn, or colors of their own.
ParticleColors category_colors(const FrameContext& context, const Mapping& mapping, const Attribute& attribute, const ColorMap& map) {
  const Kinds kinds(context, mapping, attribute);
  ParticleColors out;
  out.packed.resize(context.frame.count);
  std::map<std::int64_t, std::uint32_t> colors;
  for (std::uint64_t row = 0; row < context.frame.count; ++row) {
    const std::int64_t kind = kinds.at(row);
    auto [entry, fresh] = colors.try_emplace(kind, 0u);
    if (fresh) {
      const std::string name = kinds.name(kind);
      const auto own = std::find_if(mapping.categories.begin(), mapping.categories.end(), [&](const auto& c) { return c.first == name; });
      entry->second = own != mapping.categories.end() ? own->second : map.entries.empty() ? 0xccccccu : map.category(kind);
    }
    out.packed[row] = pack(entry->second);
  }
  ColorKey key;
  for (const auto& [kind, color] : colors) {
    if (key.names.size() == most_names) break;
    key.names.push_back(kinds.name(kind));
    key.colors.push_back(color);
  }
  if (key.names.size() < colors.size()) key.names.back() = fmt::format("{} more", colors.size() - most_names + 1);
  out.key = std::move(key);
  return out;
}

std::uint32_t color_of(double t, const ColorMap& map, const Mapping& mapping, const ColorMapFile& file) {
  if (std::isnan(t)) return mapping.nan.value_or(file.nan.value_or(not_a_number_color));
  if (t < 0.0 && (mapping.below || file.below)) return mapping.below ? *mapping.below : *file.below;
  if (t > 1.0 && (mapping.above || file.above)) return mapping.above ? *mapping.above : *file.above;
  return map.at(std::clamp(t, 0.0, 1.0));
}

ParticleColors scale_colors(const FrameContext& context, const Mapping& mapping, const Attribute& attribute, const ChosenMap& chosen,
                            Diagnostics& diagnostics) {
  const ValueScale scale = value_scale(context, mapping, attribute, diagnostics);
  ParticleColors out;
  out.packed.resize(context.frame.count);
  std::uint64_t skipped = 0;
  for (std::uint64_t row = 0; row < context.frame.count; ++row) {
    const double t = scale(attribute.at(row));
    if (std::isnan(t) && (context.rows.empty() || context.rows[row])) ++skipped;
    out.packed[row] = pack(color_of(t, chosen.map, mapping, chosen.file));
  }
  ColorKey key;
  key.low = scale.low;
  key.high = scale.high;
  key.logarithmic = scale.logarithmic;
  const std::size_t entries = chosen.map.entries.size();
  for (std::size_t i = 0; i < entries; ++i) key.colors.push_back(chosen.map.entries[chosen.map.reversed ? entries - 1 - i : i]);
  key.below = mapping.below ? mapping.below : chosen.file.below;
  key.above = mapping.above ? mapping.above : chosen.file.above;
  if (skipped) {
    key.nan = color_of(std::numeric_limits<double>::quiet_NaN(), chosen.map, mapping, chosen.file);
    const std::string drawn = *key.nan == not_a_number_color ? "magenta" : fmt::format("#{:06x}", *key.nan);
    diagnostics.warning(code::value_not_finite, context.contents,
                        fmt::format("{} of {} particles have NaN as '{}': drawn in {}", skipped, context.frame.count, mapping.attribute.value, drawn));
  }
  out.key = std::move(key);
  return out;
}

ParticleColors mapped_colors(const FrameContext& context, const Mapping& mapping, Diagnostics& diagnostics) {
  const std::optional<Attribute> attribute = wanted_attribute(context, mapping.attribute, false, diagnostics);
  const std::optional<ChosenMap> chosen = choose_map(context, mapping, diagnostics);
  if (!attribute || !chosen) return {};
  const bool kinds = (chosen->map.categories && mapping.rule == RangeRule::Series) || !mapping.categories.empty();
  ParticleColors out;
  if (kinds && (attribute->is_text() || attribute->is_whole())) {
    out = category_colors(context, mapping, *attribute, chosen->map);
  } else if (attribute->is_text()) {
    diagnostics.error(code::attribute_is_text, mapping.attribute.loc,
                      fmt::format("the attribute '{}' of {} holds text; the map '{}' needs numbers", mapping.attribute.value,
                                  context.name, mapping.map.value),
                      {"map = \"tab10\" gives each word a color of its own"});
    return {};
  } else {
    out = scale_colors(context, mapping, *attribute, *chosen, diagnostics);
  }
  out.key->title = mapping.title.value_or(mapping.attribute.value);
  out.key->unit = mapping.unit.value_or(attribute->column->unit == "wxyz" ? "" : attribute->column->unit);
  return out;
}

} // namespace

ParticleColors particle_colors(const FrameContext& context, const ColorDesc& rule, bool generated, Diagnostics& diagnostics) {
  const data::Frame& frame = context.frame;
  const data::Column* element = frame.find("element");
  const auto* symbols = element ? std::get_if<data::TextColumn>(&element->values) : nullptr;
  const std::optional<Attribute> type = find_attribute(frame, "type");
  switch (rule.rule) {
  case ColorRule::Constant: return {{}, rule.constant, {}};
  case ColorRule::Mapped: return mapped_colors(context, rule.mapping, diagnostics);
  case ColorRule::Element:
  case ColorRule::Type:
    if (rule.rule == ColorRule::Element && symbols) return {element_colors(*symbols, context, diagnostics), {}, {}};
    if (rule.rule == ColorRule::Type && type) return {type_colors(*type, frame.count), {}, {}};
    diagnostics.error(code::element_missing, rule.loc,
                      fmt::format("{} has no {} to color by", context.name, rule.rule == ColorRule::Element ? "elements" : "types"),
                      {fmt::format("Attributes: {}", list_of(attribute_names(frame)))});
    return {};
  case ColorRule::Auto: break;
  }
  if (generated) return {palette_colors(frame.count), {}, {}};
  if (const data::Column* color = frame.find("color"); color && color->components >= 3) return {file_colors(*color, frame.count), {}, {}};
  if (symbols) return {element_colors(*symbols, context, diagnostics), {}, {}};
  if (type) return {type_colors(*type, frame.count), {}, {}};
  return {};
}

} // namespace mote
