// SPDX-License-Identifier: MIT
// Several samples a pixel: the patterns without a device, and pictures against the reference's area
// average. Depth, id and normal stay those of the pixel's center.
#include "harness.hpp"

#include "core/reference/reference.hpp"
#include "passes/particles/expansion_choice.hpp"
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

class Discs : public GpuTest {
protected:
  // White unlit discs of 3 to 30 px on black: color is coverage.
  static Scene discs() {
    std::vector<glm::dvec4> spheres;
    double x = 0;
    for (int i = 0; i < 24; ++i) {
      const double r = 3.0 * std::pow(10.0, i / 23.0);
      x += r + 2.3;
      spheres.push_back({x, 40.0 * std::sin(1.7 * i), 0.1 * i, r});
      x += r;
    }
    Scene scene = scene_of(spheres, {0xFFFFFFFFu});
    scene.background = {0, 0, 0, 1};
    scene.ambient = {1, 1, 1};
    scene.lights.clear();
    return scene;
  }
  static View view(const Scene& scene) { // one unit a pixel
    const double width = scene.bounds.max.x - scene.bounds.min.x + 8;
    return look_orthographic(scene, {0.5 * (scene.bounds.min.x + scene.bounds.max.x) + 0.13, 0.29, 5000}, {0.5 * (scene.bounds.min.x + scene.bounds.max.x) + 0.13, 0.29, 0},
                             {static_cast<std::uint32_t>(width), 160}, 160);
  }
  // RMS of coverage over the pixels that an edge crosses.
  static double edge_error(const Picture& p, const std::vector<glm::dvec4>& area) {
    double sum = 0;
    std::size_t edges = 0;
    for (std::size_t i = 0; i < area.size(); ++i)
      if (area[i].g > 0.002 && area[i].g < 0.998) ++edges, sum += std::pow(p.color[i].g - area[i].g, 2);
    EXPECT_GT(edges, 1000u);
    return std::sqrt(sum / static_cast<double>(edges));
  }
};

// Several samples a pixel, by quads and by tiles.
class Samples : public Discs, public testing::WithParamInterface<passes::Expansion> {
protected:
  Picture draw(const Scene& scene, const View& view, passes::FrameOptions options = {}, const std::vector<std::string>& settings = {}) {
    options.expansion = GetParam();
    options.chosen = [this](const passes::ExpansionReport& report) { tiled_ = report.tiled > 0; };
    return GpuTest::draw(scene, view, options, settings);
  }
  bool tiled_{}; // whether the last picture had tiles
};
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
// ---- analytic edges ----------------------------------------------------------------------------------
class AnalyticEdges : public Samples {
protected:
  // Discs of one radius (pixels) on a grid, at many places relative to the pixels; `move` shifts all.
  static Scene grid(double radius, int n, double spacing, glm::dvec2 move = {0, 0}) {
    std::vector<glm::dvec4> spheres;
    for (int i = 0; i < n * n; ++i)
      spheres.push_back({(i % n + 0.5) * spacing + 0.377 * (i / n) + 0.11 + move.x, (i / n + 0.5) * spacing + 0.291 * (i % n) + 0.23 + move.y, 0, radius});
    Scene scene = scene_of(spheres, {0xFFFFFFFFu});
    scene.background = {0, 0, 0, 1};
    scene.ambient = {1, 1, 1};
    scene.lights.clear();
    return scene;
  }
  static View view(std::uint32_t side) {
    Scene any = scene_of({{0, 0, 0, 100}});
    return look_orthographic(any, {0.5 * side, 0.5 * side, 500}, {0.5 * side, 0.5 * side, 0}, {side, side}, side);
  }
  Picture drawn(const Scene& scene, std::uint32_t side) {
    Picture p = draw(scene, view(side), {}, {"opaque.edges=\"analytic\""});
    EXPECT_EQ(tiled_, GetParam() == passes::Expansion::Compute);
    return p;
  }
  static double energy(const Picture& p) {
    double sum = 0;
    for (const glm::vec4& c : p.color) sum += c.g;
    return sum;
  }
};

INSTANTIATE_TEST_SUITE_P(, AnalyticEdges, testing::Values(passes::Expansion::Vertex, passes::Expansion::Compute), [](const auto& p) { return std::string(to_string(p.param)); });

TEST_P(AnalyticEdges, CoverageOfDiscsOfEightPixels) {
  // The area of disc and pixel together: chords, integrated over the pixel's rows.
  const Scene scene = grid(8, 5, 24);
  std::vector<glm::dvec4> area(std::size_t{126} * 126, glm::dvec4(0));
  for (int k = 0; k < 25; ++k) {
    const glm::dvec2 c((k % 5 + 0.5) * 24 + 0.377 * (k / 5) + 0.11, 126 - ((k / 5 + 0.5) * 24 + 0.291 * (k % 5) + 0.23)); // row 0 is on top
    for (std::size_t i = 0; i < area.size(); ++i)
      for (int row = 0; row < 400; ++row) {
        const double dy = static_cast<double>(i / 126) + (row + 0.5) / 400 - c.y, half = std::sqrt(std::max(64.0 - dy * dy, 0.0));
        const auto x = static_cast<double>(i % 126);
        area[i] += glm::dvec4(std::max(0.0, std::min(x + 1, c.x + half) - std::max(x, c.x - half)) / 400);
      }
  }
  EXPECT_LE(edge_error(drawn(scene, 126), area), 0.007);
}

// Perspective: outlines are ellipses, up to 25 degrees off the axis.
TEST_P(AnalyticEdges, CoverageInPerspective) {
  Scene scene = grid(8, 6, 24);
  const View camera = look(scene, {75, 75, 200}, {75, 75, 0}, {190, 190}, 50.0);
  const auto area = render_reference_area(reference::build_world(scene), camera, 12);
  EXPECT_LE(edge_error(draw(scene, camera, {}, {"opaque.edges=\"analytic\""}), area), 0.018);
}

// A transform that is no similarity makes ellipses of the outlines; the record's radius says nothing about their size then.
TEST_P(AnalyticEdges, StretchedAndShearedSpheres) {
  const auto stretched = [](double radius, int n, double spacing, const glm::dmat3& linear) {
    Scene scene = grid(radius, n, spacing);
    scene.batches[0].instances[0].world_from_data = glm::dmat4(linear);
    return scene;
  };
  const Scene large = stretched(0.2, 5, 0.7, glm::dmat3(40, 0, 12, 16, 24, -9, 5, 0, 30));
  const auto analytic = [&](const Scene& scene, const View& camera) { return draw(scene, camera, {}, {"opaque.edges=\"analytic\""}); };
  for (const View& camera : {view(300), look(scene_of({{100, 60, 0, 100}}), {100, 60, 260}, {100, 60, 0}, {220, 160}, 38.0)}) {
    const auto area = render_reference_area(reference::build_world(large), camera, 12);
    EXPECT_LE(edge_error(analytic(large, camera), area), 0.03);
    EXPECT_GT(edge_error(draw(large, camera), area), 0.2) << "the measure sees one sample";
  }
  for (const double radius : {0.05, 0.25}) { // half axes of up to 0.6 pixels
    const Picture p = analytic(stretched(radius, 15, 6, glm::dmat3(2.4, 0, 0.5, 0, 1.2, 0, 0, 0, 3)), view(256));
    EXPECT_NEAR(energy(p) / (225 * 3.14159265 * radius * radius * 2.4 * 1.2), 1.0, 0.02) << radius;
  }
  const Picture needles = analytic(stretched(1.0, 4, 20, glm::dmat3(6, 0, 0, 0, 0.1, 0, 0, 0, 1)), view(480)); // covered or not
  for (const glm::vec4& c : needles.color) EXPECT_TRUE(c.g < 0.01f || c.g > 0.99f) << c.g;
}

// FC-53: the light of spheres below a pixel is that of their area.
TEST_P(AnalyticEdges, EnergyBelowAPixel) {
  for (const double radius : {0.02, 0.1, 0.3, 0.5, 0.7, 0.84, 0.9, 1.0}) {
    const Picture p = drawn(grid(radius, 15, 8), 128);
    EXPECT_NEAR(energy(p) / (225 * 3.14159265 * radius * radius), 1.0, 0.02) << radius;
  }
}

// FC-54: slow motion changes no brightness; one sample a pixel does.
TEST_P(AnalyticEdges, NoFlickerInSlowMotion) {
  const int frames = GetParam() == passes::Expansion::Compute ? 5 : 10; // kernels are compiled for each picture here
  const auto deviation = [&](double radius, const std::string& setting) {
    std::vector<double> energies;
    for (int frame = 0; frame < frames; ++frame)
      energies.push_back(energy(draw(grid(radius, 15, 8, {0.05 * frame, 0.03 * frame}), view(128), {}, {setting})));
    double mean = 0, square = 0;
    for (const double e : energies) mean += e / frames;
    for (const double e : energies) square += (e - mean) * (e - mean) / frames;
    return std::sqrt(square) / mean;
  };
  for (const double radius : {0.1, 0.5, 1.0}) EXPECT_LT(deviation(radius, "opaque.edges=\"analytic\""), 0.01) << radius;
  EXPECT_GT(deviation(0.1, "opaque.edges=\"sampled\""), 0.05) << "the measure sees flicker";
}

// Where outlines crowd, tiles composite what each of the particles around covers: nearer to the truth than one sample.
TEST_P(AnalyticEdges, InACloud) {
  const Scene scene = scene_of(cloud(3000, 4.0, 0.06, 0.25));
  const View camera = look(scene, {3, 2, 12}, {0, 0, 0}, {160, 120});
  const auto area = render_reference_area(reference::build_world(scene), camera, 8);
  const auto error = [&](const std::string& edges) {
    const Picture p = draw(scene, camera, {}, {"opaque.edges=\"" + edges + "\""});
    double sum = 0;
    for (std::size_t i = 0; i < area.size(); ++i) sum += std::pow(p.color[i].g - area[i].g, 2);
    return std::sqrt(sum / static_cast<double>(area.size()));
  };
  const double one = error("sampled"), edges = error("analytic");
  EXPECT_EQ(tiled_, GetParam() == passes::Expansion::Compute);
  if (GetParam() == passes::Expansion::Compute) EXPECT_LE(edges, 0.5 * one);
  else EXPECT_LE(edges, 1.5 * one);
}

// The same outlines by quads and by tiles; straight colors over a transparent background.
TEST_P(AnalyticEdges, OverATransparentBackground) {
  Scene scene = grid(8, 5, 24);
  scene.background = {0, 0, 0, 0};
  const Picture p = draw(scene, view(126), {}, {"opaque.edges=\"analytic\""}), opaque = drawn(grid(8, 5, 24), 126);
  std::size_t partly = 0;
  for (std::size_t i = 0; i < p.color.size(); ++i) {
    EXPECT_NEAR(p.color[i].a, opaque.color[i].g, 2e-3f);
    if (p.color[i].a < 0.01f || p.color[i].a > 0.99f) continue;
    ++partly;
    EXPECT_NEAR(p.color[i].g, 1.0f, 2e-3f);
  }
  EXPECT_GT(partly, 500u);
}

// In shadows of maps that tiles hold and in those that they do not, with what the center's AOVs need besides or without.
TEST_P(AnalyticEdges, WithShadows) {
  graph_ = "shadowed";
  std::vector<glm::dvec4> spheres = cloud(300, 4.0, 0.1, 0.4);
  Scene scene = scene_of(spheres, {0xFFFFFFFFu});
  scene.lights = {{.name = "sun", .kind = LightKind::Directional, .direction = {0.3, -1, 0.2}, .intensity = 0.8, .shadows = true}};
  const View camera = look(scene, {0, 12, 22}, {0, 0, 0}, {160, 120});
  const auto area = render_reference_area(reference::build_world(scene), camera, 8);
  const auto error = [&](const std::string& edges) {
    const Picture p = draw(scene, camera, {}, {"shadow.size=1024", "opaque.edges=\"" + edges + "\""});
    double sum = 0;
    for (std::size_t i = 0; i < area.size(); ++i) sum += std::pow(p.color[i].g - area[i].g, 2);
    return std::sqrt(sum / static_cast<double>(area.size()));
  };
  const double edges = error("analytic");
  const bool tiled = tiled_;
  EXPECT_EQ(tiled, GetParam() == passes::Expansion::Compute);
  EXPECT_LE(edges, (tiled ? 0.6 : 1.6) * error("sampled"));
}

// `auto` takes tiles wherever they can draw, whatever it costs: a picture does not depend on the machine.
TEST_F(Discs, EdgesAreDrawnByTilesOfAuto) {
  passes::ExpansionReport chosen;
  const Scene scene = discs();
  const Picture p = draw(scene, view(scene), {.chosen = [&](const passes::ExpansionReport& report) { chosen = report; }}, {"opaque.edges=\"analytic\""});
  EXPECT_EQ(chosen.choice.expansion, passes::Expansion::Compute);
  EXPECT_EQ(chosen.choice.why, "tiles have the better outlines");
  EXPECT_GT(chosen.tiled, 0u);
}

// Maps that tiles cannot ask: all is drawn by quads.
TEST_P(AnalyticEdges, WithMapsThatTilesCannotAsk) {
  graph_ = "shadowed";
  Scene scene = scene_of({{0, 0, 0, 2}, {0, 5, 0, 0.5}});
  scene.lights = {{.name = "sun", .kind = LightKind::Directional, .direction = {0, -1, 0}, .intensity = 0.8, .shadows = true}};
  const View camera = look(scene, {0, 12, 12}, {0, 2, 0}, {120, 120});
  const std::vector<std::string> settings{"shadow.method=\"depth\"", "opaque.edges=\"analytic\""};
  const Picture p = draw(scene, camera, {}, settings);
  EXPECT_FALSE(tiled_);
  EXPECT_EQ(p.id[p.at(60, 75)], 0u);
  EXPECT_EQ(p.display, GpuTest::draw(scene, camera, {.expansion = passes::Expansion::Vertex}, settings).display);
}

// A sphere before the eye's plane is nothing for tiles: then all is drawn by quads, outlines and all.
TEST_P(AnalyticEdges, QuadsWhereTilesCannotDrawAll) {
  const Scene scene = scene_of({{0, 0, 0, 1}, {0, 0, 9.9, 0.3}});
  const View camera = look(scene, {0, 0, 10}, {0, 0, 0}, {120, 120});
  const std::vector<std::string> settings{"opaque.edges=\"analytic\""};
  const Picture p = draw(scene, camera, {}, settings);
  EXPECT_FALSE(tiled_);
  EXPECT_EQ(p.display, GpuTest::draw(scene, camera, {.expansion = passes::Expansion::Vertex}, settings).display);
  EXPECT_NE(p.display, draw(scene, camera, {}, {"opaque.edges=\"sampled\""}).display) << "outlines and all";
}

TEST_P(AnalyticEdges, AovsAreThoseOfThePixelsCenter) {
  const Scene scene = grid(8, 6, 24);
  const Picture one = draw(scene, view(150)), blended = drawn(scene, 150);
  EXPECT_EQ(one.id, blended.id);
  EXPECT_EQ(one.depth, blended.depth);
  EXPECT_EQ(one.normal, blended.normal);
}

TEST(AnalyticEdgesOfAGraph, NotWithSeveralSamples) {
  rg::Registry registry;
  register_builtin_passes(registry);
  Diagnostics found;
  const rg::GraphDesc graph = rg::parse_graph("schema = 1\noutput = 'o.color'\n[[pass]]\nname = 'o'\nkind = 'opaque_impostors'\nparams = { samples = 16, edges = 'analytic' }\n", "g.toml", found);
  EXPECT_THAT(to_string(rg::compile(graph, registry, {}, found).diagnostics), HasSubstr("g.toml:6:34: error P006"));
}

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
