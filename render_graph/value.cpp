// SPDX-License-Identifier: MIT
#include "render_graph/value.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <tuple>

namespace mote::rg {
namespace {

struct Converter {
  const std::string& file;
  Diagnostics& diagnostics;

  [[nodiscard]] SourceLoc loc(const toml::source_region& region) const {
    return {file, region.begin.line, region.begin.column};
  }
  [[nodiscard]] Table table(const toml::table& from) {
    Table out;
    for (const auto& [key, node] : from)
      if (auto value = convert(node)) out.push_back({std::string(key.str()), loc(key.source()), std::move(*value)});
    std::stable_sort(out.begin(), out.end(), [](const Entry& a, const Entry& b) {
      return std::tie(a.key_loc.line, a.key_loc.column) < std::tie(b.key_loc.line, b.key_loc.column);
    });
    return out;
  }
  [[nodiscard]] std::optional<Value> convert(const toml::node& node) {
    Value value{loc(node.source()), {}};
    if (const auto* t = node.as_table()) value.data = table(*t);
    else if (const auto* a = node.as_array()) {
      Array items;
      for (const toml::node& item : *a)
        if (auto v = convert(item)) items.push_back(std::move(*v));
      value.data = std::move(items);
    } else if (const auto* b = node.as_boolean()) value.data = b->get();
    else if (const auto* i = node.as_integer()) value.data = i->get();
    else if (const auto* f = node.as_floating_point()) value.data = f->get();
    else if (const auto* s = node.as_string()) value.data = s->get();
    else {
      diagnostics.error("G004", value.loc, "dates and times mean nothing here.", {"write it as a string, in quotes."});
      return std::nullopt;
    }
    return value;
  }
};

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
  Converter converter{file, diagnostics};
  try {
    return converter.table(toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    diagnostics.error("G001", converter.loc(error.source()), fmt::format("not valid TOML: {}.", error.description()));
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
