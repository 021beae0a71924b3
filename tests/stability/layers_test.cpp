// SPDX-License-Identifier: MIT
// Failure cases of transparency and shadows: naive blending as arithmetic, mote's passes as pictures against the reference.
#include "../passes/graph_test.hpp"

#include "app/charts/chroma.hpp"
#include "app/charts/random.hpp"
#include "app/charts/stacks.hpp"
#include "core/reference/reference.hpp"

#include <fmt/format.h>

#include <gmock/gmock.h>

#include <cmath>

namespace mote::test {
namespace {

std::string graph_with(const std::string& params) {
  return fmt::format("schema = 1\noutput = \"glyphs.color\"\n[[pass]]\nname = \"opaque\"\nkind = \"opaque_impostors\"\n[[pass]]\nname = \"glyphs\"\nkind = \"sorted_glyphs\"\n"
                     "inputs = {{ color = \"opaque.color\", depth = \"opaque.depth\" }}\nparams = {{ {} }}\n",
                     params);
}

class StabilityLayers : public GraphTest {
protected:
  // Largest difference to the reference in steps of 255, outside of ambiguous pixels.
  double worst(const Scene& scene, const View& view, const std::string& params) {
    const Colors drawn = draw_graph(scene, view, graph_with(params), "glyphs.color");
    const ReferencePicture reference = render_reference(scene, view);
    double out = 0.0;
    for (std::size_t i = 0; i < drawn.texels.size(); ++i) {
      if (reference.ambiguous[i] || (!reference.layers_ambiguous.empty() && reference.layers_ambiguous[i])) continue;
      for (int k = 0; k < 3; ++k) out = std::max(out, 255.0 * std::abs(static_cast<double>(drawn.texels[i][k]) - reference.color[i][k]));
    }
    return out;
  }
  static Scene row(std::size_t n, double alpha) { // along the view, colors in turn
    const glm::dvec3 colors[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
    std::vector<Scene> all;
    for (std::size_t i = 0; i < n; ++i) all.push_back(flat_sphere({0, 0, -2.5 * static_cast<double>((i * 37) % n), 1}, colors[i % 4], alpha));
    return join(all);
  }
  static app::Stack stack(std::size_t n, double alpha) {
    const glm::dvec3 colors[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
    app::Stack out;
    for (std::size_t i = 0; i < n; ++i) out.push_back({colors[i % 4], alpha, 1.0 + static_cast<double>((i * 37) % n)});
    return out;
  }
};

double steps(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = glm::abs(a - b) * 255.0;
  return std::max({d.r, d.g, d.b});
}

TEST_F(StabilityLayers, FC36_SpheresThatOverlap) {
  const Scene scene = join({flat_sphere({-0.4, 0, 0, 1}, {1, 0, 0}, 0.5), flat_sphere({0.4, 0, 0.2, 1}, {0, 0, 1}, 0.5)});
  const View view = look(scene, {0, 0, 8}, {0, 0, 0}, {128, 128});
  EXPECT_GT(worst(scene, view, "order = \"back_to_front\""), 5.0) << "no order of particles is right";
  EXPECT_LE(worst(scene, view, "oit = \"exact\""), 1.0);
}

TEST_F(StabilityLayers, FC37_SixtyFourFaintLayers) {
  double rounded = 0.0; // of 200 stacks of random colors: 8 bits, front to back
  app::Random random(7);
  for (int k = 0; k < 200; ++k) {
    app::Stack faint = stack(64, 0.05);
    for (app::Layer1& layer : faint) layer.color = app::hue_color(random.uniform());
    rounded = std::max(rounded, steps(app::blend_8bit(faint, false), app::blend_exact(faint)));
  }
  EXPECT_GT(rounded, 4.0);
  const Scene scene = row(64, 0.05);
  EXPECT_LE(worst(scene, look(scene, {0, 0, 12}, {0, 0, 0}, {65, 65}, 12), "order = \"back_to_front\""), 1.0);
}

TEST_F(StabilityLayers, FC38_MoreLayersThanAreKept) {
  const app::Stack deep = stack(64, 0.3);
  EXPECT_GT(steps(app::blend_first(deep, 4, false), app::blend_exact(deep)), 20.0);
  const Scene scene = row(64, 0.3);
  EXPECT_LE(worst(scene, look(scene, {0, 0, 12}, {0, 0, 0}, {65, 65}, 12), "oit = \"exact\""), 1.0);
}

// The center of the small one is nearer, and yet it lies behind the limb of the large one. Its power is the larger.
TEST_F(StabilityLayers, FC39_BehindTheLimb) {
  const double sine = 10.0 / 11.0, cosine = std::sqrt(1.0 - sine * sine);
  const glm::dvec3 large(0, 0, -11), small = 6.5 * glm::dvec3(sine, 0, -cosine);
  ASSERT_GT(glm::length(large - small), 10.0 + 0.1) << "disjoint";
  EXPECT_LT(glm::length(small), glm::length(large)) << "by the distance of centers the small one is drawn over the large one";
  const Scene scene = join({flat_sphere({large, 10.0}, {1, 0, 0}, 0.5), flat_sphere({small, 0.1}, {0, 0, 1}, 0.5)});
  const View view = look(scene, {0, 0, 0}, small, {128, 128}, 3);
  EXPECT_LE(worst(scene, view, "order = \"back_to_front\""), 1.0);
}

TEST_F(StabilityLayers, FC40_OpaqueInTheMiddle) {
  const app::Stack layers{{{0, 0, 1}, 0.5, 3.0}, {{1, 0, 0}, 0.5, 1.0}, {{0, 1, 0}, 1.0, 2.0}};
  EXPECT_GT(steps(app::blend_unsorted(layers), app::blend_exact(layers)), 100.0);
  const Scene scene = join({flat_sphere({0, 0, -3, 1}, {0, 0, 1}, 0.5), flat_sphere({0, 0, 3, 1}, {1, 0, 0}, 0.5), flat_sphere({0, 0, 0, 1}, {0, 1, 0})});
  const View view = look(scene, {0, 0, 12}, {0, 0, 0}, {65, 65}, 12);
  for (const char* params : {"order = \"back_to_front\"", "order = \"front_to_back\"", "oit = \"exact\""}) EXPECT_LE(worst(scene, view, params), 1.0) << params;
}

class StabilityShadows : public GpuTest {
protected:
  StabilityShadows() { graph_ = "shadowed"; }
  struct Wrong {
    double shadow{}, light{}; // parts of the pixels that face the light
  };
  Wrong wrong(const Scene& scene, const View& view, const std::vector<std::string>& settings) {
    const Picture drawn = draw(scene, view, {}, settings);
    ReferenceOptions options;
    const ReferencePicture with = render_reference(scene, view, options);
    options.shadows = false;
    const ReferencePicture without = render_reference(scene, view, options);
    std::size_t facing = 0, shadow = 0, light = 0;
    for (std::size_t i = 0; i < with.id.size(); ++i) {
      const double ambient = 0.8 * 0.2; // of scene_of(): color 0.8, ambient light 0.2
      if (with.id[i] == reference_no_id || with.ambiguous[i] || without.color[i].g - ambient < 4e-3) continue;
      const double middle = 0.5 * (without.color[i].g + ambient);
      const bool truth = with.color[i].g < middle, seen = static_cast<double>(drawn.color[i].g) < middle;
      ++facing;
      shadow += seen && !truth;
      light += truth && !seen;
    }
    EXPECT_GT(facing, 1000u);
    return {static_cast<double>(shadow) / static_cast<double>(facing), static_cast<double>(light) / static_cast<double>(facing)};
  }
  static Light sun(glm::dvec3 direction) {
    return {.name = "sun", .kind = LightKind::Directional, .direction = glm::normalize(direction), .intensity = 0.8, .shadows = true};
  }
};

const std::vector<std::string> compared_depths{"shadow.method=\"depth\"", "shadow.pcf=0", "shadow.normal_offset=0", "shadow.size=256"};
const std::vector<std::string> casters{"shadow.method=\"ids\"", "shadow.size=256"};

TEST_F(StabilityShadows, FC42_LimbsAndContact) {
  const double texel = 0.01, constant_bias = std::sqrt(2.0 * texel / std::sqrt(2.0)); // that a depth map needs at the limb, in radii
  EXPECT_GT(constant_bias, 0.1) << "so far light leaks under a sphere that touches";
  Scene scene = scene_of({{0, 0, 0, 1}, {0, 2, 0, 1}});
  scene.lights = {sun({0.3, -1, -0.2})};
  const View view = look(scene, {2, 4, 9}, {0, 1, 0}, {200, 200});
  EXPECT_GT(wrong(scene, view, compared_depths).shadow, 0.05) << "acne";
  const Wrong mote = wrong(scene, view, casters);
  EXPECT_EQ(mote.shadow, 0.0);
  EXPECT_LE(mote.light, 1e-3);
}

TEST_F(StabilityShadows, FC45_LightGrazingAPlane) {
  Scene scene = scene_of({{0, -1e3, 0, 1e3}, {0, 0.5, 0, 0.5}, {-3, 0.5, 1, 0.5}}); // a sphere as large as a plane
  scene.lights = {sun({1, -std::tan(glm::radians(1.0)), 0})};
  const View view = look(scene, {0, 3, 9}, {0, 0.3, 0}, {200, 200});
  EXPECT_GT(wrong(scene, view, compared_depths).shadow, 0.05) << "acne";
  EXPECT_EQ(wrong(scene, view, casters).shadow, 0.0);
}

} // namespace
} // namespace mote::test
