// SPDX-License-Identifier: MIT
// Mappings of a scene file: { attribute, map, range, scale, ... } for colors, radii and opacities; and the legend.
#include "core/color/parse_color.hpp"
#include "core/color/srgb.hpp"
#include "core/scene/colormap_files.hpp"
#include "core/scene/colormaps.hpp"
#include "core/scene/scene_parser.hpp"

#include <fmt/format.h>

namespace mote::scene_parser {
namespace {

using config::Kind;
using config::Node;
using config::TableReader;

const std::vector<std::string> number_maps{"linear", "log"};
const std::vector<std::string> scales{"linear", "log"};
const std::vector<std::string> places{"right", "left"}; // order of LegendPlace

Located<std::string> located_text(TableReader& reader, std::string_view key) {
  const Node* node = reader.find(key);
  return {reader.text(key).value_or(""), node ? node->loc : reader.node().loc};
}

void bad_range(TableReader& reader, const Node& node, std::string_view why) {
  reader.diagnostics().error(code::scene_out_of_range, node.loc,
                             fmt::format("{} is '{}': {}", reader.name_of("range"), config::to_text(node), why));
}

// { percentile = [2, 98] }
void read_percentile(TableReader& outer, const Node& node, Mapping& mapping) {
  TableReader reader(node, outer.name_of("range"), reader_codes, outer.diagnostics());
  const auto ends = reader.numbers<2>("percentile", {0.0, 100.0});
  if (!reader.find("percentile")) reader.missing("percentile", "range = { percentile = [2, 98] }");
  reader.finish();
  if (!ends) return;
  if ((*ends)[0] == (*ends)[1]) bad_range(outer, node, "its ends must differ");
  mapping.rule = RangeRule::Percentile;
  mapping.range = std::pair{(*ends)[0], (*ends)[1]};
}

// "auto", "frame", "symmetric", [low, high] or { percentile = [a, b] }
void read_range(TableReader& reader, Mapping& mapping) {
  const Node* node = reader.find("range");
  if (!node) return;
  if (node->kind == Kind::Table) return read_percentile(reader, *node, mapping);
  if (node->kind == Kind::Text) {
    if (node->text == "auto") mapping.rule = RangeRule::Series;
    else if (node->text == "frame") mapping.rule = RangeRule::Frame;
    else if (node->text == "symmetric") mapping.rule = RangeRule::Symmetric;
    else reader.wrong_type(*node, "range", "\"auto\" or [low, high], \"frame\", \"symmetric\", or { percentile = [low, high] }");
    return;
  }
  const auto ends = reader.numbers<2>("range");
  if (!ends) return;
  if ((*ends)[0] == (*ends)[1]) bad_range(reader, *node, "its ends must differ");
  mapping.rule = RangeRule::Fixed;
  mapping.range = std::pair{(*ends)[0], (*ends)[1]};
}

// What all mappings have: attribute, range, scale.
void read_mapping(TableReader& reader, Mapping& mapping) {
  mapping.attribute = located_text(reader, "attribute");
  if (!reader.find("attribute")) reader.missing("attribute", "which column of the file gives the values");
  read_range(reader, mapping);
  if (const auto scale = reader.word("scale", scales)) mapping.logarithmic = *scale == 1;
  if (!mapping.logarithmic) return;
  if (mapping.rule == RangeRule::Symmetric) bad_range(reader, *reader.find("range"), "a logarithm has no values around zero");
  if (mapping.rule == RangeRule::Fixed && !(mapping.range->first > 0.0 && mapping.range->second > 0.0))
    bad_range(reader, *reader.find("range"), "the ends of a logarithmic range are above 0");
}

// `to` and the older spelling map = "linear".
void read_to(TableReader& reader, Mapping& mapping, const config::Range& bounds, std::string_view example) {
  if (const auto map = reader.find("map") ? reader.word("map", number_maps) : std::nullopt; map && *map == 1) mapping.logarithmic = true;
  mapping.map.value = "linear";
  const auto to = reader.numbers<2>("to", bounds);
  if (!reader.find("to")) reader.missing("to", example);
  if (to) mapping.to = {(*to)[0], (*to)[1]};
}

RadiusDesc read_radius_table(const Node& node, const std::string& path, Diagnostics& diagnostics) {
  TableReader reader(node, path, reader_codes, diagnostics);
  RadiusDesc radius{RadiusRule::Mapped, 0.0, {}, node.loc};
  read_mapping(reader, radius.mapping);
  read_to(reader, radius.mapping, config::not_negative, "the radii at both ends of the range, to = [0.2, 0.6]");
  reader.finish();
  return radius;
}

void check_map(const Mapping& mapping, Diagnostics& diagnostics) {
  ColorMap map;
  if (is_color_map_file(mapping.map.value) || find_color_map(mapping.map.value, map)) return;
  const std::vector<std::string> names = color_map_names();
  diagnostics.error(code::scene_unknown_word, mapping.map.loc, fmt::format("there is no color map '{}'", mapping.map.value),
                    {did_you_mean(mapping.map.value, names),
                     fmt::format("Color maps: {}; with _r behind the name reversed; a file when it has a '.' or '/'", list_of(names))});
}

// colors = { O = "#ff0000", H = "#ffffff" }
void read_categories(TableReader& outer, Mapping& mapping) {
  const Node* table = outer.table("colors");
  if (!table) return;
  TableReader reader(*table, outer.name_of("colors"), reader_codes, outer.diagnostics());
  for (const config::Member& member : table->members)
    if (const auto color = read_encoded_color(reader, member.key)) mapping.categories.emplace_back(member.key, *color);
  reader.finish();
}

ColorDesc read_color_table(const Node& node, const std::string& path, Diagnostics& diagnostics) {
  TableReader reader(node, path, reader_codes, diagnostics);
  ColorDesc color{ColorRule::Mapped, glm::dvec3(0), {}, node.loc};
  Mapping& mapping = color.mapping;
  read_mapping(reader, mapping);
  read_categories(reader, mapping);
  mapping.map = located_text(reader, "map");
  if (mapping.map.value.empty()) mapping.map.value = mapping.categories.empty() ? "viridis" : "tab10";
  check_map(mapping, diagnostics);
  mapping.below = read_encoded_color(reader, "below");
  mapping.above = read_encoded_color(reader, "above");
  mapping.nan = read_encoded_color(reader, "nan");
  mapping.title = reader.text("title");
  mapping.unit = reader.text("unit");
  reader.finish();
  return color;
}

} // namespace

std::optional<std::uint32_t> read_encoded_color(TableReader& reader, std::string_view key) {
  const auto color = read_color(reader, key, false);
  if (!color) return std::nullopt;
  std::uint32_t packed = 0;
  for (int k = 0; k < 3; ++k) packed = packed << 8 | std::uint32_t{to_8bit(srgb_encode((*color)[k]))};
  return packed;
}

RadiusDesc read_radius(TableReader& reader, std::string_view key) {
  const Node* node = reader.find(key);
  if (!node) return {};
  if (node->kind == Kind::Text) {
    if (node->text == "element" && key == "radius") return {RadiusRule::Element, 0.0, {}, node->loc};
    RadiusDesc radius{RadiusRule::Attribute, 0.0, {}, node->loc};
    radius.mapping.attribute = {node->text, node->loc};
    return radius;
  }
  if (node->kind == Kind::Table) return read_radius_table(*node, reader.name_of(key), reader.diagnostics());
  if (node->kind != Kind::Integer && node->kind != Kind::Real) {
    reader.wrong_type(*node, key, key == "radius" ? "a number, an attribute's name, \"element\", or { attribute, range, to }" : "a number, an attribute's name, or { attribute, range, to }");
    return {};
  }
  const auto number = reader.as_number(*node, key, key == "radius_end" ? config::not_negative : config::positive);
  return number ? RadiusDesc{RadiusRule::Constant, *number, {}, node->loc} : RadiusDesc{};
}

ColorDesc read_particle_color(TableReader& reader, bool linear) {
  const Node* node = reader.find("color");
  if (!node) return {};
  if (node->kind == Kind::Table) return read_color_table(*node, reader.name_of("color"), reader.diagnostics());
  if (node->kind == Kind::Text && node->text == "element") return {ColorRule::Element, glm::dvec3(0), {}, node->loc};
  if (node->kind == Kind::Text && node->text == "type") return {ColorRule::Type, glm::dvec3(0), {}, node->loc};
  const auto constant = as_color(reader, *node, "color", linear);
  return constant ? ColorDesc{ColorRule::Constant, glm::dvec3(*constant), {}, node->loc} : ColorDesc{};
}

AlphaDesc read_opacity(TableReader& reader, double& alpha) {
  const Node* node = reader.find("alpha");
  if (!node) return {};
  AlphaDesc opacity;
  opacity.loc = node->loc;
  if (node->kind == Kind::Text) {
    opacity.rule = AlphaRule::Attribute;
    opacity.mapping.attribute = {node->text, node->loc};
  } else if (node->kind == Kind::Table) {
    TableReader table(*node, reader.name_of("alpha"), reader_codes, reader.diagnostics());
    opacity.rule = AlphaRule::Mapped;
    read_mapping(table, opacity.mapping);
    read_to(table, opacity.mapping, config::unit, "the opacities at both ends of the range, to = [0.1, 1]");
    table.finish();
  } else {
    alpha = reader.number("alpha", config::unit).value_or(1.0);
  }
  return opacity;
}

LegendDesc read_legend(TableReader& top) {
  LegendDesc legend;
  const Node* node = top.find("legend");
  if (!node) return legend;
  if (node->kind == Kind::Boolean) {
    legend.shown = node->boolean;
    if (!node->boolean) legend.scale_bar = legend.time = false;
    return legend;
  }
  if (node->kind != Kind::Table) {
    top.wrong_type(*node, "legend", "true, false, or a table");
    return legend;
  }
  TableReader reader(*node, "legend", reader_codes, top.diagnostics());
  legend.shown = reader.boolean("show").value_or(true);
  legend.scale_bar = reader.boolean("scale_bar");
  legend.time = reader.boolean("time");
  if (const auto place = reader.word("place", places)) legend.place = static_cast<LegendPlace>(*place);
  legend.size = reader.number("size", {0.1, 10.0}).value_or(1.0);
  legend.unit = reader.text("unit");
  reader.finish();
  return legend;
}

} // namespace mote::scene_parser
