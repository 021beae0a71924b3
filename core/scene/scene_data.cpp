// SPDX-License-Identifier: MIT
// One [[data]] table of a scene file: file, type, radius, color, material, transform.
#include "core/scene/colormaps.hpp"
#include "core/scene/scene_parser.hpp"

#include <fmt/format.h>

namespace mote::scene_parser {
namespace {

using config::Kind;
using config::Node;
using config::TableReader;

const std::vector<std::string> particle_types{"sphere"};
const std::vector<std::string> shading_models{"lambert", "phong", "blinn_phong"}; // order of ShadingModel
const std::vector<std::string> radius_maps{"linear"};

Located<std::string> located_text(TableReader& reader, std::string_view key) {
  const Node* node = reader.find(key);
  return {reader.text(key).value_or(""), node ? node->loc : reader.node().loc};
}

// "auto" or [low, high]; nothing means "auto".
std::optional<std::pair<double, double>> read_range(TableReader& reader) {
  const Node* node = reader.find("range");
  if (!node || (node->kind == Kind::Text && node->text == "auto")) return std::nullopt;
  if (node->kind == Kind::Text) {
    reader.wrong_type(*node, "range", "\"auto\" or [low, high]");
    return std::nullopt;
  }
  const auto ends = reader.numbers<2>("range");
  if (!ends) return std::nullopt;
  if ((*ends)[0] == (*ends)[1])
    reader.diagnostics().error(code::scene_out_of_range, node->loc,
                               fmt::format("{} is '{}': its ends must differ", reader.name_of("range"), config::to_text(*node)));
  return std::pair{(*ends)[0], (*ends)[1]};
}

RadiusDesc read_radius_table(const Node& node, const std::string& path, Diagnostics& diagnostics) {
  TableReader reader(node, path, reader_codes, diagnostics);
  RadiusDesc radius{RadiusRule::Mapped, 0.0, {}, node.loc};
  radius.mapping.attribute = located_text(reader, "attribute");
  if (!reader.find("attribute")) reader.missing("attribute", "which column of the file gives the values");
  if (reader.find("map")) (void)reader.word("map", radius_maps);
  radius.mapping.map.value = "linear";
  radius.mapping.range = read_range(reader);
  const auto to = reader.numbers<2>("to", config::not_negative);
  if (!reader.find("to")) reader.missing("to", "the radii at both ends of the range, to = [0.2, 0.6]");
  if (to) radius.mapping.to = {(*to)[0], (*to)[1]};
  reader.finish();
  return radius;
}

RadiusDesc read_radius(TableReader& reader) {
  const Node* node = reader.find("radius");
  if (!node) return {};
  if (node->kind == Kind::Text) {
    RadiusDesc radius{RadiusRule::Attribute, 0.0, {}, node->loc};
    radius.mapping.attribute = {node->text, node->loc};
    return radius;
  }
  if (node->kind == Kind::Table) return read_radius_table(*node, reader.name_of("radius"), reader.diagnostics());
  if (node->kind != Kind::Integer && node->kind != Kind::Real) {
    reader.wrong_type(*node, "radius", "a number, an attribute's name, or { attribute, map, range, to }");
    return {};
  }
  const auto number = reader.as_number(*node, "radius", config::positive);
  return number ? RadiusDesc{RadiusRule::Constant, *number, {}, node->loc} : RadiusDesc{};
}

ColorDesc read_color_table(const Node& node, const std::string& path, Diagnostics& diagnostics) {
  TableReader reader(node, path, reader_codes, diagnostics);
  ColorDesc color{ColorRule::Mapped, glm::dvec3(0), {}, node.loc};
  color.mapping.attribute = located_text(reader, "attribute");
  if (!reader.find("attribute")) reader.missing("attribute", "which column of the file gives the values");
  color.mapping.map = located_text(reader, "map");
  if (color.mapping.map.value.empty()) color.mapping.map.value = "viridis";
  ColorMap map;
  if (!find_color_map(color.mapping.map.value, map)) {
    const std::vector<std::string> names = color_map_names();
    diagnostics.error(code::scene_unknown_word, color.mapping.map.loc,
                      fmt::format("there is no color map '{}'", color.mapping.map.value),
                      {did_you_mean(color.mapping.map.value, names),
                       fmt::format("Color maps: {}; with _r behind the name reversed", list_of(names))});
  }
  color.mapping.range = read_range(reader);
  reader.finish();
  return color;
}

ColorDesc read_particle_color(TableReader& reader, bool linear) {
  const Node* node = reader.find("color");
  if (!node) return {};
  if (node->kind == Kind::Table) return read_color_table(*node, reader.name_of("color"), reader.diagnostics());
  if (node->kind == Kind::Text && node->text == "element") return {ColorRule::Element, glm::dvec3(0), {}, node->loc};
  const auto constant = as_color(reader, *node, "color", linear);
  return constant ? ColorDesc{ColorRule::Constant, glm::dvec3(*constant), {}, node->loc} : ColorDesc{};
}

Material read_material(TableReader& outer) {
  Material material;
  const Node* node = outer.table("material");
  if (!node) return material;
  TableReader reader(*node, outer.name_of("material"), reader_codes, outer.diagnostics());
  if (const auto model = reader.word("model", shading_models)) material.model = static_cast<ShadingModel>(*model);
  auto number = [&](std::string_view key, double& out) {
    if (const auto value = reader.number(key, config::not_negative)) out = *value;
  };
  number("ambient", material.ambient);
  number("diffuse", material.diffuse);
  number("specular", material.specular);
  number("exponent", material.exponent);
  reader.finish();
  return material;
}

void read_file(TableReader& reader, const std::filesystem::path& folder, DataDesc& data) {
  const Node* node = reader.find("file");
  const auto text = reader.text("file");
  if (!node) reader.missing("file", "a particle file, relative to the scene file");
  if (!text) return;
  if (text->empty()) {
    reader.diagnostics().error(code::scene_out_of_range, node->loc, reader.name_of("file") + " is empty");
    return;
  }
  const std::filesystem::path path(*text);
  data.file = {path.is_absolute() ? path : folder / path, node->loc};
}

} // namespace

DataDesc read_data(const Node& table, std::size_t index, const std::filesystem::path& folder, bool inherited_linear,
                   Diagnostics& diagnostics) {
  TableReader reader(table, fmt::format("data[{}]", index), reader_codes, diagnostics);
  DataDesc data;
  data.loc = table.loc;
  read_file(reader, folder, data);
  (void)reader.word("type", particle_types);
  const bool linear = read_color_space(reader, inherited_linear);
  data.radius = read_radius(reader);
  data.color = read_particle_color(reader, linear);
  data.alpha = reader.number("alpha", config::unit).value_or(1.0);
  data.material = read_material(reader);
  data.transform = read_transform(reader, "transform");
  if (const auto assembly = reader.text("assembly")) data.assembly = Located<std::string>{*assembly, reader.find("assembly")->loc};
  reader.finish();
  return data;
}

} // namespace mote::scene_parser
