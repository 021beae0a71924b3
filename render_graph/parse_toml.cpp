// SPDX-License-Identifier: MIT
// TOML values -> GraphDesc. One small reader per level of the file; each reports every unknown key.
#include "core/gpu/format.hpp"
#include "render_graph/graph_desc.hpp"
#include "render_graph/include.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace mote::rg {
namespace {

// Reads the keys of one table; what it is (`where`: "pass 'glow'") stands in every message.
class Reader {
public:
  Reader(const Table& table, SourceLoc loc, std::string where, Diagnostics& diagnostics)
      : table_(table), loc_(std::move(loc)), where_(std::move(where)), diagnostics_(diagnostics) {}

  const Value* value(std::string_view key) {
    known_.emplace_back(key);
    const Entry* entry = find(table_, key);
    return entry ? &entry->value : nullptr;
  }
  template <class T> const T* get(std::string_view key, std::string_view wanted) {
    const Value* v = value(key);
    if (!v) return nullptr;
    if (const T* held = std::get_if<T>(&v->data)) return held;
    wrong(key, *v, wanted);
    return nullptr;
  }
  std::optional<LocatedString> string(std::string_view key) {
    const auto* text = get<std::string>(key, "a string");
    if (!text) return std::nullopt;
    return LocatedString{*text, find(table_, key)->value.loc};
  }
  LocatedString required(std::string_view key) {
    if (find(table_, key)) return string(key).value_or(LocatedString{});
    known_.emplace_back(key);
    diagnostics_.error("G005", loc_, fmt::format("{} has no '{}'.", where_, key));
    return {};
  }
  // A whole number from 1 to `max`.
  std::optional<std::uint64_t> count(std::string_view key, std::string_view code, std::uint64_t max) {
    const auto* number = get<std::int64_t>(key, "an integer");
    if (!number) return std::nullopt;
    if (*number >= 1 && static_cast<std::uint64_t>(*number) <= max) return static_cast<std::uint64_t>(*number);
    diagnostics_.error(code, find(table_, key)->value.loc, fmt::format("{} '{}' is {}, but must be from 1 to {}.", where_, key, *number, max));
    return std::nullopt;
  }
  void wrong(std::string_view key, const Value& v, std::string_view wanted) {
    diagnostics_.error("G004", v.loc, fmt::format("{} '{}' is {}, but must be {}.", where_, key, type_name(v), wanted));
  }
  void finish() { // unknown keys
    std::sort(known_.begin(), known_.end());
    for (const Entry& entry : table_)
      if (!std::binary_search(known_.begin(), known_.end(), entry.key))
        diagnostics_.error("G003", entry.key_loc, fmt::format("{} has an unknown key '{}'.", where_, entry.key),
                           {"keys: " + list_of(known_) + ".", did_you_mean(entry.key, known_)});
  }

private:
  const Table& table_;
  SourceLoc loc_;
  std::string where_;
  Diagnostics& diagnostics_;
  std::vector<std::string> known_{};
};

void check_name(const LocatedString& name, std::string_view what, Diagnostics& diagnostics) {
  if (!valid_name(name.text) && !(name.text.empty() && name.loc.line == 0))
    diagnostics.error("G006", name.loc, fmt::format("{} '{}' is not a name.", what, name.text),
                      {"a name is a lower-case letter, then lower-case letters, digits and '_'."});
}

constexpr std::uint64_t max_side = 1u << 16;

// "view", { view = 0.5 }, [w, h], [w, h, d], { like = "pass.slot" }
std::optional<SizeSpec> parse_size(const Value& value) {
  SizeSpec size;
  if (const auto* text = std::get_if<std::string>(&value.data)) return *text == "view" ? std::optional(size) : std::nullopt;
  if (const auto* table = std::get_if<Table>(&value.data); table && table->size() == 1) {
    const auto& [key, key_loc, item] = table->front();
    const auto* number = std::get_if<double>(&item.data);
    const auto* whole = std::get_if<std::int64_t>(&item.data);
    const auto* text = std::get_if<std::string>(&item.data);
    if (key == "like" && text) return SizeSpec{.kind = SizeSpec::Kind::Like, .like = *text};
    if (key != "view" || (!number && !whole)) return std::nullopt;
    size.factor = number ? *number : static_cast<double>(*whole);
    return size.factor > 0 && size.factor <= 16 ? std::optional(size) : std::nullopt;
  }
  const auto* array = std::get_if<Array>(&value.data);
  if (!array || array->size() < 2 || array->size() > 3) return std::nullopt;
  std::array<std::uint32_t, 3> sides{1, 1, 1};
  for (std::size_t i = 0; i < array->size(); ++i) {
    const auto* side = std::get_if<std::int64_t>(&(*array)[i].data);
    if (!side || *side < 1 || *side > static_cast<std::int64_t>(max_side)) return std::nullopt;
    sides[i] = static_cast<std::uint32_t>(*side);
  }
  return SizeSpec{.kind = SizeSpec::Kind::Fixed, .width = sides[0], .height = sides[1], .depth = sides[2]};
}

OutputDesc parse_output(const Entry& entry, const std::string& where, Diagnostics& diagnostics) {
  OutputDesc out{.slot = {entry.key, entry.key_loc}, .shape_loc = entry.key_loc};
  const auto* table = std::get_if<Table>(&entry.value.data);
  const std::string what = fmt::format("{} output '{}'", where, entry.key);
  if (!table) {
    diagnostics.error("G004", entry.value.loc, fmt::format("{} is {}, but must be a table.", what, type_name(entry.value)));
    return out;
  }
  Reader reader(*table, entry.key_loc, what, diagnostics);
  out.format = reader.string("format");
  if (out.format && !gpu::parse_format(out.format->text)) {
    const auto names = gpu::format_names();
    diagnostics.error("G040", out.format->loc, fmt::format("{} names the unknown format '{}'.", what, out.format->text),
                      {"formats: " + list_of(names) + ".", did_you_mean(out.format->text, names)});
    out.format.reset();
  }
  if (const Value* size = reader.value("size")) {
    out.size = parse_size(*size);
    out.size_loc = size->loc;
    if (!out.size)
      diagnostics.error("G043", size->loc, fmt::format("{} has the size {}, which is no size.", what, to_text(*size)),
                        {fmt::format("sizes: \"view\", {{ view = 0.5 }} (above 0, at most 16), [w, h] or [w, h, d] (1 to {}), {{ like = \"pass.slot\" }}.", max_side)});
  }
  if (auto n = reader.count("layers", "G046", 2048)) out.layers = static_cast<std::uint32_t>(*n);
  if (auto n = reader.count("mips", "G046", 16)) out.mips = static_cast<std::uint32_t>(*n);
  out.count = reader.count("count", "G046", std::uint64_t{1} << 40);
  out.dimension = reader.string("dimension");
  if (out.dimension && out.dimension->text != "1d" && out.dimension->text != "2d" && out.dimension->text != "3d") {
    diagnostics.error("G046", out.dimension->loc, fmt::format("{} 'dimension' is '{}'.", what, out.dimension->text), {"dimensions: 1d, 2d, 3d."});
    out.dimension.reset();
  }
  for (std::string_view key : {"layers", "mips", "dimension", "count"})
    if (const Entry* shape = find(*table, key)) out.shape_loc = shape->value.loc;
  reader.finish();
  return out;
}

// draw = "a", draw = ["a", "b"], or draw = { list = ["a"], other = ["b"] }
std::vector<DrawList> parse_draw(const Value& value, const std::string& where, Diagnostics& diagnostics) {
  std::vector<DrawList> out;
  auto add = [&](std::string name, const Value& list) {
    DrawList draw{std::move(name), list.loc, {}};
    const auto* array = std::get_if<Array>(&list.data);
    const Array single{list};
    for (const Value& item : array ? *array : single)
      if (const auto* text = std::get_if<std::string>(&item.data)) draw.items.push_back({*text, item.loc});
    if (draw.items.size() != (array ? array->size() : 1))
      diagnostics.error("G004", list.loc, fmt::format("{} 'draw' must be a string, an array of strings, or a table of those.", where));
    out.push_back(std::move(draw));
  };
  if (const auto* table = std::get_if<Table>(&value.data))
    for (const Entry& entry : *table) add(entry.key, entry.value);
  else add({}, value);
  return out;
}

PassDesc parse_pass(const Table& table, const SourceLoc& loc, Diagnostics& diagnostics) {
  PassDesc pass{.loc = loc};
  const Entry* named = find(table, "name");
  const auto* text = named ? std::get_if<std::string>(&named->value.data) : nullptr;
  const std::string where = text ? fmt::format("pass '{}'", *text) : "a pass";
  Reader reader(table, loc, where, diagnostics);
  pass.name = reader.required("name");
  check_name(pass.name, "pass name", diagnostics);
  pass.kind = reader.required("kind");
  pass.enabled_loc = loc;
  if (const bool* enabled = reader.get<bool>("enabled", "true or false")) {
    pass.enabled = *enabled;
    pass.enabled_loc = find(table, "enabled")->value.loc;
  }
  if (const Value* draw = reader.value("draw")) pass.draw = parse_draw(*draw, where, diagnostics);
  if (const auto* inputs = reader.get<Table>("inputs", "a table"))
    for (const Entry& entry : *inputs) {
      if (const auto* source = std::get_if<std::string>(&entry.value.data))
        pass.inputs.push_back({{entry.key, entry.key_loc}, {*source, entry.value.loc}});
      else
        diagnostics.error("G004", entry.value.loc, fmt::format("{} input '{}' is {}, but must be a string \"pass.slot\".", where, entry.key, type_name(entry.value)));
    }
  if (const auto* outputs = reader.get<Table>("outputs", "a table"))
    for (const Entry& entry : *outputs) pass.outputs.push_back(parse_output(entry, where, diagnostics));
  if (const auto* params = reader.get<Table>("params", "a table")) pass.params = *params;
  reader.finish();
  return pass;
}

void parse_passes(GraphDesc& graph, const Value* list, const SourceLoc& top, Diagnostics& diagnostics) {
  const auto* array = list ? std::get_if<Array>(&list->data) : nullptr;
  if (!array || array->empty()) {
    diagnostics.error("G009", list ? list->loc : top, "the graph has no passes.", {"a pass begins with [[pass]]."});
    return;
  }
  for (const Value& item : *array) {
    if (const auto* table = std::get_if<Table>(&item.data)) graph.passes.push_back(parse_pass(*table, item.loc, diagnostics));
    else diagnostics.error("G004", item.loc, fmt::format("'pass' holds {}, but must hold tables.", type_name(item)));
  }
}

} // namespace

bool valid_name(std::string_view text) {
  const auto lower = [](char c) { return c >= 'a' && c <= 'z'; };
  return !text.empty() && lower(text[0]) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return lower(c) || (c >= '0' && c <= '9') || c == '_'; });
}

std::optional<Source> split_source(std::string_view text) {
  const auto dot = text.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  Source out{std::string(text.substr(0, dot)), std::string(text.substr(dot + 1))};
  // names with wrong letters are looked up all the same: "did you mean" helps more than a grammar
  if (out.pass.empty() || out.slot.empty() || out.slot.find('.') != std::string::npos) return std::nullopt;
  return out;
}

GraphDesc parse_graph(std::string_view toml, const std::string& file, Diagnostics& diagnostics, const ParseOptions& options) {
  GraphDesc graph{.file = file};
  graph.name.text = std::filesystem::path(file).stem().string();
  const std::size_t before = diagnostics.list().size();
  const Table table = assemble_graph(toml, file, options, diagnostics);
  if (table.empty() && diagnostics.list().size() > before) return graph; // the syntax error says it all
  const SourceLoc top{file, 1, 1};
  Reader reader(table, top, "the graph", diagnostics);
  if (const Value* schema = reader.value("schema")) {
    const auto* number = std::get_if<std::int64_t>(&schema->data);
    if (!number || *number != 1)
      diagnostics.error("G002", schema->loc, fmt::format("'schema' is {}, but this program reads schema 1.", to_text(*schema)));
  } else diagnostics.error("G002", top, "'schema' is missing.", {"the first line of a graph file is: schema = 1"});
  (void)reader.value("include"); // has been read
  (void)reader.value("variables");
  if (auto name = reader.string("name")) graph.name = *name;
  graph.output = reader.required("output");
  parse_passes(graph, reader.value("pass"), top, diagnostics);
  reader.finish();
  return graph;
}

GraphDesc load_graph(const std::string& path, Diagnostics& diagnostics, const ParseOptions& options) {
  if (const auto found = read_beside(path, {})) return parse_graph(found->text, path, diagnostics, options);
  diagnostics.error("G007", {path}, fmt::format("the graph file '{}' cannot be read.", path));
  return {.file = path};
}

void apply_setting(GraphDesc& graph, std::string_view assignment, Diagnostics& diagnostics) {
  if (sets_variable(assignment)) return;
  const SourceLoc place{"--set"};
  const auto equals = assignment.find('=');
  std::vector<std::string> path(1);
  for (char c : assignment.substr(0, equals)) {
    if (c == '.') path.emplace_back();
    else path.back() += c;
  }
  if (equals == std::string_view::npos || path.size() < 2 || std::any_of(path.begin(), path.end(), [](auto& p) { return p.empty(); })) {
    diagnostics.error("G008", place, fmt::format("'{}' is not pass.parameter=value.", assignment));
    return;
  }
  auto pass = std::find_if(graph.passes.begin(), graph.passes.end(), [&](const PassDesc& p) { return p.name.text == path[0]; });
  if (pass == graph.passes.end()) {
    std::vector<std::string> names;
    for (const PassDesc& p : graph.passes) names.push_back(p.name.text);
    diagnostics.error("G026", place, fmt::format("'{}' names the pass '{}', which the graph does not have.", assignment, path[0]),
                      {"passes: " + list_of(names) + ".", did_you_mean(path[0], names)});
    return;
  }
  Value value = parse_setting(assignment.substr(equals + 1), place);
  if (path.size() == 2 && path[1] == "enabled") {
    if (const bool* flag = std::get_if<bool>(&value.data)) pass->enabled = *flag, pass->enabled_loc = place;
    else diagnostics.error("G004", place, fmt::format("'{}' must be true or false.", assignment.substr(0, equals)));
    return;
  }
  Table* table = &pass->params;
  for (std::size_t i = 1; i < path.size(); ++i) {
    auto entry = std::find_if(table->begin(), table->end(), [&](const Entry& e) { return e.key == path[i]; });
    if (entry == table->end()) entry = table->insert(table->end(), {path[i], place, {place, Table{}}});
    if (i + 1 == path.size()) {
      entry->key_loc = place;
      entry->value = std::move(value);
      return;
    }
    if (!std::holds_alternative<Table>(entry->value.data)) entry->value = {place, Table{}};
    table = &std::get<Table>(entry->value.data);
  }
}

} // namespace mote::rg
