// SPDX-License-Identifier: MIT
// The steps of a drawing pass, for teaching: what each shows is known in closed form or from the reference. AOVs are those of
// the whole thing.
#include "graph_test.hpp"

#include "core/reference/reference.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

namespace mote::test {
namespace {

using passes::Expansion;
using testing::HasSubstr;

class Steps : public GraphTest {
protected:
  static std::string graph(const std::string& params) {
    return fmt::format("schema = 1\noutput = \"all.color\"\n[[pass]]\nname = \"all\"\nkind = \"opaque_impostors\"\nparams = {{ {} }}\n", params);
  }
  Colors step(const Scene& scene, const View& view, const std::string& params, Expansion expansion = Expansion::Vertex) {
    return draw_graph(scene, view, graph(params), "all.color", {.expansion = expansion});
  }
  static bool is_background(const glm::vec4& c) { return c.r == 1.0f && c.g == 1.0f && c.b == 1.0f; } // of scene_of()
  static std::size_t covered(const Colors& c) {
    std::size_t n = 0;
    for (const glm::vec4& texel : c.texels) n += !is_background(texel);
    return n;
  }
};

// Orthographic, a unit sphere: the rectangle is [-1, 1]^2, and its color the place in it.
TEST_F(Steps, ProxyIsTheRectangleColoredByItsPlace) {
  const Scene scene = scene_of({{0.25, -0.125, 0, 1}});
  const View view = look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {128, 128}, 4.0); // 32 pixels a unit
  for (const Expansion expansion : {Expansion::Vertex, Expansion::Geometry}) {
    const Colors p = step(scene, view, "steps = \"proxy\"", expansion);
    for (std::uint32_t y = 0; y < 128; ++y)
      for (std::uint32_t x = 0; x < 128; ++x) {
        const double u = ((x + 0.5 - 64) / 32.0 - 0.25 + 1.0) / 2.0, v = ((y + 0.5 - 64) / 32.0 - 0.125 + 1.0) / 2.0; // y down
        const glm::vec4 c = p.at(x, y);
        if (u < 0 || u > 1 || v < 0 || v > 1) {
          ASSERT_TRUE(is_background(c)) << x << " " << y;
        } else {
          ASSERT_NEAR(c.r, u, 1e-3) << x << " " << y;
          ASSERT_NEAR(c.g, v, 1e-3);
          ASSERT_EQ(c.b, 0.0f);
        }
      }
  }
}

TEST_F(Steps, DiscardLeavesWhatTheRayMeets) {
  const Scene scene = scene_of(cloud(60, 3, 0.1, 0.8));
  const View view = look(scene, {2, 1, 9}, {0, 0, 0}, {160, 100}, 50);
  const Colors p = step(scene, view, "steps = \"discard\""), proxies = step(scene, view, "steps = \"proxy\"");
  const ReferencePicture reference = render_reference(scene, view);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < p.texels.size(); ++i) {
    if (reference.ambiguous[i]) continue;
    ASSERT_EQ(!is_background(p.texels[i]), reference.id[i] != reference_no_id) << i;
    hits += reference.id[i] != reference_no_id;
    if (!is_background(p.texels[i])) {
      ASSERT_EQ(p.texels[i].b, 0.0f) << "still colored by its place";
    }
  }
  EXPECT_GT(covered(proxies), hits + hits / 10) << "corners of rectangles";
}

// Two spheres that intersect: without their own depth the one whose rectangle lies nearer wins wherever both are.
TEST_F(Steps, ShadeHasTheDepthOfTheProxy) {
  const glm::dvec3 red(1, 0, 0), blue(0, 0, 1);
  const Scene scene = join({flat_sphere({-0.5, 0, 0, 1.0}, red), flat_sphere({0.5, 0, 0.1, 1.0}, blue)});
  const View view = look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {128, 128}, 4.0);
  const Colors shaded = step(scene, view, "steps = \"shade\""), whole = step(scene, view, "");
  std::size_t both = 0, differ = 0;
  for (std::uint32_t y = 0; y < 128; ++y)
    for (std::uint32_t x = 0; x < 128; ++x) {
      const double px = (x + 0.5 - 64) / 32.0, py = (y + 0.5 - 64) / 32.0;
      const double left = 1 - (px + 0.5) * (px + 0.5) - py * py, right = 1 - (px - 0.5) * (px - 0.5) - py * py;
      if (left < 1e-3 || right < 1e-3) continue;
      ++both;
      EXPECT_EQ(shaded.at(x, y).b, 1.0f) << "blue is nearer by its rectangle";
      const bool blue_nearer = std::sqrt(right) + 0.1 > std::sqrt(left);
      if (std::abs(std::sqrt(right) + 0.1 - std::sqrt(left)) > 1e-3) {
        EXPECT_EQ(whole.at(x, y).b == 1.0f, blue_nearer);
      }
      differ += !blue_nearer;
    }
  EXPECT_GT(both, 500u);
  EXPECT_GT(differ, both / 10);
}

// Where no two particles overlap, the shaded step and the quadratic formula at a moderate distance show the whole thing.
TEST_F(Steps, ShadeAndQuadraticShadeAsTheWholeDoes) {
  Scene scene = scene_of({{-2.2, 0, 0, 1}, {0, 0, 1, 1}, {2.2, 0, -1, 1}});
  scene.lights = {{.kind = LightKind::Directional, .direction = glm::normalize(glm::dvec3(-1, -0.5, -1))}};
  scene.batches[0].material = {ShadingModel::BlinnPhong, 1.0, 0.8, 0.5, 20.0};
  const View view = look(scene, {0, 0, 12}, {0, 0, 0}, {200, 100}, 20);
  const Colors whole = step(scene, view, "");
  EXPECT_GT(covered(whole), 2000u);
  for (const char* word : {"shade", "quadratic"}) {
    const Colors p = step(scene, view, fmt::format("steps = \"{}\"", word));
    std::size_t other = 0;
    for (std::size_t i = 0; i < p.texels.size(); ++i) other += glm::length(p.texels[i] - whole.texels[i]) > 2e-3f;
    EXPECT_LE(other, whole.texels.size() / 500) << word;
  }
  EXPECT_EQ(step(scene, view, "steps = \"depth\"").texels, whole.texels) << "the default";
}

// 5000 radii away the discriminant has no digit left: pixels in the middle of the sphere miss.
TEST_F(Steps, QuadraticHasHolesFarAway) {
  const Scene scene = scene_of({{0, 0, 0, 1}});
  const View view = look(scene, {300, 200, 5000}, {0, 0, 0}, {100, 100}, glm::degrees(2.4 / 5000.0));
  const std::size_t whole = covered(step(scene, view, "")), naive = covered(step(scene, view, "steps = \"quadratic\""));
  const ReferencePicture reference = render_reference(scene, view);
  const auto truth = static_cast<std::size_t>(std::count_if(reference.id.begin(), reference.id.end(), [](std::uint32_t id) { return id != reference_no_id; }));
  EXPECT_NEAR(static_cast<double>(whole), static_cast<double>(truth), 2.0);
  const Colors p = step(scene, view, "steps = \"quadratic\"");
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < p.texels.size(); ++i) wrong += is_background(p.texels[i]) == (reference.id[i] != reference_no_id);
  EXPECT_GT(wrong, truth / 50) << naive << " of " << truth;
}

// Squares of a fixed size, at any distance; the nearer center in front.
TEST_F(Steps, PointsHaveOneSizeAtAnyDistance) {
  const Scene scene = scene_of({{0.03, 0.02, 0, 1}});
  for (const double distance : {5.0, 10.0, 400.0})
    for (const unsigned size : {1u, 4u, 9u})
      EXPECT_EQ(covered(step(scene, look(scene, {0, 0, distance}, {0, 0, 0}, {64, 64}), fmt::format("steps = \"points\", point_size = {}", size))), size * size) << distance;
  const Scene two = join({flat_sphere({0, 0, 0, 1}, {1, 0, 0}), flat_sphere({0, 0, 2, 0.5}, {0, 0, 1})});
  const Colors p = step(two, look_orthographic(two, {0, 0, 10}, {0, 0, 0}, {65, 65}, 4.0), "steps = \"points\"");
  EXPECT_EQ(p.center(), glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(covered(p), 64u);
}

TEST_F(Steps, AovsStayThoseOfTheWhole) {
  const Scene scene = scene_of(cloud(40, 2, 0.2, 0.8));
  const View view = look(scene, {0, 0, 8}, {0, 0, 0}, {120, 80});
  const Picture whole = draw(scene, view);
  for (const char* word : {"proxy", "points", "shade"}) {
    const Picture p = draw(scene, view, {}, {fmt::format("opaque.steps=\"{}\"", word)});
    EXPECT_EQ(p.id, whole.id) << word;
    EXPECT_EQ(p.depth, whole.depth);
    EXPECT_NE(p.color, whole.color);
  }
}

// Every type, and the variants of placements that stretch and of particles near the eye.
TEST_F(Steps, EveryTypeHasThem) {
  const glm::vec4 along(0, 0.6f, 0, 0.3f), turn(0.1f, 0.2f, 0.3f, 0.9f), axes(0.5f, 0.3f, 0.4f, 0);
  const std::vector<std::pair<std::string, std::vector<glm::vec4>>> types{
      {"sphere", {}}, {"capsule", {along}}, {"cylinder", {along, {0.3f, 0, 0, 0}}}, {"cone", {along, {0, 0, 0, 0}}}, {"arrow", {along, {0.5f, 0.4f, 0, 0}}}, {"ellipsoid", {turn, axes}}, {"box", {turn, axes}}, {"superquadric", {turn, axes, {0.5f, 1.0f, 0, 0}}}};
  for (const auto& [type, rest] : types)
    for (const bool stretched : {false, true}) {
      Scene scene = glyph_scene(type, {{.center = {0, 0, 0}, .bound = 1.0, .finest = 0.3, .rest = rest}});
      if (stretched) scene = placed(scene, {glm::dmat4(1.5, 0, 0, 0, 0, 0.7, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)});
      const double distance = stretched ? 3.0 : 30.0; // placed near the eye, and not
      const View view = look(scene, {0, 0, distance}, {0, 0, 0}, {40, 40}, 120.0 / distance);
      const std::size_t whole = covered(step(scene, view, "")), proxy = covered(step(scene, view, "steps = \"proxy\""));
      EXPECT_GT(whole, 30u) << type;
      EXPECT_EQ(covered(step(scene, view, "steps = \"discard\"")), whole) << type << (stretched ? " stretched" : "");
      EXPECT_GE(proxy, whole) << type;
      EXPECT_EQ(covered(step(scene, view, "steps = \"shade\"")), whole) << type;
      EXPECT_EQ(covered(step(scene, view, "steps = \"points\"")), 64u) << type;
    }
}

TEST_F(Steps, WhatCannotBeIsRefused) {
  EXPECT_THAT(to_string(check_graph(graph("steps = \"prox\""))), HasSubstr("G023"));
  EXPECT_THAT(to_string(check_graph(graph("steps = \"proxy\", edges = \"analytic\""))), testing::AllOf(HasSubstr("P006"), HasSubstr("steps")));
  const Scene spheres = scene_of({{0, 0, 0, 1}}), stretched = placed(spheres, {glm::dmat4(2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)});
  auto message = [&](const Scene& scene, const std::string& params, Expansion expansion) -> std::string {
    try {
      (void)step(scene, look(scene, {0, 0, 8}, {0, 0, 0}, {32, 32}), params, expansion);
    } catch (const Failure& failure) {
      return std::string(failure.what());
    }
    return "";
  };
  EXPECT_THAT(message(stretched, "steps = \"quadratic\"", Expansion::Vertex), testing::AllOf(HasSubstr("P023"), HasSubstr("stretches")));
  EXPECT_THAT(message(spheres, "steps = \"shade\"", Expansion::Compute), testing::AllOf(HasSubstr("P001"), HasSubstr("does not draw steps = \"shade\"")));
  EXPECT_THAT(message(spheres, "steps = \"points\"", Expansion::Geometry), HasSubstr("P001"));
  EXPECT_EQ(message(spheres, "steps = \"shade\"", Expansion::Auto), "");
}

} // namespace
} // namespace mote::test
