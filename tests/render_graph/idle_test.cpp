// SPDX-License-Identifier: MIT
// Which passes a frame leaves out.
#include "fake_kinds.hpp"
#include "goldens.hpp"
#include "render_graph/idle.hpp"

#include <gmock/gmock.h>

namespace mote::rg::test {
namespace {

using testing::ElementsAre;

// sun_shadow, opaque, glyphs, display; the marks pass is disabled, soft and softer are culled
Plan full(const CompileOptions& options = {}) { return *compile_file((here() / "good/full.toml").string(), fake_registry(), options).plan; }

TEST(Idle, NobodyIsLeftOutWithoutAReason) { EXPECT_THAT(choose_passes(full(), {"", "", "", ""}).skipped, ElementsAre("", "", "", "")); }

TEST(Idle, AnOptionalInputGoesMissing) {
  const FrameChoice choice = choose_passes(full(), {"no light casts shadows", "", "", ""});
  EXPECT_THAT(choice.skipped, ElementsAre("no light casts shadows", "", "", ""));
  EXPECT_THAT(choice.missing[1], ElementsAre(true, false, false)) << "opaque: shadow, color, depth";
  EXPECT_THAT(choice.missing[2], ElementsAre(false, false, true)) << "glyphs: color, depth, shadow";
}

TEST(Idle, AReadWritePassLetsItsSourceThrough) {
  const FrameChoice choice = choose_passes(full(), {"", "", "no transparent particle", ""});
  EXPECT_THAT(choice.skipped, ElementsAre("", "", "no transparent particle", ""));
  EXPECT_THAT(choice.missing[3], ElementsAre(false, false));
}

TEST(Idle, ANeededPassRunsAllTheSame) {
  EXPECT_THAT(choose_passes(full(), {"", "nothing to draw", "", ""}).skipped, ElementsAre("", "", "", ""));
  EXPECT_THAT(choose_passes(full(), {"", "", "", "no"}).skipped, ElementsAre("", "", "", ""));
  const Plan rooted = full({.roots = {{"sun_shadow.depth", {"--dump"}}}});
  EXPECT_THAT(choose_passes(rooted, {"no light casts shadows", "", "", ""}).skipped, ElementsAre("", "", "", "")) << "somebody wants to see it";
}

TEST(Idle, WhatOnlyIdlePassesReadIsLeftOutToo) {
  const CompileResult result = compile_text("schema = 1\noutput = 'over.color'\n[[pass]]\nname = 'mask'\nkind = 'paint'\n[[pass]]\nname = 'canvas'\nkind = 'paint'\n"
                                            "[[pass]]\nname = 'over'\nkind = 'paint'\ninputs = { color = 'canvas.color', mask = 'mask.color' }\n");
  ASSERT_TRUE(result.plan) << check_text(result);
  EXPECT_THAT(choose_passes(*result.plan, {"", "", "nothing to paint"}).skipped, ElementsAre("nothing reads it in this frame", "", "nothing to paint"));
  const FrameChoice fresh = choose_passes(*result.plan, {"", "empty", ""});
  EXPECT_THAT(fresh.skipped, ElementsAre("", "empty", "")) << "paint can start a canvas of its own";
  EXPECT_THAT(fresh.missing[2], ElementsAre(true, false));
}

TEST(Idle, StateIsKeptGoing) {
  const CompileResult result = compile_text("schema = 1\noutput = 'over.color'\n[[pass]]\nname = 'c'\nkind = 'paint'\n[[pass]]\nname = 'sum'\nkind = 'accumulate'\ninputs = { source = 'c.color' }\n"
                                            "[[pass]]\nname = 'base'\nkind = 'paint'\n[[pass]]\nname = 'over'\nkind = 'paint'\ninputs = { color = 'base.color', mask = 'sum.sum' }\n");
  ASSERT_TRUE(result.plan) << check_text(result);
  EXPECT_THAT(choose_passes(*result.plan, {"", "", "", "idle"}).skipped, ElementsAre("", "", "", "idle"));
}

} // namespace
} // namespace mote::rg::test
