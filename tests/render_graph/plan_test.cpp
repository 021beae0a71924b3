// SPDX-License-Identifier: MIT
#include "fake_kinds.hpp"
#include "goldens.hpp"
#include "render_graph/lifetimes.hpp"
#include "render_graph/successors.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace mote::rg::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const PlannedPass& pass_of(const Plan& plan, std::string_view name) {
  const auto it = std::find_if(plan.passes.begin(), plan.passes.end(), [&](const PlannedPass& p) { return p.name == name; });
  if (it == plan.passes.end()) throw std::runtime_error("no pass " + std::string(name));
  return *it;
}
const Use& use_of(const Plan& plan, std::string_view pass, std::string_view slot, bool output = false) {
  for (const Use& use : pass_of(plan, pass).uses)
    if (use.slot == slot && (!output || !use.gives.empty())) return use;
  throw std::runtime_error("no slot " + std::string(slot));
}
std::vector<std::string> names(const Plan& plan) {
  std::vector<std::string> out;
  for (const PlannedPass& pass : plan.passes) out.push_back(pass.name);
  return out;
}
Plan plan_of(const std::string& toml, const CompileOptions& options = {}) {
  const CompileResult result = compile_text(toml, options);
  if (!result.plan) throw std::runtime_error(check_text(result));
  return *result.plan;
}

const std::string opaque = "[[pass]]\nname = 'opaque'\nkind = 'opaque_impostors'\n";
const std::string over = "[[pass]]\nname = 'over'\nkind = 'paint'\ninputs = { color = 'opaque.color' }\n";
const std::string head = "schema = 1\noutput = 'display.color'\n";
std::string display(const std::string& source) { return "[[pass]]\nname = 'display'\nkind = 'ocio_tonemap'\ninputs = { color = '" + source + "' }\n"; }
std::string blur(const std::string& name, const std::string& source) {
  return "[[pass]]\nname = '" + name + "'\nkind = 'blur'\ninputs = { source = '" + source + "' }\nparams = { radius = 2 }\n";
}

// An output may stay where its one kind of readers looks for it only if nobody else does.
TEST(Readers, OfOneKind) {
  const std::string shadow = "[[pass]]\nname = 'shadow'\nkind = 'shadow_map'\n", lit = opaque + "inputs = { shadow = 'shadow.depth' }\n";
  const auto only = [](const std::string& toml, std::string_view kind) {
    const Plan plan = plan_of(toml);
    const auto pass = std::find_if(plan.passes.begin(), plan.passes.end(), [](const PlannedPass& p) { return p.name == "shadow"; });
    return only_sampled_by(plan, static_cast<std::size_t>(pass - plan.passes.begin()), "depth", kind);
  };
  EXPECT_TRUE(only(head + shadow + lit + display("opaque.color"), "opaque_impostors"));
  EXPECT_FALSE(only(head + shadow + lit + display("opaque.color"), "blur"));
  const std::string second = "[[pass]]\nname = 'glyphs'\nkind = 'sorted_glyphs'\ninputs = { color = 'opaque.color', depth = 'opaque.depth', shadow = 'shadow.depth' }\n";
  EXPECT_FALSE(only(head + shadow + lit + second + display("glyphs.color"), "opaque_impostors")) << "another kind reads it, too";
  EXPECT_FALSE(only("schema = 1\noutput = 'shadow.depth'\n" + shadow, "opaque_impostors")) << "it is the picture";
}

class GoodGraph : public testing::TestWithParam<std::string> {};
TEST_P(GoodGraph, PlanAndDrawingAreAsRecorded) {
  const bool shipped = GetParam() == "default";
  const auto file = shipped ? std::filesystem::path(MOTE_SOURCE_DIR) / "app/graphs/default.toml" : here() / "good" / (GetParam() + ".toml");
  const CompileResult result = compile_file(file.string(), fake_registry());
  ASSERT_TRUE(result.plan) << check_text(result);
  expect_golden(here() / "good" / (GetParam() + ".plan.txt"), to_text(*result.plan));
  expect_golden(here() / "good" / (GetParam() + ".dot"), to_dot(*result.plan));
  EXPECT_EQ(*result.plan, *compile_file(file.string(), fake_registry()).plan);
}
INSTANTIATE_TEST_SUITE_P(Files, GoodGraph, testing::Values("default", "full", "device_sort", "memory"));

TEST(Kinds, TextAndJsonListSlotsAndParameters) {
  expect_golden(here() / "good/kinds.txt", kinds_text(fake_registry()));
  const auto json = nlohmann::json::parse(kinds_json(fake_registry()));
  const auto& kinds = json["kinds"];
  ASSERT_EQ(kinds.size(), 9u);
  EXPECT_EQ(kinds[3]["name"], "ocio_tonemap");
  EXPECT_EQ(kinds[3]["inputs"][0]["name"], "color");
  EXPECT_EQ(kinds[3]["outputs"][0]["makes"], "rgba8unorm view");
  EXPECT_EQ(kinds[3]["params"][0]["default"], "0");
  EXPECT_EQ(kinds[0]["outputs"][0]["state"], true);
  EXPECT_EQ(kinds[2]["inputs"][0]["type"], "buffer");
  EXPECT_EQ(kinds[4]["draws"], true);
}

TEST(Kinds, BugsOfAKindAreCaught) {
  auto declare = [](Slot slot) {
    Registry registry;
    add_kind(registry, "odd", "", [slot](auto& slots, Params&) { slots.push_back(slot); });
    (void)describe(registry);
  };
  const TextureSpec spec = texture(gpu::TextureFormat::R32Float);
  EXPECT_NO_THROW(declare({.name = "a", .access = Access::ColorWrite, .makes = spec}));
  EXPECT_THROW(declare({.name = "a", .access = Access::ColorWrite}), std::logic_error);
  EXPECT_THROW(declare({.name = "A", .access = Access::ColorWrite, .makes = spec}), std::logic_error);
  EXPECT_THROW(declare({.name = "a", .access = Access::Sampled, .makes = spec}), std::logic_error);
  EXPECT_THROW(declare({.name = "a", .access = Access::ColorWrite, .makes = spec, .state = true}), std::logic_error);
  EXPECT_THROW(declare({.name = "a", .access = Access::ColorWrite, .makes = BufferSpec{4, 1}}), std::logic_error);
  EXPECT_THROW(declare({.name = "a", .access = Access::Indirect}), std::logic_error);
  Registry twice = fake_registry();
  EXPECT_THROW(add_kind(twice, "blur", "", [](auto&, Params&) {}), std::logic_error);
  EXPECT_THROW(twice.add({"nothing", "", nullptr}), std::logic_error);
}

TEST(Plan, FileOrderDoesNotDecideWhatMustComeFirst) {
  const std::string good = head + opaque + blur("one", "opaque.color") + blur("two", "one.color") + display("two.color");
  const std::string reversed = head + display("two.color") + blur("two", "one.color") + blur("one", "opaque.color") + opaque;
  EXPECT_EQ(plan_of(good), plan_of(reversed));
  EXPECT_THAT(names(plan_of(reversed)), ElementsAre("opaque", "one", "two", "display"));
}

TEST(Plan, FileOrderBreaksTies) {
  const std::string paints = "[[pass]]\nname = 'c'\nkind = 'paint'\n[[pass]]\nname = 'a'\nkind = 'paint'\n[[pass]]\nname = 'b'\nkind = 'paint'\ninputs = { color = 'a.color', mask = 'c.color' }\n";
  EXPECT_THAT(names(plan_of(head + paints + display("b.color"))), ElementsAre("c", "a", "b", "display"));
}

TEST(Plan, AReaderOfWhatIsDrawnOverRunsFirst) {
  const std::string marks = "[[pass]]\nname = 'over'\nkind = 'paint'\ninputs = { color = 'opaque.color' }\n[[pass]]\nname = 'soft'\nkind = 'blur'\ninputs = { source = 'opaque.color' }\nparams = { radius = 1 }\n"
                            "[[pass]]\nname = 'both'\nkind = 'paint'\ninputs = { color = 'over.color', mask = 'soft.color' }\n";
  const Plan plan = plan_of(head + opaque + marks + display("both.color"));
  EXPECT_THAT(names(plan), ElementsAre("opaque", "soft", "over", "both", "display"));
  EXPECT_EQ(use_of(plan, "over", "color").resource, use_of(plan, "opaque", "color").resource) << "drawn over in place";
}

TEST(Plan, CullingKeepsReasons) {
  const std::string spare = blur("soft", "opaque.color") + blur("softer", "soft.color") + "[[pass]]\nname = 'off'\nkind = 'paint'\nenabled = false\n";
  const CompileResult result = compile_text(head + opaque + spare + display("opaque.color"));
  ASSERT_TRUE(result.plan);
  EXPECT_THAT(names(*result.plan), ElementsAre("opaque", "display"));
  EXPECT_THAT(result.plan->culled, ElementsAre(Culled{"soft", "blur", "only 'softer' reads its outputs, and nothing needs that"}, Culled{"softer", "blur", "nothing reads its outputs"},
                                               Culled{"off", "paint", "enabled = false"}));
  EXPECT_EQ(result.diagnostics.list().size(), 2u) << "a note each; what the file itself disables needs none";
  EXPECT_EQ(result.diagnostics.list()[0].severity, Severity::Note);
}

TEST(Plan, OptionalOutputsAreMadeOnlyWhenWanted) {
  const std::string graph = head + opaque + display("opaque.color");
  const Plan plain = plan_of(graph);
  EXPECT_THAT(pass_of(plain, "opaque").left_out, ElementsAre("shadow", "aov_depth", "aov_id", "aov_normal"));
  const Plan with = plan_of(graph, {.roots = {{"opaque.aov_id", {"--aov"}}}});
  EXPECT_THAT(pass_of(with, "opaque").left_out, ElementsAre("shadow", "aov_depth", "aov_normal"));
  const Use& id = use_of(with, "opaque", "aov_id");
  EXPECT_EQ(id.store, gpu::StoreOp::Store);
  EXPECT_EQ(with.roots[1], (Root{"opaque.aov_id", false, id.resource}));
  EXPECT_TRUE(has(with.textures[id.resource].usage, gpu::TextureUsage::CopySrc));
  const Plan read = plan_of(head + opaque + display("opaque.aov_normal"));
  EXPECT_THAT(pass_of(read, "opaque").left_out, ElementsAre("shadow", "aov_depth", "aov_id"));
}

TEST(Plan, LoadAndStore) {
  const Plan plan = plan_of(head + opaque + over + display("over.color"));
  EXPECT_EQ(use_of(plan, "opaque", "color").load, gpu::LoadOp::Clear);
  EXPECT_EQ(use_of(plan, "opaque", "color").store, gpu::StoreOp::Store);
  EXPECT_EQ(use_of(plan, "opaque", "depth").store, gpu::StoreOp::Discard) << "nobody reads it";
  EXPECT_EQ(use_of(plan, "over", "color").load, gpu::LoadOp::Load);
  EXPECT_EQ(use_of(plan, "over", "color").store, gpu::StoreOp::Store);
  EXPECT_EQ(use_of(plan, "display", "color", true).load, gpu::LoadOp::DontCare) << "covers every pixel";
}

TEST(Plan, ReadWriteWithoutSourceStartsAfresh) {
  const Plan plan = plan_of(head + "[[pass]]\nname = 'over'\nkind = 'paint'\n" + display("over.color"));
  EXPECT_EQ(use_of(plan, "over", "color").load, gpu::LoadOp::Clear);
  EXPECT_EQ(use_of(plan, "over", "color").source, "");
}

TEST(Plan, ARootThatIsDrawnOverIsCopied) {
  const std::string graph = head + opaque + over + display("over.color");
  EXPECT_TRUE(plan_of(graph).copies.empty());
  const Plan plan = plan_of(graph, {.roots = {{"opaque.color", {"--dump"}}, {"over.color", {"--dump"}}}});
  ASSERT_EQ(plan.copies.size(), 1u);
  const auto color = use_of(plan, "opaque", "color").resource;
  EXPECT_EQ(plan.copies[0].after, 0u);
  EXPECT_EQ(plan.copies[0].from, color);
  EXPECT_EQ(plan.roots[1].resource, plan.copies[0].to);
  EXPECT_EQ(plan.roots[2].resource, color);
  EXPECT_NE(plan.textures[plan.copies[0].to].physical, plan.textures[color].physical);
  EXPECT_THAT(names(plan), ElementsAre("opaque", "over", "display")) << "requests never edit the graph";
}

TEST(Plan, DisabledReadWritePassesAreTransparent) {
  const std::string off = "[[pass]]\nname = 'off'\nkind = 'paint'\nenabled = false\ninputs = { color = 'over.color' }\n";
  EXPECT_EQ(use_of(plan_of(head + opaque + over + off + display("off.color")), "display", "color").source, "over.color");
  const std::string shadow = "[[pass]]\nname = 'sun'\nkind = 'shadow_map'\nenabled = false\n[[pass]]\nname = 'opaque'\nkind = 'opaque_impostors'\ninputs = { shadow = 'sun.depth' }\n";
  const Plan plan = plan_of(head + shadow + display("opaque.color"));
  EXPECT_THAT(pass_of(plan, "opaque").left_out, testing::Contains("shadow")) << "an optional input of a disabled pass is not connected";
}

TEST(Plan, StateIsLoadedStoredAndNeverShared) {
  const std::string sum = "[[pass]]\nname = 'sum'\nkind = 'accumulate'\ninputs = { source = 'opaque.color' }\n";
  const Plan plan = plan_of(head + opaque + sum + display("sum.sum"));
  const Use& use = use_of(plan, "sum", "sum");
  EXPECT_TRUE(use.state);
  EXPECT_EQ(use.load, gpu::LoadOp::Load);
  EXPECT_EQ(use.store, gpu::StoreOp::Store);
  for (const PlannedTexture& other : plan.textures)
    EXPECT_TRUE(other.name == "sum.sum" || other.physical != plan.textures[use.resource].physical) << other.name;
}

TEST(Plan, SizesAreSymbolicAndInherited) {
  const std::string half = blur("half", "opaque.color") + "outputs = { color = { size = { view = 0.5 } } }\n";
  const Plan plan = plan_of(head + opaque + half + blur("more", "half.color") + display("more.color"));
  const TextureSpec& more = plan.textures[use_of(plan, "more", "color").resource].spec;
  EXPECT_EQ(more.size.factor, 0.5);
  EXPECT_EQ(more.format, gpu::TextureFormat::RGBA16Float);
  EXPECT_EQ(extent_of(more, 101, 1), (gpu::Extent3d{51, 1, 1}));
}

TEST(Plan, LimitsOfADevice) {
  const Plan plan = plan_of(head + opaque + display("opaque.color"));
  gpu::Limits limits{.max_texture_dimension_2d = 4096, .max_texture_array_layers = 256, .max_storage_buffer_binding_size = 1 << 20, .max_buffer_size = 1 << 20, .max_color_attachments = 4};
  EXPECT_TRUE(check_limits(plan, limits, 4096, 16).empty());
  EXPECT_THAT(to_string(check_limits(plan, limits, 4097, 16)), HasSubstr("error G070: the width of 'opaque.color' is 4097 for a view of 4097x16, but the device allows 4096."));
  limits.max_color_attachments = 1;
  EXPECT_TRUE(check_limits(plan, limits, 16, 16).empty());
  EXPECT_TRUE(check_limits(plan_of(head + opaque + display("opaque.color"), {.roots = {{"opaque.aov_id", {}}}}), limits, 16, 16).has("G070"));
  EXPECT_EQ(bytes_of(plan, 10, 10), 100u * (8 + 4 + 4));
}

TEST(SharedMemory, OnlyEqualSpecsWhoseLivesDoNotMeet) {
  EXPECT_THAT(share_memory({{0, 1, false, false, 0}, {1, 2, false, false, 0}, {2, 3, false, false, 0}}), ElementsAre(0, 1, 0));
  EXPECT_THAT(share_memory({{0, 1, false, false, 0}, {2, 3, false, false, 1}}), ElementsAre(0, 1));
  EXPECT_THAT(share_memory({{0, 1, true, false, 0}, {2, 3, false, false, 0}, {4, 5, true, false, 0}}), ElementsAre(0, 1, 2)) << "state is alone";
  EXPECT_THAT(share_memory({{0, 1, false, true, 0}, {2, 3, false, false, 0}}), ElementsAre(0, 1)) << "a root is kept to the end";
}

} // namespace
} // namespace mote::rg::test
