// SPDX-License-Identifier: MIT
// Files that build on others: what is merged, what is replaced, where variables go, and the schema for
// editors. What can be wrong with them is in bad/g027 to g029.
#include "fake_kinds.hpp"
#include "goldens.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <map>
#include <regex>

namespace mote::rg::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

GraphDesc parsed(const std::string& toml, Diagnostics& diagnostics, std::vector<std::string> settings = {}) {
  return parse_graph("schema = 1\n" + toml, (here() / "parts/mine.toml").string(), diagnostics, {.settings = std::move(settings)});
}
GraphDesc parsed(const std::string& toml, std::vector<std::string> settings = {}) {
  Diagnostics diagnostics;
  GraphDesc graph = parsed(toml, diagnostics, std::move(settings));
  EXPECT_EQ(to_string(diagnostics), "");
  return graph;
}
std::string text_of(const Table& table, std::string_view key) {
  const Entry* entry = find(table, key);
  return entry ? to_text(entry->value) : "nothing";
}

TEST(Include, WhatTheFileSaysGoesOverWhatItIncludes) {
  const GraphDesc graph = parsed(R"(include = "base.toml"
[[pass]]
name = "display"
params = { exposure = 2, look = "none" }
[[pass]]
name = "opaque"
draw = "cylinder"
[[pass]]
name = "extra"
kind = "blur"
)");
  EXPECT_EQ(graph.name.text, "mine") << "a name is each file's own";
  EXPECT_EQ(graph.output.text, "display.color");
  EXPECT_THAT(graph.output.loc.file, HasSubstr("base.toml"));
  ASSERT_EQ(graph.passes.size(), 3u);
  EXPECT_EQ(graph.passes[0].name.text, "opaque");
  EXPECT_EQ(graph.passes[0].kind.text, "opaque_impostors");
  ASSERT_EQ(graph.passes[0].draw.size(), 1u);
  ASSERT_EQ(graph.passes[0].draw[0].items.size(), 1u);
  EXPECT_EQ(graph.passes[0].draw[0].items[0].text, "cylinder");
  EXPECT_EQ(graph.passes[0].outputs[0].format->text, "rgba16float");
  const Table& params = graph.passes[1].params;
  EXPECT_EQ(text_of(params, "exposure"), "2");
  EXPECT_EQ(text_of(params, "look"), "\"none\"");
  EXPECT_EQ(text_of(params, "view"), "\"a 0.5 $\"");
  EXPECT_EQ(find(params, "exposure")->value.loc.line, 5u);
  EXPECT_EQ(graph.passes[1].inputs[0].source.text, "opaque.color");
  EXPECT_EQ(graph.passes[2].name.text, "extra");
}

TEST(Include, VariablesAreReplacedByTheIncludingFileAndTheCommandLine) {
  EXPECT_EQ(text_of(parsed("include = 'base.toml'").passes[1].params, "exposure"), "0.5");
  const std::string more = "include = 'base.toml'\nvariables = { exposure = -1, scale = 0.25 }";
  const GraphDesc file = parsed(more);
  EXPECT_EQ(text_of(file.passes[1].params, "exposure"), "-1");
  EXPECT_EQ(file.passes[0].outputs[0].size->factor, 0.25);
  const GraphDesc line = parsed(more, {"variables.exposure=3", "display.exposure=9"});
  EXPECT_EQ(text_of(line.passes[1].params, "exposure"), "3") << "other settings are apply_setting's";
  EXPECT_EQ(text_of(line.passes[1].params, "view"), "\"a 3 $\"");
  Diagnostics diagnostics;
  (void)parsed(more, diagnostics, {"variables.exposur=3"});
  EXPECT_THAT(to_string(diagnostics), HasSubstr("--set: error G028: 'variables.exposur=3': there is no variable 'exposur'."));
  EXPECT_THAT(to_string(diagnostics), HasSubstr("Did you mean 'exposure'?"));
}

TEST(Include, OneFileTwiceIsNoRing) {
  const GraphDesc graph = parsed("include = ['base.toml', 'base.toml']");
  EXPECT_EQ(graph.passes.size(), 2u);
}

TEST(Include, PlacesAreThoseOfTheFileThatIsWrong) {
  Diagnostics diagnostics;
  (void)parsed("include = 'broken.toml'\noutput = 'a.b'\n[[pass]]\nname = 'a'\nkind = 'blur'", diagnostics);
  ASSERT_EQ(diagnostics.list().size(), 1u) << to_string(diagnostics);
  EXPECT_EQ(diagnostics.list()[0].code, "G001");
  EXPECT_THAT(diagnostics.list()[0].loc.file, HasSubstr("broken.toml"));
}

TEST(Include, TheReaderMayKnowOtherPlaces) {
  Diagnostics diagnostics;
  const ParseOptions options{.read = [](const std::string& name, const std::string& from) -> std::optional<GraphText> {
    EXPECT_EQ(from, "mine.toml");
    return GraphText{"shipped:" + name, "schema = 1\noutput = 'a.color'\n[[pass]]\nname = 'a'\nkind = 'nonsense'\n"};
  }};
  const GraphDesc graph = parse_graph("schema = 1\ninclude = 'default'", "mine.toml", diagnostics, options);
  EXPECT_EQ(to_string(diagnostics), "");
  ASSERT_EQ(graph.passes.size(), 1u);
  EXPECT_EQ(graph.passes[0].kind.loc.file, "shipped:default");
}

// ---- schema ----------------------------------------------------------------------------------------
using nlohmann::json;

json json_of(const Value& value) {
  if (const auto* b = std::get_if<bool>(&value.data)) return *b;
  if (const auto* i = std::get_if<std::int64_t>(&value.data)) return *i;
  if (const auto* d = std::get_if<double>(&value.data)) return *d;
  if (const auto* s = std::get_if<std::string>(&value.data)) return *s;
  json out;
  if (const auto* a = std::get_if<Array>(&value.data)) {
    out = json::array();
    for (const Value& item : *a) out.push_back(json_of(item));
  } else {
    out = json::object();
    for (const Entry& entry : std::get<Table>(value.data)) out[entry.key] = json_of(entry.value);
  }
  return out;
}

// The part of JSON schema that graph_schema() uses. True if `value` is what `schema` describes.
class Validator {
public:
  explicit Validator(const json& root) : root_(root) {}
  bool fits(const json& value) const { return fits(root_, value); }

private:
  static bool has_type(const std::string& type, const json& v) {
    return (type == "object" && v.is_object()) || (type == "array" && v.is_array()) || (type == "string" && v.is_string()) ||
           (type == "number" && v.is_number()) || (type == "integer" && v.is_number_integer()) || (type == "boolean" && v.is_boolean());
  }
  bool object_fits(const json& s, const json& v) const {
    for (const json& key : s.value("required", json::array()))
      if (!v.contains(key.get<std::string>())) return false;
    const json known = s.value("properties", json::object()), other = s.value("additionalProperties", json(true));
    for (const auto& [key, item] : v.items()) {
      if (s.contains("propertyNames") && !fits(s["propertyNames"], json(key))) return false;
      if (!fits(known.contains(key) ? known[key] : other, item)) return false;
    }
    return true;
  }
  bool fits(const json& s, const json& v) const {
    if (s.is_boolean()) return s.get<bool>();
    if (s.contains("$ref")) return fits(root_["definitions"][s["$ref"].get<std::string>().substr(14)], v);
    if (s.contains("type") && !has_type(s["type"], v)) return false;
    if (s.contains("const") && s["const"] != v) return false;
    if (s.contains("enum") && std::find(s["enum"].begin(), s["enum"].end(), v) == s["enum"].end()) return false;
    if (s.contains("pattern") && !std::regex_search(v.get<std::string>(), std::regex(s["pattern"].get<std::string>()))) return false;
    if (s.contains("minimum") && v < s["minimum"]) return false;
    if (s.contains("exclusiveMinimum") && v <= s["exclusiveMinimum"]) return false;
    if (s.contains("maximum") && v > s["maximum"]) return false;
    if (v.is_array() && (v.size() < s.value("minItems", 0u) || v.size() > s.value("maxItems", 1000u))) return false;
    if (v.is_array() && s.contains("items"))
      for (const json& item : v)
        if (!fits(s["items"], item)) return false;
    if (v.is_object() && !object_fits(s, v)) return false;
    for (const json& part : s.value("allOf", json::array()))
      if (!fits(part, v)) return false;
    if (s.contains("anyOf") && std::none_of(s["anyOf"].begin(), s["anyOf"].end(), [&](const json& part) { return fits(part, v); })) return false;
    if (s.contains("if") && fits(s["if"], v) && !fits(s["then"], v)) return false;
    return true;
  }
  json root_;
};

bool valid(const std::string& toml) {
  static const Validator validator(json::parse(graph_schema(fake_registry())));
  Diagnostics diagnostics;
  const Table table = parse_toml_text(toml, "t.toml", diagnostics);
  EXPECT_EQ(to_string(diagnostics), "");
  return validator.fits(json_of({{}, table}));
}

TEST(Schema, GoodGraphsFit) {
  for (const auto& entry : std::filesystem::directory_iterator(here() / "good"))
    EXPECT_TRUE(entry.path().extension() != ".toml" || valid(read_text(entry.path()))) << entry.path();
  EXPECT_TRUE(valid(read_text(here() / "parts/base.toml")));
}

TEST(Schema, OneBrokenThingDoesNot) {
  const std::string good = "schema = 1\noutput = 'display.color'\n[[pass]]\nname = 'display'\nkind = 'ocio_tonemap'\nenabled = true\ninputs = { color = 'opaque.color' }\n"
                           "params = { exposure = 0.5 }\noutputs = { color = { size = [640, 480], format = 'rgba8unorm' } }\n";
  EXPECT_TRUE(valid(good));
  const auto broken = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_TRUE(valid(broken("0.5", "'$gain'")));
  for (const auto& [from, to] : std::map<std::string, std::string>{{"schema = 1", "schema = 2"}, {"output =", "outputt ="}, {"ocio_tonemap", "ocio"}, {"enabled = true", "enabled = 1"},
                                                                  {"'opaque.color'", "'opaque'"}, {"0.5", "[1]"}, {"[640, 480]", "[640]"}, {"rgba8unorm", "rgb8"}, {"name = 'display'", "name = 'Display'"}})
    EXPECT_FALSE(valid(broken(from, to))) << from << " -> " << to;
}

} // namespace
} // namespace mote::rg::test
