// SPDX-License-Identifier: MIT
#include "core/toml/node.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

namespace mote::config {

std::string_view to_string(Kind kind) {
  switch (kind) {
  case Kind::Boolean: return "a truth value";
  case Kind::Integer: return "an integer";
  case Kind::Real: return "a number";
  case Kind::Text: return "a text";
  case Kind::Time: return "a date or time";
  case Kind::Array: return "an array";
  case Kind::Table: return "a table";
  }
  return "a value";
}

const Node* Node::find(std::string_view key) const {
  for (const Member& member : members)
    if (member.key == key) return &member.value;
  return nullptr;
}
Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

Node& Node::set(std::string_view key, Node value) {
  if (Node* present = find(key)) return *present = std::move(value);
  SourceLoc place = value.loc;
  members.push_back({std::string(key), std::move(place), std::move(value)});
  return members.back().value;
}

Node text_node(std::string_view text, SourceLoc loc) {
  Node node;
  node.kind = Kind::Text;
  node.loc = std::move(loc);
  node.text = text;
  return node;
}
Node number_node(double value, SourceLoc loc) {
  Node node;
  node.kind = Kind::Real;
  node.loc = std::move(loc);
  node.real = value;
  return node;
}
Node array_node(std::vector<Node> items, SourceLoc loc) {
  Node node;
  node.kind = Kind::Array;
  node.loc = std::move(loc);
  node.items = std::move(items);
  return node;
}
Node table_node(std::vector<std::pair<std::string, Node>> members, SourceLoc loc) {
  Node node;
  node.loc = std::move(loc);
  for (auto& [key, value] : members) node.set(key, std::move(value));
  return node;
}

std::string to_text(const Node& node) {
  std::string out;
  switch (node.kind) {
  case Kind::Boolean: out = node.boolean ? "true" : "false"; break;
  case Kind::Integer: out = fmt::format("{}", node.integer); break;
  case Kind::Real: out = fmt::format("{}", node.real); break;
  case Kind::Text:
  case Kind::Time: out = node.text; break;
  case Kind::Array:
    for (const Node& item : node.items) out += (out.empty() ? "" : ", ") + to_text(item);
    out = "[" + out + "]";
    break;
  case Kind::Table:
    for (const Member& member : node.members) out += (out.empty() ? "" : ", ") + member.key + " = " + to_text(member.value);
    out = "{ " + out + " }";
    break;
  }
  constexpr std::size_t longest = 60;
  return out.size() <= longest ? out : out.substr(0, longest) + "...";
}

namespace {

SourceLoc place(const toml::source_region& region, const std::string& file) {
  return {file, region.begin.line, region.begin.column};
}

Node convert(const toml::node& from, const std::string& file) {
  Node node;
  node.loc = place(from.source(), file);
  if (const auto* table = from.as_table()) {
    node.kind = Kind::Table;
    for (const auto& [key, value] : *table)
      node.members.push_back({std::string(key.str()), place(key.source(), file), convert(value, file)});
    // toml++ sorts by key; people read from top to bottom
    std::stable_sort(node.members.begin(), node.members.end(), [](const Member& a, const Member& b) {
      return std::pair(a.loc.line, a.loc.column) < std::pair(b.loc.line, b.loc.column);
    });
  } else if (const auto* array = from.as_array()) {
    node.kind = Kind::Array;
    for (const toml::node& item : *array) node.items.push_back(convert(item, file));
  } else if (const auto* boolean = from.as_boolean()) {
    node.kind = Kind::Boolean;
    node.boolean = boolean->get();
  } else if (const auto* integer = from.as_integer()) {
    node.kind = Kind::Integer;
    node.integer = integer->get();
    node.real = static_cast<double>(node.integer);
  } else if (const auto* real = from.as_floating_point()) {
    node.kind = Kind::Real;
    node.real = real->get();
  } else if (const auto* text = from.as_string()) {
    node.kind = Kind::Text;
    node.text = text->get();
  } else {
    node.kind = Kind::Time;
    node.text = "a date or time";
  }
  return node;
}

} // namespace

Node parse(std::string_view text, const std::string& file, std::string_view syntax_code) {
  try {
    return convert(toml::parse(text, std::string_view(file)), file);
  } catch (const toml::parse_error& error) {
    fail(Exit::BadInput, syntax_code, place(error.source(), file), std::string(error.description()));
  }
}

} // namespace mote::config
