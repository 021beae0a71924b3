// SPDX-License-Identifier: MIT
#include "render_graph/value.hpp"

#include "core/toml/node.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::rg {
namespace {

// From the located tree that scene files are read through, too.
Table table_of(const config::Node& node, Diagnostics& diagnostics);

std::optional<Value> value_of(const config::Node& node, Diagnostics& diagnostics) {
  switch (node.kind) {
  case config::Kind::Boolean: return Value{node.loc, node.boolean};
  case config::Kind::Integer: return Value{node.loc, node.integer};
  case config::Kind::Real: return Value{node.loc, node.real};
  case config::Kind::Text: return Value{node.loc, node.text};
  case config::Kind::Table: return Value{node.loc, table_of(node, diagnostics)};
  case config::Kind::Time:
    diagnostics.error("G004", node.loc, "dates and times mean nothing here.", {"write it as a string, in quotes."});
    return std::nullopt;
  case config::Kind::Array: break;
  }
  Array items;
  for (const config::Node& item : node.items)
    if (auto value = value_of(item, diagnostics)) items.push_back(std::move(*value));
  return Value{node.loc, std::move(items)};
}

Table table_of(const config::Node& node, Diagnostics& diagnostics) {
  Table out;
  for (const config::Member& member : node.members)
    if (auto value = value_of(member.value, diagnostics)) out.push_back({member.key, member.loc, std::move(*value)});
  return out;
}

void relocate(Value& value, const SourceLoc& loc) {
  value.loc = loc;
  if (auto* array = std::get_if<Array>(&value.data))
    for (Value& item : *array) relocate(item, loc);
  if (auto* table = std::get_if<Table>(&value.data))
    for (Entry& entry : *table) {
      entry.key_loc = loc;
      relocate(entry.value, loc);
    }
}

} // namespace

std::string_view type_name(const Value& value) {
  constexpr std::string_view names[] = {"a boolean", "an integer", "a number", "a string", "an array", "a table"};
  return names[value.data.index()];
}

std::string to_text(const Value& value) {
  struct Writer {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(double v) const { return fmt::format("{}", v); }
    std::string operator()(const std::string& v) const { return fmt::format("\"{}\"", v); }
    std::string operator()(const Array& v) const {
      std::string out;
      for (const Value& item : v) out += (out.empty() ? "" : ", ") + to_text(item);
      return "[" + out + "]";
    }
    std::string operator()(const Table& v) const {
      std::string out;
      for (const Entry& entry : v) out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", entry.key, to_text(entry.value));
      return "{ " + out + " }";
    }
  };
  return std::visit(Writer{}, value.data);
}

const Entry* find(const Table& table, std::string_view key) {
  auto it = std::find_if(table.begin(), table.end(), [&](const Entry& entry) { return entry.key == key; });
  return it == table.end() ? nullptr : &*it;
}

std::vector<std::string> keys_of(const Table& table) {
  std::vector<std::string> out;
  for (const Entry& entry : table) out.push_back(entry.key);
  return out;
}

Table parse_toml_text(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  try {
    return table_of(config::parse(text, file, "G001"), diagnostics);
  } catch (const Failure& failure) {
    Diagnostic syntax = failure.diagnostic();
    syntax.text = fmt::format("not valid TOML: {}.", syntax.text);
    diagnostics.add(std::move(syntax));
    return {};
  }
}

Value parse_setting(std::string_view text, const SourceLoc& loc) {
  Diagnostics ignored;
  Value value{loc, std::string(text)};
  if (text.find('\n') == std::string_view::npos) {
    Table table = parse_toml_text(fmt::format("v = {}", text), loc.file, ignored);
    if (!ignored.has_errors() && table.size() == 1) value = std::move(table.front().value);
  }
  relocate(value, loc);
  return value;
}

} // namespace mote::rg
