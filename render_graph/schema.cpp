// SPDX-License-Identifier: MIT
// The JSON schema (draft 7) of graph files, for editors that complete and check TOML by one. Made from
// the kinds themselves, so it is never out of date; the compiler stays the judge: slots and parameters
// that a kind takes only in some cases are not listed, so unlisted ones are let through.
#include "core/gpu/format.hpp"
#include "render_graph/registry.hpp"

#include <nlohmann/json.hpp>

#include <charconv>

namespace mote::rg {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view name_pattern = "^[a-z][a-z0-9_]*$";

Json ref(std::string_view name) { return {{"$ref", "#/definitions/" + std::string(name)}}; }
Json either(Json a, Json b) { return {{"anyOf", Json::array({std::move(a), std::move(b)})}}; }
Json or_variable(Json type) { return either(std::move(type), ref("variable")); }
Json array_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }
Json string_or_list() { return either({{"type", "string"}}, array_of({{"type", "string"}})); }

std::vector<std::string> split(std::string_view text) { // "a, b"
  std::vector<std::string> out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(", "), text.size());
    out.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 2, text.size()));
  }
  return out;
}

// ">= 0, <= 1" as minimum and maximum.
void add_bounds(Json& type, const std::string& range) {
  for (const std::string& bound : split(range)) {
    const std::string_view key = bound.starts_with(">= ") ? "minimum" : bound.starts_with("> ") ? "exclusiveMinimum" : bound.starts_with("<= ") ? "maximum" : "";
    double value = 0.0;
    const std::size_t first = bound.find(' ') + 1;
    const auto [end, error] = std::from_chars(bound.data() + first, bound.data() + bound.size(), value);
    if (!key.empty() && error == std::errc{} && end == bound.data() + bound.size()) type[std::string(key)] = value;
  }
}

Json type_of(const ParamInfo& p) {
  if (p.type == "number" || p.type == "integer") {
    Json type{{"type", p.type}};
    add_bounds(type, p.range);
    return type;
  }
  if (p.type == "boolean") return {{"type", "boolean"}};
  if (p.type == "string") return p.range.empty() ? Json{{"type", "string"}} : Json{{"enum", split(p.range)}};
  if (p.type == "color") return either({{"type", "string"}, {"pattern", "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6}|[0-9a-fA-F]{8})$"}}, array_of({{"type", "number"}}));
  if (p.type == "strings") return string_or_list();
  if (p.type == "table") return {{"type", "object"}};
  if (p.type == "tables") return either({{"type", "object"}}, array_of({{"type", "object"}}));
  Json numbers = array_of({{"type", "number"}}); // "numbers", "3 numbers"
  std::size_t count = 0;
  if (std::from_chars(p.type.data(), p.type.data() + p.type.size(), count).ec == std::errc{}) numbers["minItems"] = numbers["maxItems"] = count;
  return numbers;
}

// Adds a parameter ("samples.n": inside the table of its parent). A parent that may also be something else stays open.
void add_param(Json& properties, const ParamInfo& p, std::string_view name) {
  const std::size_t dot = name.find('.');
  if (dot != std::string_view::npos) {
    Json& parent = properties[std::string(name.substr(0, dot))];
    if (!parent.contains("anyOf") && !parent.is_null()) return;
    Json& table = parent.is_null() ? (parent = or_variable({{"type", "object"}}), parent["anyOf"][0]) : parent["anyOf"][0];
    if (table.value("type", "") == "object") add_param(table["properties"], p, name.substr(dot + 1));
    return;
  }
  Json entry = or_variable(type_of(p));
  if (!p.summary.empty()) entry["description"] = p.summary;
  const Json fallback = p.fallback.empty() ? Json(Json::value_t::discarded) : Json::parse(p.fallback, nullptr, false);
  if (!fallback.is_discarded()) entry["default"] = fallback;
  if (!properties.contains(std::string(name))) properties[std::string(name)] = std::move(entry);
}

// What a pass of one kind may say.
Json kind_rule(const KindInfo& kind) {
  Json inputs = Json::object(), outputs = Json::object(), params = Json::object();
  for (const Slot& slot : kind.slots) {
    const bool buffer = slot.buffer || (slot.makes && std::holds_alternative<BufferSpec>(*slot.makes));
    const auto described = [&](std::string_view type) { return Json{{"allOf", Json::array({ref(type)})}, {"description", slot.summary}}; };
    if (reads(slot.access) && !slot.state) inputs[slot.name] = described("source");
    if (writes(slot.access)) outputs[slot.name] = described(buffer ? "buffer_output" : "texture_output");
  }
  for (const ParamInfo& p : kind.params) add_param(params, p, p.name);
  const auto object = [](Json properties) { return Json{{"type", "object"}, {"properties", std::move(properties)}}; };
  Json properties{{"inputs", object(std::move(inputs))}, {"outputs", object(std::move(outputs))}, {"params", object(std::move(params))}};
  if (!kind.draws) properties["draw"] = false;
  return {{"if", {{"properties", {{"kind", {{"const", kind.name}}}}}, {"required", {"kind"}}}}, {"then", {{"properties", std::move(properties)}}}};
}

Json definitions(const std::vector<KindInfo>& kinds) {
  const Json positive{{"type", "integer"}, {"minimum", 1}};
  Json out;
  out["variable"] = {{"type", "string"}, {"pattern", "\\$"}};
  out["source"] = {{"type", "string"}, {"pattern", "^[^.]+\\.[^.]+$|\\$"}, {"description", "pass.slot"}};
  Json size_table{{"type", "object"}, {"additionalProperties", false}, {"properties", {{"view", or_variable({{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 16}})}, {"like", {{"type", "string"}}}}}};
  Json sides = array_of(positive);
  sides["minItems"] = 2, sides["maxItems"] = 3;
  out["size"] = {{"anyOf", Json::array({Json{{"const", "view"}}, size_table, sides, ref("variable")})}};
  out["texture_output"] = {{"type", "object"},
                           {"additionalProperties", false},
                           {"properties",
                            {{"format", or_variable({{"enum", gpu::format_names()}})},
                             {"size", ref("size")},
                             {"layers", or_variable(positive)},
                             {"mips", or_variable(positive)},
                             {"dimension", or_variable({{"enum", {"1d", "2d", "3d"}}})}}}};
  out["buffer_output"] = {{"type", "object"}, {"additionalProperties", false}, {"properties", {{"count", or_variable(positive)}}}};
  Json names = Json::array(), rules = Json::array();
  for (const KindInfo& kind : kinds) {
    names.push_back({{"const", kind.name}, {"description", kind.summary}});
    rules.push_back(kind_rule(kind));
  }
  Json draw = string_or_list();
  draw["anyOf"].push_back({{"type", "object"}, {"additionalProperties", string_or_list()}});
  out["pass"] = {{"type", "object"},
                 {"required", {"name"}},
                 {"additionalProperties", false},
                 {"properties",
                  {{"name", {{"type", "string"}, {"pattern", name_pattern}}},
                   {"kind", {{"anyOf", names}}},
                   {"enabled", or_variable({{"type", "boolean"}})},
                   {"draw", draw},
                   {"inputs", {{"type", "object"}, {"additionalProperties", ref("source")}}},
                   {"outputs", {{"type", "object"}}},
                   {"params", {{"type", "object"}}}}},
                 {"allOf", rules}};
  return out;
}

} // namespace

std::string graph_schema(const Registry& registry) {
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "mote render graph"}, {"type", "object"}, {"required", {"schema"}}, {"additionalProperties", false}};
  schema["properties"] = {{"schema", {{"const", 1}}},
                          {"name", {{"type", "string"}}},
                          {"include", string_or_list()},
                          {"output", ref("source")},
                          {"variables", {{"type", "object"}, {"propertyNames", {{"pattern", name_pattern}}}}},
                          {"pass", array_of(ref("pass"))}};
  schema["definitions"] = definitions(describe(registry));
  return schema.dump(2) + "\n";
}

} // namespace mote::rg
