// SPDX-License-Identifier: MIT
#include "core/scene/user_type.hpp"

#include "core/scene/codes.hpp"
#include "core/scene/glyphs.hpp"
#include "core/scene/scene_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace mote {
namespace {

using config::Kind;
using config::Node;
using config::TableReader;

std::optional<std::string> text_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  return std::string{std::istreambuf_iterator<char>(stream), {}};
}

bool is_name(std::string_view word) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; };
  return !word.empty() && letter(word[0]) && std::all_of(word.begin(), word.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

const std::vector<std::string> units{"length", "none"};

std::optional<UserAttribute> read_attribute(const Node& node, const std::string& name, Diagnostics& diagnostics) {
  TableReader reader(node, "attributes." + name, scene_parser::reader_codes, diagnostics);
  UserAttribute a{.name = name};
  a.otherwise = reader.number("default");
  a.length = reader.word("unit", units).value_or(0) == 0;
  reader.finish();
  if (is_name(name)) return a;
  diagnostics.error(code::user_type, node.loc, fmt::format("'{}' is no name for an attribute: small letters, digits and _", name));
  return std::nullopt;
}

void read_attributes(TableReader& top, UserType& type) {
  const Node* table = top.table("attributes");
  if (!table) return top.missing("attributes", "the numbers that make a particle, each as [attributes.name] with default and unit");
  for (const auto& [key, loc, node] : table->members) {
    if (node.kind != Kind::Table) top.wrong_type(node, "attributes." + key, "a table with default and unit");
    else if (auto a = read_attribute(node, key, top.diagnostics())) type.attributes.push_back(std::move(*a));
  }
  std::stable_sort(type.attributes.begin(), type.attributes.end(), [](const UserAttribute& a, const UserAttribute& b) { return a.length && !b.length; });
  const auto lengths = static_cast<std::size_t>(std::count_if(type.attributes.begin(), type.attributes.end(), [](const UserAttribute& a) { return a.length; }));
  if (lengths > most_user_lengths || type.attributes.size() - lengths > most_user_numbers)
    top.diagnostics().error(code::user_type, table->loc, fmt::format("a type has at most {} attributes of unit \"length\" and {} others", most_user_lengths, most_user_numbers));
}

void read_toml(const std::string& text, const std::string& file, UserType& type, Diagnostics& diagnostics) {
  const Node root = config::parse(text, file, code::scene_syntax);
  TableReader top(root, "", scene_parser::reader_codes, diagnostics);
  type.name = type.key = top.text("name").value_or("");
  const auto& shipped = scene_particle_types();
  if (!top.find("name")) top.missing("name", "what scenes call the type");
  else if (!is_name(type.name) || std::find(shipped.begin(), shipped.end(), type.name) != shipped.end())
    diagnostics.error(code::user_type, top.find("name")->loc, fmt::format("'{}' is no name for a type: small letters, digits and _, and none of the shipped types", type.name),
                      {fmt::format("Shipped types: {}", list_of(shipped))});
  type.summary = top.text("summary").value_or("from " + type.folder.string());
  read_attributes(top, type);
  top.finish();
}

} // namespace

std::shared_ptr<UserType> read_user_type(const std::filesystem::path& folder, const SourceLoc& loc, Diagnostics& diagnostics) {
  const std::optional<std::string> toml = text_of(folder / "type.toml"), glsl = text_of(folder / "type.glsl");
  if (!toml || !glsl) {
    diagnostics.error(code::user_type, loc, fmt::format("the particle type '{}' has no readable {}", folder.string(), toml ? "type.glsl" : "type.toml"),
                      {"A type is a folder with type.toml and type.glsl: docs/particle-type-file.md"});
    return nullptr;
  }
  auto type = std::make_shared<UserType>();
  type->folder = folder;
  type->glsl = *glsl;
  type->loc = loc;
  Diagnostics found;
  try {
    read_toml(*toml, (folder / "type.toml").string(), *type, found);
  } catch (const Failure& failure) {
    found.add(failure.diagnostic());
  }
  diagnostics.append(found);
  return found.has_errors() ? nullptr : type;
}

} // namespace mote
