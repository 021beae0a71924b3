// SPDX-License-Identifier: MIT
#include "fake_kinds.hpp"

#include <gmock/gmock.h>

namespace mote::rg::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Reading {
  Diagnostics diagnostics{};
  Params params;
  explicit Reading(const std::string& toml) : params(parse_toml_text(toml, "dir/p.toml", diagnostics), {}, "glow", "blur", {"dir/p.toml", 1, 1}, diagnostics) {}
  [[nodiscard]] std::string text() const { return to_string(diagnostics); }
};

TEST(Params, ReadsEveryType) {
  Reading r("n = 2\ni = -3\nb = true\ns = 'x y'\nw = 'fast'\np = 'luts/a.cube'\nc = '#80ff0040'\nc3 = [0.5, 1, 0]\nv = [1, 2.5]\nl = ['a', 'b']\none = 'a'\nf = [1, 2, 3]");
  Params& p = r.params;
  EXPECT_EQ(p.number("n", 0), 2.0);
  EXPECT_EQ(p.integer("i", 0), -3);
  EXPECT_TRUE(p.boolean("b", false));
  EXPECT_EQ(p.string("s", ""), "x y");
  EXPECT_EQ(p.word("w", "exact", {"exact", "fast"}), "fast");
  EXPECT_EQ(p.path("p", ""), "dir/luts/a.cube");
  const gpu::Color c = p.color("c", {}), c3 = p.color("c3", {});
  EXPECT_DOUBLE_EQ(c.r, 128.0 / 255);
  EXPECT_DOUBLE_EQ(c.g, 1.0);
  EXPECT_DOUBLE_EQ(c.a, 64.0 / 255);
  EXPECT_DOUBLE_EQ(c3.r, 0.5);
  EXPECT_DOUBLE_EQ(c3.a, 1.0);
  EXPECT_THAT((p.vec<2>("v", {0, 0})), ElementsAre(1.0, 2.5));
  EXPECT_THAT(p.strings("l", {}), ElementsAre("a", "b"));
  EXPECT_THAT(p.strings("one", {}), ElementsAre("a"));
  EXPECT_THAT(p.numbers("f", {}), ElementsAre(1, 2, 3));
  p.finish();
  EXPECT_EQ(r.text(), "");
}

TEST(Params, AbsentKeysGiveDefaults) {
  Reading r("");
  EXPECT_EQ(r.params.number("n", 1.5), 1.5);
  EXPECT_EQ(r.params.word("w", "exact", {"exact", "fast"}), "exact");
  EXPECT_THAT((r.params.vec<3>("v", {1, 2, 3})), ElementsAre(1, 2, 3));
  EXPECT_EQ(r.params.table("t").integer("n", 7), 7);
  EXPECT_TRUE(r.params.tables("ts").empty());
  r.params.finish();
  EXPECT_TRUE(r.diagnostics.empty());
}

TEST(Params, WrongValuesAreReportedAndReplaced) {
  Reading r("n = 'x'\ni = 1.5\nb = 1\nv = [1, 2, 3]\nl = [1]\nt = 1\nts = [1]\ninf = inf\nshort = '#12'\nodd = '#12345g'");
  EXPECT_EQ(r.params.number("n", 9), 9);
  EXPECT_EQ(r.params.integer("i", 9), 9);
  EXPECT_EQ(r.params.boolean("b", true), true);
  EXPECT_THAT((r.params.vec<2>("v", {4, 5})), ElementsAre(4, 5));
  EXPECT_THAT(r.params.strings("l", {"z"}), ElementsAre("z"));
  (void)r.params.table("t");
  (void)r.params.tables("ts");
  EXPECT_EQ(r.params.number("inf", 9), 9);
  (void)r.params.color("short", {});
  (void)r.params.color("odd", {});
  r.params.finish();
  std::vector<std::string> codes;
  for (const Diagnostic& d : r.diagnostics.list()) codes.push_back(d.code);
  EXPECT_THAT(codes, ElementsAre("G020", "G020", "G020", "G020", "G020", "G020", "G020", "G022", "G024", "G024")) << r.text();
  EXPECT_THAT(r.text(), HasSubstr("dir/p.toml:2:5: error G020: pass 'glow' parameter 'i' is a number (1.5), but must be an integer."));
  EXPECT_THAT(r.text(), HasSubstr("'v' is an array ([1, 2, 3]), but must be an array of 2 numbers."));
  EXPECT_THAT(r.text(), HasSubstr("'inf' is inf, but must be finite."));
}

TEST(Params, RangesAreInclusiveUnlessOpen) {
  Reading r("a = 1\nb = 1\nc = 2.5");
  EXPECT_EQ(r.params.number("a", 0, {.min = 1, .max = 2}), 1);
  EXPECT_EQ(r.params.number("b", 5, {.min = 1, .open_min = true}), 5);
  EXPECT_EQ(r.params.number("c", 2, {.min = 1, .max = 2}), 2);
  EXPECT_THAT(r.text(), HasSubstr("'b' is 1, but must be > 1."));
  EXPECT_THAT(r.text(), HasSubstr("'c' is 2.5, but must be >= 1, <= 2."));
}

TEST(Params, UnreadKeysOfAllLevels) {
  Reading r("a = 1\nsamples = { n = 4, pattrn = 'grid' }\nlights = [ { x = 1 }, { y = 2 } ]");
  Params samples = r.params.table("samples");
  samples.integer("n", 1);
  samples.string("pattern", "grid");
  for (Params& light : r.params.tables("lights")) light.integer("x", 0);
  r.params.finish();
  EXPECT_THAT(r.text(), HasSubstr(":1:1: error G021: pass 'glow' parameter 'a' is not known to kind 'blur'.\n    parameters: lights, samples."));
  EXPECT_THAT(r.text(), HasSubstr(":2:20: error G021: pass 'glow' parameter 'samples.pattrn' is not known"));
  EXPECT_THAT(r.text(), HasSubstr("Did you mean 'pattern'?"));
  EXPECT_THAT(r.text(), HasSubstr("parameter 'lights.y' is not known"));
  EXPECT_EQ(r.diagnostics.list().size(), 3u);
}

TEST(Params, ANumberOrATable) {
  Reading r("samples = 16\nmore = { n = 4 }\ntext = 'x'");
  EXPECT_FALSE(r.params.is_table("samples"));
  EXPECT_TRUE(r.params.is_table("more"));
  EXPECT_TRUE(r.params.is_string("text"));
  EXPECT_FALSE(r.params.has("none"));
  EXPECT_EQ(r.params.loc("more").line, 2u);
}

TEST(Params, DrawListsAndOwnErrors) {
  Diagnostics diagnostics;
  const SourceLoc third{"f", 3, 9}, fourth{"f", 4, 9};
  DrawList unnamed, far{.name = "far"};
  unnamed.items.push_back({"sphere", third});
  far.items.push_back({"cone", fourth});
  Params p({}, std::vector<DrawList>{unnamed, far}, "a", "k", {"f", 1, 1}, diagnostics);
  ASSERT_EQ(p.draw().size(), 1u);
  EXPECT_EQ(p.draw()[0].text, "sphere");
  EXPECT_EQ(p.draw("far")[0].loc.line, 4u);
  EXPECT_TRUE(p.draw("none").empty());
  EXPECT_EQ(p.draw_lists().size(), 2u);
  p.finish();
  EXPECT_TRUE(diagnostics.empty());
  p.error("X001", "mode", "does not suit 'draw'.");
  EXPECT_EQ(to_string(diagnostics), "f:1:1: error X001: pass 'a' parameter 'mode' does not suit 'draw'.\n");
}

TEST(Params, DescribesWhatIsAsked) {
  Params p;
  p.number("exposure", 0.5, {.min = -20, .max = 20}, "stops");
  p.word("mode", "fast", {"fast", "exact"});
  p.table("samples").integer("n", 16, {.min = 1});
  p.number("exposure", 0.5);
  ASSERT_EQ(p.asked().size(), 4u);
  EXPECT_EQ(p.asked()[0].fallback, "0.5");
  EXPECT_EQ(p.asked()[0].range, ">= -20, <= 20");
  EXPECT_EQ(p.asked()[0].summary, "stops");
  EXPECT_EQ(p.asked()[1].range, "fast, exact");
  EXPECT_EQ(p.asked()[3].name, "samples.n");
}

TEST(Settings, ReplaceAndAddParameters) {
  const std::string graph = "schema = 1\noutput = 'display.color'\n[[pass]]\nname = 'opaque'\nkind = 'opaque_impostors'\n[[pass]]\nname = 'glyphs'\nkind = 'sorted_glyphs'\n"
                            "inputs = { color = 'opaque.color', depth = 'opaque.depth' }\nparams = { samples = { n = 2 } }\n[[pass]]\nname = 'display'\nkind = 'ocio_tonemap'\ninputs = { color = 'glyphs.color' }\n";
  auto text = [&](std::vector<std::string> settings) { return to_string(compile_text(graph, {}, settings).diagnostics); };
  EXPECT_EQ(text({"display.exposure=2", "display.view=ACES SDR", "glyphs.samples.n=8"}), "");
  EXPECT_THAT(text({"display.exposure=42"}), HasSubstr("--set: error G022: pass 'display' parameter 'exposure' is 42"));
  EXPECT_THAT(text({"display.exposure=a lot"}), HasSubstr("--set: error G020: pass 'display' parameter 'exposure' is a string (\"a lot\")"));
  EXPECT_THAT(text({"display.expo=1"}), HasSubstr("--set: error G021: pass 'display' parameter 'expo' is not known"));
  EXPECT_THAT(text({"glyphs.samples.m=8"}), HasSubstr("--set: error G021: pass 'glyphs' parameter 'samples.m'"));
  EXPECT_THAT(text({"dsplay.exposure=1"}), HasSubstr("--set: error G026: 'dsplay.exposure=1' names the pass 'dsplay', which the graph does not have.\n    passes: opaque, glyphs, display.\n    Did you mean 'display'?"));
  for (const char* bad : {"exposure=1", "display.exposure", "display.=1", "=1", ""}) EXPECT_THAT(text({bad}), HasSubstr("--set: error G008:")) << bad;
  const CompileResult off = compile_text(graph, {}, {"glyphs.enabled=false"});
  ASSERT_TRUE(off.plan) << check_text(off);
  EXPECT_EQ(off.plan->passes.size(), 2u);
  EXPECT_THAT(text({"glyphs.enabled=maybe"}), HasSubstr("--set: error G004:"));
}

TEST(Values, SettingsAreTomlOrText) {
  EXPECT_EQ(to_text(parse_setting("[1, 2.5, true]", {"--set"})), "[1, 2.5, true]");
  EXPECT_EQ(to_text(parse_setting("ACES SDR", {"--set"})), "\"ACES SDR\"");
  EXPECT_EQ(to_text(parse_setting("1\nx = 2", {"--set"})), "\"1\nx = 2\"");
  EXPECT_EQ(to_text(parse_setting("{ a = 'b' }", {"--set"})), "{ a = \"b\" }");
  EXPECT_EQ(parse_setting("[1]", {"--set"}).loc, SourceLoc{"--set"});
}

} // namespace
} // namespace mote::rg::test
