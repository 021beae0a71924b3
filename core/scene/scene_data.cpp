// SPDX-License-Identifier: MIT
// One [[data]] table of a scene file: files, type, selection, style, cell, material, transform. Colors, radii and
// opacities are in scene_mapping.cpp.
#include "core/scene/glyphs.hpp"
#include "core/scene/scene_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote::scene_parser {
namespace {

using config::Kind;
using config::Node;
using config::TableReader;

const std::vector<std::string> shading_models{"lambert", "phong", "blinn_phong"}; // order of ShadingModel

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

// A file name or a list of them; relative ones are relative to `folder`. Empty after an error.
std::vector<std::filesystem::path> read_files(TableReader& reader, std::string_view key, const std::filesystem::path& folder) {
  const Node* node = reader.find(key);
  if (!node) return {};
  std::vector<const Node*> items{node};
  if (node->kind == Kind::Array) {
    items.clear();
    for (const Node& item : node->items) items.push_back(&item);
  }
  std::vector<std::filesystem::path> files;
  for (const Node* item : items) {
    if (item->kind != Kind::Text) {
      reader.wrong_type(*item, key, "a file name, or a list of file names");
      return {};
    }
    if (item->text.empty()) {
      reader.diagnostics().error(code::scene_out_of_range, item->loc, reader.name_of(key) + " is empty");
      return {};
    }
    const std::filesystem::path path(item->text);
    files.push_back(path.is_absolute() || folder.empty() ? path : folder / path);
  }
  if (files.empty()) reader.diagnostics().error(code::scene_out_of_range, node->loc, reader.name_of(key) + " is empty");
  return files;
}

void read_file(TableReader& reader, const std::filesystem::path& folder, DataDesc& data) {
  const Node* node = reader.find("file");
  if (!node) reader.missing("file", "a particle file, relative to the scene file");
  const std::vector<std::filesystem::path> files = read_files(reader, "file", folder);
  data.trajectory = read_files(reader, "trajectory", folder);
  if (files.empty()) return;
  data.file = {files[0], node->loc};
  data.further.assign(files.begin() + 1, files.end());
}

// Opacities of single particles are factors of it.
void read_density(TableReader& reader, DataDesc& data) {
  const auto density = reader.number("density", config::positive);
  if (!density) return;
  if (reader.find("alpha") && data.opacity.rule == AlphaRule::Constant)
    reader.diagnostics().error(code::key_not_of_kind, reader.find("density")->loc, reader.name_of("density") + " and alpha both say how much light passes; one of them is enough");
  data.density = *density;
  data.alpha = 0.5;
}

const std::vector<std::string> styles{"spacefill", "ball_and_stick", "licorice"}; // order of MoleculeStyle, behind None

void read_style(TableReader& reader, DataDesc& data) {
  const auto style = reader.word("style", styles);
  if (!style) return;
  data.style = static_cast<MoleculeStyle>(*style + 1);
  if (data.type != "sphere")
    reader.diagnostics().error(code::key_not_of_kind, reader.find("style")->loc, fmt::format("{} is for spheres; the type is '{}'", reader.name_of("style"), data.type));
  data.radius_by_style = data.radius.rule == RadiusRule::Auto;
  if (data.style != MoleculeStyle::Spacefill) data.bond_radius = reader.number("bond_radius", config::positive);
  if (data.radius_by_style && data.style != MoleculeStyle::Licorice) data.radius = {RadiusRule::Element, 0.0, {}, reader.find("style")->loc};
  if (data.color.rule == ColorRule::Auto) data.color = {ColorRule::Element, glm::dvec3(0), {}, reader.find("style")->loc};
}

// cell = true, or { color = "#404040", width = 2 }
void read_cell(TableReader& outer, bool linear, DataDesc& data) {
  const Node* node = outer.find("cell");
  if (!node) return;
  if (node->kind == Kind::Boolean) {
    data.cell.drawn = node->boolean;
    return;
  }
  if (node->kind != Kind::Table) {
    outer.wrong_type(*node, "cell", "true, false, or { color, width }");
    return;
  }
  TableReader reader(*node, outer.name_of("cell"), reader_codes, outer.diagnostics());
  data.cell.drawn = true;
  if (const auto color = read_color(reader, "color", linear)) data.cell.color = glm::dvec3(*color);
  data.cell.width = reader.number("width", config::positive).value_or(0.0);
  reader.finish();
}

const std::vector<std::string> wrappings{"wrap", "unwrap"};

void read_periodicity(TableReader& reader, DataDesc& data) {
  if (const auto word = reader.word("periodic", wrappings)) data.wrapping = *word == 0 ? Wrapping::Wrap : Wrapping::Unwrap;
  const auto counts = reader.numbers<3>("replicas", {1.0, 1000.0});
  if (!counts) return;
  for (int k = 0; k < 3; ++k) {
    const double n = (*counts)[static_cast<std::size_t>(k)];
    if (n != std::floor(n))
      reader.diagnostics().error(code::scene_out_of_range, reader.find("replicas")->loc, reader.name_of("replicas") + " takes three whole numbers");
    data.replicas[k] = static_cast<int>(n);
  }
}

void read_type(TableReader& reader, std::span<const std::shared_ptr<UserType>> types, DataDesc& data) {
  std::vector<std::string> names = scene_particle_types();
  for (const auto& type : types) names.push_back(type->name);
  const auto type = reader.word("type", names);
  if (!type) return;
  data.type = names[*type];
  if (*type >= scene_particle_types().size()) data.user = types[*type - scene_particle_types().size()];
}

} // namespace

std::vector<std::shared_ptr<UserType>> read_types(TableReader& top, const std::filesystem::path& folder) {
  std::vector<std::shared_ptr<UserType>> types;
  const Node* list = top.find("particle_types");
  if (!list) return types;
  if (list->kind != Kind::Array) {
    top.wrong_type(*list, "particle_types", "a list of folders");
    return types;
  }
  for (const Node& item : list->items) {
    if (item.kind != Kind::Text || item.text.empty()) {
      top.wrong_type(item, "particle_types", "a list of folders");
      continue;
    }
    const std::filesystem::path path(item.text);
    std::shared_ptr<UserType> type = read_user_type(path.is_absolute() || folder.empty() ? path : folder / path, item.loc, top.diagnostics());
    if (!type) continue;
    const auto same = [&](const auto& known) { return known->name == type->name; };
    if (std::none_of(types.begin(), types.end(), same)) types.push_back(std::move(type));
    else if (std::any_of(types.begin(), types.end(), [&](const auto& known) { return same(known) && known->glsl != type->glsl; }))
      top.diagnostics().error(code::user_type, item.loc, fmt::format("two particle types are called '{}'", type->name));
  }
  return types;
}

DataDesc read_data(const Node& table, std::size_t index, const std::filesystem::path& folder, bool inherited_linear,
                   std::span<const std::shared_ptr<UserType>> types, Diagnostics& diagnostics) {
  TableReader reader(table, fmt::format("data[{}]", index), reader_codes, diagnostics);
  DataDesc data;
  data.loc = table.loc;
  read_file(reader, folder, data);
  read_type(reader, types, data);
  const bool linear = read_color_space(reader, inherited_linear);
  data.radius = read_radius(reader);
  read_shape(reader, data);
  data.color = read_particle_color(reader, linear);
  data.opacity = read_opacity(reader, data.alpha);
  read_density(reader, data);
  if (const auto select = reader.text("select")) data.select = Located<std::string>{*select, reader.find("select")->loc};
  read_style(reader, data);
  read_periodicity(reader, data);
  read_cell(reader, linear, data);
  data.material = read_material(reader);
  data.transform = read_transform(reader, "transform");
  if (const auto assembly = reader.text("assembly")) data.assembly = Located<std::string>{*assembly, reader.find("assembly")->loc};
  reader.finish();
  return data;
}

} // namespace mote::scene_parser
