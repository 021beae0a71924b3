// SPDX-License-Identifier: MIT
// Several samples a pixel: the patterns without a device, and pictures against the reference's area
// average. Depth, id and normal stay those of the pixel's center.
#include "discs.hpp"

#include "passes/sampling/pattern.hpp"
#include "render_graph/compile.hpp"
#include "passes/builtin.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

namespace mote::test {
namespace {

using namespace mote::passes;
using testing::HasSubstr;

TEST(SamplePatterns, LieInThePixelAndAreRepeatable) {
  for (int p = 0; p < 4; ++p)
    for (const std::uint32_t n : {1u, 4u, 16u, 64u}) {
      const auto offsets = sample_offsets(static_cast<SamplePattern>(p), n);
      ASSERT_TRUE(offsets);
      ASSERT_EQ(offsets->size(), n);
      EXPECT_EQ(offsets, sample_offsets(static_cast<SamplePattern>(p), n));
      for (const glm::dvec2& o : *offsets) EXPECT_TRUE(o.x >= 0 && o.x < 1 && o.y >= 0 && o.y < 1);
    }
}

TEST(SamplePatterns, RegularAndJitteredTakeOneOfEachCell) {
  for (const SamplePattern p : {SamplePattern::Regular, SamplePattern::Jittered}) {
    std::set<std::pair<int, int>> cells;
    const auto offsets = sample_offsets(p, 25);
    for (const glm::dvec2& o : *offsets) cells.insert({static_cast<int>(o.x * 5), static_cast<int>(o.y * 5)});
    EXPECT_EQ(cells.size(), 25u);
    EXPECT_FALSE(sample_offsets(p, 24));
  }
  EXPECT_EQ((*sample_offsets(SamplePattern::Regular, 4))[3], glm::dvec2(0.75, 0.75));
}

TEST(SamplePatterns, PoissonKeepsItsDistance) {
  const auto offsets = *sample_offsets(SamplePattern::Poisson, 32);
  double least = 1.0;
  for (std::size_t i = 0; i < offsets.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const glm::dvec2 d = glm::abs(offsets[i] - offsets[k]);
      least = std::min(least, glm::length(glm::min(d, 1.0 - d)));
    }
  EXPECT_GT(least, 0.5 / std::sqrt(32.0));
}

std::string problems_of(const std::string& samples) {
  rg::Registry registry;
  register_builtin_passes(registry);
  Diagnostics found;
  const rg::GraphDesc graph = rg::parse_graph("schema = 1\noutput = 'o.color'\n[[pass]]\nname = 'o'\nkind = 'opaque_impostors'\nparams = { samples = " + samples + " }\n", "g.toml", found);
  return to_string(rg::compile(graph, registry, {}, found).diagnostics);
}

TEST(SamplePatterns, WhatCannotBeIsSaid) {
  EXPECT_EQ(problems_of("{ pattern = 'poisson', n = 7 }"), "");
  EXPECT_EQ(problems_of("16"), "");
  EXPECT_THAT(problems_of("{ pattern = 'jittered', n = 15 }"),
              testing::AllOf(HasSubstr("g.toml:6:50: error P007: pass 'o' parameter 'samples.n' is 15, but the pattern 'jittered' makes square numbers only"),
                             HasSubstr("nearest are 9 and 16")));
  EXPECT_THAT(problems_of("{ pattern = 'regular', n = 2 }"), HasSubstr("nearest are 1 and 4"));
  EXPECT_THAT(problems_of("{ pattern = 'halton', n = 16 }"), testing::AllOf(HasSubstr("error G023"), HasSubstr("poisson")));
  EXPECT_THAT(problems_of("{ pattern = 'random', n = 0 }"), HasSubstr("error G022"));
  EXPECT_THAT(problems_of("{ pattern = 'random', n = 100000 }"), HasSubstr("error G022"));
  EXPECT_THAT(problems_of("'many'"), HasSubstr("error G020"));
}

INSTANTIATE_TEST_SUITE_P(, Samples, testing::Values(passes::Expansion::Vertex, passes::Expansion::Compute), [](const auto& p) { return std::string(to_string(p.param)); });

TEST_P(Samples, ErrorsOfThePatternsOnEdges) {
  const Scene scene = discs();
  const auto area = render_reference_area(reference::build_world(scene), view(scene), 16);
  const auto error = [&](const std::string& samples) { return edge_error(draw(scene, view(scene), {}, {"opaque.samples=" + samples}), area); };
  EXPECT_GT(error("1"), 0.2);
  EXPECT_LE(error("{ pattern = \"jittered\", n = 16 }"), 0.045);
  EXPECT_EQ(tiled_, GetParam() == passes::Expansion::Compute);
  EXPECT_LE(error("{ pattern = \"regular\", n = 16 }"), 0.04);
  EXPECT_LE(error("{ pattern = \"poisson\", n = 16 }"), 0.065);
  EXPECT_LE(error("{ pattern = \"random\", n = 16 }"), 0.12);
  EXPECT_LE(error("{ pattern = \"jittered\", n = 64 }"), 0.018);
}

TEST_P(Samples, AovsAreThoseOfThePixelsCenter) {
  Scene scene = discs();
  const Picture one = draw(scene, view(scene)), many = draw(scene, view(scene), {}, {"opaque.samples=4"});
  EXPECT_EQ(one.id, many.id);
  EXPECT_EQ(one.depth, many.depth);
  EXPECT_EQ(one.normal, many.normal);
  EXPECT_NE(one.color, many.color);
}

// Averaged in scene-linear light: half a pixel of white over black shows as 188, not as 128.
TEST_P(Samples, AverageBeforeTheDisplayTransform) {
  Scene scene = scene_of({{0, 0, 0, 1000}}, {0xFFFFFFFFu});
  scene.background = {0, 0, 0, 1};
  scene.ambient = {1, 1, 1};
  scene.lights.clear();
  const View view = look_orthographic(scene, {1000, 0, 5000}, {1000, 0, 0}, {9, 9}, 9); // the edge runs through pixel 4
  const Picture p = draw(scene, view, {}, {"opaque.samples={ pattern = \"regular\", n = 64 }"});
  EXPECT_NEAR(p.color[p.at(4, 4)].g, 0.5f, 1e-3f);
  EXPECT_NEAR(p.display[p.at(4, 4)].g, 188, 1);
}

TEST_P(Samples, ATransparentBackgroundKeepsStraightColor) {
  Scene scene = discs();
  scene.background = {0, 0, 0, 0};
  const Picture p = draw(scene, view(scene), {}, {"opaque.samples=16"});
  std::size_t partly = 0;
  for (const glm::vec4& c : p.color)
    if (c.a > 0.01f && c.a < 0.99f) {
      ++partly;
      EXPECT_NEAR(c.g, 1.0f, 2e-3f);
    }
  EXPECT_GT(partly, 1000u);
}

TEST_P(Samples, WithShadows) {
  graph_ = "shadowed";
  Scene scene = scene_of({{0, 0, 0, 2}, {0, 5, 0, 0.5}});
  scene.lights = {{.name = "sun", .kind = LightKind::Directional, .direction = {0, -1, 0}, .intensity = 0.8, .shadows = true}};
  const View camera = look(scene, {0, 12, 12}, {0, 2, 0}, {120, 120});
  const auto area = render_reference_area(reference::build_world(scene), camera, 16);
  for (const std::string method : {"ids", "depth"}) {
    const Picture p = draw(scene, camera, {}, {"opaque.samples=16", method == "ids" ? "shadow.size=1024" : "shadow.size=2048", "shadow.method=\"" + method + "\""});
    double sum = 0;
    for (std::size_t i = 0; i < area.size(); ++i) sum += std::pow(p.color[i].g - area[i].g, 2);
    EXPECT_LE(std::sqrt(sum / static_cast<double>(area.size())), method == "ids" ? 0.006 : 0.012) << method;
    EXPECT_EQ(p.id[p.at(60, 75)], 0u) << method << ": AOVs are those of the centers";
  }
}

} // namespace
} // namespace mote::test
