// SPDX-License-Identifier: MIT
// Analytic edges by quads and by tiles: coverage against areas, what they hold of a pixel's light, and that the way to a picture does not show.
#include "discs.hpp"
#include "drawing.hpp"
#include "graph_test.hpp"

#include "passes/builtin.hpp"
#include "render_graph/compile.hpp"

#include <gmock/gmock.h>

namespace mote::test {
namespace {

using namespace mote::passes;
using testing::HasSubstr;

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
    EXPECT_EQ(tiled_, GetParam() == Expansion::Compute);
    return p;
  }
  static double energy(const Picture& p) {
    double sum = 0;
    for (const glm::vec4& c : p.color) sum += c.g;
    return sum;
  }
};

INSTANTIATE_TEST_SUITE_P(, AnalyticEdges, testing::Values(Expansion::Vertex, Expansion::Compute), [](const auto& p) { return std::string(to_string(p.param)); });

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
  const int frames = GetParam() == Expansion::Compute ? 5 : 10; // kernels are compiled for each picture here
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
  EXPECT_EQ(tiled_, GetParam() == Expansion::Compute);
  if (GetParam() == Expansion::Compute) EXPECT_LE(edges, 0.5 * one);
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
  EXPECT_EQ(tiled, GetParam() == Expansion::Compute);
  EXPECT_LE(edges, (tiled ? 0.6 : 1.6) * error("sampled"));
}

// `auto` takes tiles wherever they can draw, whatever it costs: a picture does not depend on the machine.
TEST_F(Discs, EdgesAreDrawnByTilesOfAuto) {
  ExpansionReport chosen;
  const Scene scene = discs();
  const Picture p = draw(scene, view(scene), {.chosen = [&](const ExpansionReport& report) { chosen = report; }}, {"opaque.edges=\"analytic\""});
  EXPECT_EQ(chosen.choice.expansion, Expansion::Compute);
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
  EXPECT_EQ(p.display, GpuTest::draw(scene, camera, {.expansion = Expansion::Vertex}, settings).display);
}

// A sphere before the eye's plane is nothing for tiles: then all is drawn by quads, outlines and all.
TEST_P(AnalyticEdges, QuadsWhereTilesCannotDrawAll) {
  const Scene scene = scene_of({{0, 0, 0, 1}, {0, 0, 9.9, 0.3}});
  const View camera = look(scene, {0, 0, 10}, {0, 0, 0}, {120, 120});
  const std::vector<std::string> settings{"opaque.edges=\"analytic\""};
  const Picture p = draw(scene, camera, {}, settings);
  EXPECT_FALSE(tiled_);
  EXPECT_EQ(p.display, GpuTest::draw(scene, camera, {.expansion = Expansion::Vertex}, settings).display);
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

// ---- layers of tiles --------------------------------------------------------------------------------
using Layers = GpuTest;
const std::vector<std::string> analytic{"opaque.edges=\"analytic\""};

// What was seen in frames before changes no pixel, though a tile that gets more particles is cast anew.
TEST_F(Layers, FramesOfAMovingCameraAndACutAreThoseOfTheirOwn) {
  const Scene scene = cloud_scene(20000, 0.35, 5);
  Drawing kept(device(), {.expansion = Expansion::Compute}, false, 0, analytic);
  const Size2d size{320, 200};
  std::vector<View> views;
  for (int k = 0; k < 4; ++k) views.push_back(look(scene, {40.0 * std::sin(0.05 * k), 6, 40.0 * std::cos(0.05 * k)}, {0, 0, 0}, size));
  views.push_back(look(scene, {-3, -45, 4}, {0, 0, 0}, size));    // cut
  views.push_back(look(scene, {40, 6, 0}, {0, 0, 0}, {160, 100})); // cut, another size
  for (std::size_t k = 0; k < views.size(); ++k) {
    const Picture got = kept.draw(scene, views[k]);
    EXPECT_GT(kept.choices().front().tiled, 0u);
    Drawing fresh(device(), {.expansion = Expansion::Compute}, false, 0, analytic);
    EXPECT_EQ(got.display, fresh.draw(scene, views[k]).display) << "frame " << k;
  }
}

// Thousands of particles in one tile: those that have no place of its own are filed again with those of the second step.
TEST_F(Layers, ATileWithThousandsOfParticles) {
  const Scene scene = join({cloud_scene(6000, 0.05, 3, 0.4), cloud_scene(300, 0.3, 4)});
  Drawing kept(device(), {.expansion = Expansion::Compute}, false, 0, analytic);
  for (int k = 0; k < 3; ++k) {
    const View view = look(scene, {2.0 * k, 0, 60}, {0, 0, 0}, {256, 256});
    Drawing fresh(device(), {.expansion = Expansion::Compute}, false, 0, analytic);
    EXPECT_EQ(kept.draw(scene, view).display, fresh.draw(scene, view).display) << "frame " << k;
  }
}

// More particles than one round holds: tiles are cast several times, and layers are kept between. That all the others are hidden in one
// sphere shows nowhere.
TEST_F(Layers, CastsInManyRoundsEqualOne) {
  std::vector<glm::dvec4> few = cloud(4000, 4.0, 0.06, 0.25), many;
  few.push_back({0, 0, 0, 1.5});
  for (int i = 0; i < 600000; ++i) many.push_back({0.8 * std::sin(1.7 * i), 0.8 * std::sin(2.3 * i + 1), 0.8 * std::sin(0.37 * i + 2) * std::cos(0.001 * i), 0.01});
  Scene scene = scene_of(few), crowded = join({scene, scene_of(many)});
  crowded.bounds = scene.bounds;
  Drawing one(device(), {.expansion = Expansion::Compute}, false, 0, analytic), rounds(device(), {.expansion = Expansion::Compute}, false, 0, analytic);
  for (int k = 0; k < 2; ++k) {
    const View camera = look(scene, {3 + 0.3 * k, 2, 12}, {0, 0, 0}, {320, 240});
    const Picture a = one.draw(scene, camera), b = rounds.draw(crowded, camera);
    EXPECT_GT(rounds.choices().front().tiled, 8192u) << "what one round holds at most";
    std::size_t others = 0;
    for (std::size_t i = 0; i < a.display.size(); ++i) {
      const glm::ivec4 d = glm::abs(glm::ivec4(a.display[i]) - glm::ivec4(b.display[i]));
      others += std::max({d.r, d.g, d.b, d.a}) > 1;
    }
    EXPECT_LE(others, a.display.size() / 5000) << "frame " << k << ": a layer that moves back keeps the color of where it was looked at";
  }
}

} // namespace
} // namespace mote::test
