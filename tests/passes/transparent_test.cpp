// SPDX-License-Identifier: MIT
// The pass kind `sorted_glyphs` against closed forms: every order and both order-independent modes, what
// an opaque surface hides, backgrounds that are not opaque.
#include "graph_test.hpp"

#include "core/reference/reference.hpp"

#include <fmt/format.h>

#include <gmock/gmock.h>

namespace mote::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const glm::dvec3 red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};

// The transparent pass alone, for all particles.
std::string alone(const std::string& params) {
  return fmt::format("schema = 1\noutput = \"glyphs.color\"\n[[pass]]\nname = \"glyphs\"\nkind = \"sorted_glyphs\"\ndraw = [\"all\"]\nparams = {{ {} }}\n", params);
}

void expect_color(const glm::vec4& found, const glm::dvec3& wanted, double tolerance = 1e-3) {
  EXPECT_NEAR(found.r, wanted.r, tolerance);
  EXPECT_NEAR(found.g, wanted.g, tolerance);
  EXPECT_NEAR(found.b, wanted.b, tolerance);
}

class Transparent : public GraphTest {
protected:
  static View view(const Scene& scene) { return look(scene, {0, 0, 10}, {0, 0, 0}, {65, 65}); }
  Colors draw(const Scene& scene, const std::string& graph, const passes::FrameOptions& options = {}) {
    return draw_graph(scene, view(scene), graph, "glyphs.color", options);
  }
  glm::vec4 center(const Scene& scene, const std::string& params) { return draw(scene, glyphs_over_opaque(params)).center(); }
};

const std::vector<std::string> ordered{"order = \"back_to_front\"", "order = \"front_to_back\"", "oit = \"exact\""};

// Red of alpha 1/2 before green before blue of alpha 1/2, in the file: green, blue, red.
TEST_F(Transparent, TheStackOfThree) {
  Scene scene = join({flat_sphere({0, 0, 0, 1}, green), flat_sphere({0, 0, -3, 1}, blue, 0.5), flat_sphere({0, 0, 3, 1}, red, 0.5)});
  scene.background = {0, 0, 0, 1};
  for (const std::string& order : ordered) {
    SCOPED_TRACE(order);
    expect_color(draw(scene, alone(order)).center(), {0.5, 0.5, 0});
    expect_color(center(scene, order), {0.5, 0.5, 0}); // green by the opaque pass
  }
  expect_color(draw(scene, alone("order = \"file\", depth_test = \"less\", depth_write = true")).center(), {0.5, 0.5, 0});
  expect_color(draw(scene, alone("order = \"file\", depth_test = \"always\"")).center(), {0.5, 0.25, 0.25});
  expect_color(draw(scene, alone("order = \"file\", blend = \"over\", depth_test = \"less\", depth_write = true")).center(), {0.5, 0.5, 0});
}

// near over far over the background, whichever is first in the file.
TEST_F(Transparent, TwoStackedGlyphsInBothOrders) {
  const glm::dvec3 c1{0.9, 0.2, 0.1}, c2{0.1, 0.3, 0.8}, background{0.4, 0.5, 0.6};
  const double a1 = 0.5, a2 = 0.3;
  const glm::dvec3 wanted = a1 * c1 + (1 - a1) * (a2 * c2 + (1 - a2) * background);
  const Scene near = flat_sphere({0, 0, 3, 1}, c1, a1), far = flat_sphere({0, 0, 0, 1}, c2, a2);
  for (Scene scene : {join({near, far}), join({far, near})}) {
    scene.background = glm::dvec4(background, 1);
    for (const std::string& order : ordered)
      for (const char* surfaces : {"both", "front"}) {
        SCOPED_TRACE(order + surfaces);
        expect_color(center(scene, fmt::format("{}, surfaces = \"{}\"", order, surfaces)), wanted);
      }
    for (const std::string& order : ordered)
      expect_color(draw(scene, glyphs_over_opaque(order), {.expansion = passes::Expansion::Geometry}).center(), wanted);
  }
}

// "both": the entry and the exit block 1 - sqrt(1 - alpha) each, so the particle blocks alpha; the inner wall is lit
// by a head light as the front is.
TEST_F(Transparent, EntryAndExitAreShadedAndBlockAlphaTogether) {
  Scene scene = flat_sphere({0, 0, 0, 1}, glm::dvec3(1), 0.75);
  scene.background = {0, 0, 0, 1};
  scene.ambient = glm::dvec3(0);
  scene.lights.push_back({.kind = LightKind::Directional, .direction = {0, 0, -1}, .intensity = 1.0}); // from behind the eye
  for (const std::string& order : ordered) {
    SCOPED_TRACE(order);
    expect_color(center(scene, order), glm::dvec3(0.75)); // both faces look at the light
    expect_color(center(scene, order + ", surfaces = \"front\""), glm::dvec3(0.75));
    expect_color(center(scene, order + ", cull = \"back\""), glm::dvec3(0.5));
    expect_color(center(scene, order + ", cull = \"front\""), glm::dvec3(0.5));
  }
  scene.lights[0].direction = {0, 0, 1}; // lit from behind: only the exit's inner side does not look at it
  for (const std::string& order : ordered) expect_color(center(scene, order), glm::dvec3(0.0));
}

// A sphere stretched to half axes 3, 1, 1, and one that is not, in one order.
TEST_F(Transparent, EllipsoidsBesideSpheres) {
  glm::dmat4 stretched(1.0);
  stretched[0][0] = 3.0;
  Scene scene = join({placed(flat_sphere({0, 0, 0, 1}, red, 0.5), {stretched}), flat_sphere({0, 0, 3, 0.4}, green, 0.5)});
  scene.background = {0, 0, 0, 1};
  for (const std::string& order : ordered)
    for (const passes::Expansion expansion : {passes::Expansion::Vertex, passes::Expansion::Geometry}) {
      SCOPED_TRACE(order);
      const Colors colors = draw(scene, glyphs_over_opaque(order), {.expansion = expansion});
      expect_color(colors.center(), {0.25, 0.5, 0});
      expect_color(colors.at(4, 32), {0.5, 0, 0}); // 2.3 to the left
      expect_color(colors.at(32, 10), {0, 0, 0});  // 1.8 above
    }
}

TEST_F(Transparent, WeightedIsExactForOneColorAndNeedsNoOrder) {
  const Scene one = flat_sphere({0, 0, 0, 1}, red, 0.5);
  Scene scene = one;
  scene.background = {0, 0, 1, 1};
  expect_color(center(scene, "oit = \"weighted\""), {0.5, 0, 0.5});
  const Scene other = flat_sphere({0, 0, 3, 1}, green, 0.5);
  Scene first = join({one, other}), second = join({other, one});
  first.background = second.background = {0, 0, 1, 1};
  const glm::vec4 a = center(first, "oit = \"weighted\""), b = center(second, "oit = \"weighted\"");
  EXPECT_EQ(a, b);
  EXPECT_NEAR(a.b, 0.25, 1e-3); // what both let through
  EXPECT_NEAR(a.r + a.g, 0.75, 1e-3);
  EXPECT_GT(a.g, a.r) << "the nearer one weighs more";
}

// An opaque sphere in front hides, one inside lets the entry alone be seen, one behind is seen through both.
TEST_F(Transparent, OpaqueDepthIsRespectedSurfaceBySurface) {
  const double half = 1.0 - std::sqrt(0.5);
  const struct {
    double z;
    glm::dvec3 wanted;
  } cases[] = {{3, green}, {0, half * red + (1 - half) * green}, {-3, 0.5 * red + 0.5 * green}};
  for (const auto& c : cases) {
    Scene scene = join({flat_sphere({0, 0, 0, 1}, red, 0.5), flat_sphere({0, 0, c.z, 0.5}, green)});
    scene.background = {0, 0, 1, 1};
    for (const std::string& order : ordered) {
      SCOPED_TRACE(fmt::format("{} {}", c.z, order));
      expect_color(center(scene, order), c.wanted);
    }
    expect_color(center(scene, "oit = \"weighted\""), c.wanted);
  }
}

// The color of a graph is straight: over a background of alpha 0 a particle keeps its color and gives its alpha.
TEST_F(Transparent, BackgroundsThatAreNotOpaque) {
  Scene scene = join({flat_sphere({0, 0, 3, 1}, red, 0.5), flat_sphere({0, 0, 0, 1}, green, 0.5)});
  for (const double b : {0.0, 0.5}) {
    scene.background = {0, 0, 1, b};
    const double alpha = 0.75 + 0.25 * b;
    const glm::dvec3 wanted = (0.5 * red + 0.25 * green + 0.25 * b * blue) / alpha;
    for (const std::string& order : ordered) {
      SCOPED_TRACE(order);
      const Colors colors = draw(scene, glyphs_over_opaque(order));
      expect_color(colors.center(), wanted);
      EXPECT_NEAR(colors.center().a, alpha, 1e-3);
      expect_color(colors.at(0, 0), blue);
      EXPECT_NEAR(colors.at(0, 0).a, b, 1e-3);
      const Colors without = draw(scene, alone(order)); // starts from the background by itself
      expect_color(without.center(), wanted);
      EXPECT_NEAR(without.at(0, 0).a, b, 1e-3);
    }
  }
}

// Alpha of particles of one batch, times the batch's; 0 draws nothing, 1 is the opaque pass's.
TEST_F(Transparent, AlphaOfParticles) {
  Scene scene = scene_of({{0, 0, 6, 0.5}, {0, 0, 3, 1}, {0, 0, 0, 1}}, {0x00FFFFFFu, 0x330000FFu, 0xFF00FF00u}); // alpha 0, 1/5, 1
  scene.lights.clear();
  scene.ambient = glm::dvec3(1);
  for (const std::string& order : ordered) {
    SCOPED_TRACE(order);
    expect_color(center(scene, order), {0.2, 0.8, 0});
  }
  scene.batches[0].alpha = 0.5; // green is transparent now, too
  scene.background = {0, 0, 1, 1};
  for (const std::string& order : ordered) expect_color(center(scene, order), {0.1, 0.9 * 0.5, 0.9 * 0.5});
}

// Batches with and without colors of their own, of several materials and near the eye, in one order.
TEST_F(Transparent, OneOrderOverBatchesThatDiffer) {
  Scene colored = scene_of({{0, 0, 2, 0.5}}, {0xFF0000FFu});
  colored.batches[0].alpha = 0.5;
  Scene shiny = flat_sphere({0, 0, 0, 1}, green, 0.5);
  shiny.batches[0].material = {ShadingModel::Phong, 1, 1, 0.5, 10};
  const Scene plain = flat_sphere({0, 0, 6, 0.5}, blue, 0.5);
  for (Scene scene : {join({plain, colored, shiny}), join({shiny, plain, colored})}) {
    scene.lights.clear();
    scene.ambient = glm::dvec3(1);
    scene.background = {0, 0, 0, 1};
    for (const std::string& order : ordered) {
      SCOPED_TRACE(order);
      expect_color(center(scene, order), 0.5 * blue + 0.25 * red + 0.125 * green);
    }
  }
}

TEST_F(Transparent, WithoutTransparentParticlesThePassIsIdle) {
  const Scene scene = flat_sphere({0, 0, 0, 1}, green);
  const Colors colors = draw(scene, glyphs_over_opaque(""));
  EXPECT_THAT(colors.ran, ElementsAre("opaque"));
  expect_color(colors.center(), green);
}

// Fewer entries than needed: the picture is drawn in strips, and is the same.
TEST_F(Transparent, ExactInStripsOfBoundedMemory) {
  std::vector<Scene> layers;
  for (int i = 0; i < 40; ++i) layers.push_back(flat_sphere({0, 0, 0.1 * i - 2, 3}, {0.02 * i, 1 - 0.02 * i, 0.5}, 0.05));
  Scene scene = join(layers);
  const View large = look(scene, {0, 0, 10}, {0, 0, 0}, {256, 256});
  const Colors roomy = draw_graph(scene, large, glyphs_over_opaque("oit = \"exact\", memory = 128"), "glyphs.color");
  const Colors tight = draw_graph(scene, large, glyphs_over_opaque("oit = \"exact\", memory = 1"), "glyphs.color");
  EXPECT_TRUE(roomy.report.empty()) << to_string(roomy.report);
  EXPECT_TRUE(tight.report.empty()) << to_string(tight.report);
  EXPECT_EQ(roomy.texels, tight.texels);
}

// A row of pixels that needs more than the bound: what is left out is said, with what would hold it.
TEST_F(Transparent, OverflowIsReportedWithWhatWasNeeded) {
  std::vector<glm::dvec4> spheres(200, glm::dvec4(0, 0, 0, 2));
  Scene scene = scene_of(spheres);
  scene.batches[0].alpha = 0.01;
  const View wide = look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {512, 16}, 0.2);
  const Colors colors = draw_graph(scene, wide, glyphs_over_opaque("oit = \"exact\", memory = 1"), "glyphs.color");
  const std::string text = to_string(colors.report);
  EXPECT_THAT(text, HasSubstr("warning P005"));
  EXPECT_THAT(text, HasSubstr("pass 'glyphs' left out"));
  EXPECT_THAT(text, HasSubstr("one row needs 64000"));
  EXPECT_THAT(text, HasSubstr("memory = 2 (MiB)"));
  const Colors enough = draw_graph(scene, wide, glyphs_over_opaque("oit = \"exact\", memory = 2"), "glyphs.color");
  EXPECT_TRUE(enough.report.empty()) << to_string(enough.report);
  EXPECT_NEAR(enough.center().a, 1.0, 1e-3);
}

// Many spheres that overlap, in the double-precision reference: surface by surface along each ray.
class TransparentReference : public Transparent {
protected:
  static Scene cloud(std::size_t n, double r_min, double r_max) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<glm::dvec4> spheres;
    std::vector<std::uint32_t> colors;
    for (std::size_t i = 0; i < n; ++i) {
      spheres.emplace_back(10 * u(random), 10 * u(random), 10 * u(random), r_min * std::pow(r_max / r_min, 0.5 * (u(random) + 1)));
      colors.push_back(static_cast<std::uint32_t>(random()) | (i % 50 ? 0u : 0xFF000000u)); // some opaque, all alphas
    }
    Scene scene = scene_of(spheres, colors);
    scene.batches[0].material = {ShadingModel::BlinnPhong, 1, 0.8, 0.3, 20};
    scene.lights = {{.kind = LightKind::Directional, .direction = glm::normalize(glm::dvec3(-1, -1, -2)), .intensity = 0.8}};
    return scene;
  }
  // The largest difference over all pixels that are not ambiguous, in steps of 255.
  void expect_equal(const Scene& scene, const View& view, const std::string& params, double bar, bool two_surfaces = true) {
    const ReferencePicture reference = render_reference(scene, view, {.two_surfaces = two_surfaces});
    const Colors colors = draw_graph(scene, view, glyphs_over_opaque(params), "glyphs.color");
    double worst = 0, mean = 0;
    std::size_t ambiguous = 0, beyond = 0, at = 0;
    for (std::size_t i = 0; i < reference.color.size(); ++i) {
      if (reference.layers_ambiguous[i]) {
        ++ambiguous;
        continue;
      }
      const glm::dvec4 d = glm::abs(glm::dvec4(colors.texels[i]) - reference.color[i]);
      const double largest = std::max({d.r, d.g, d.b, d.a}) * 255.0;
      mean += largest;
      if (largest > worst) at = i;
      worst = std::max(worst, largest);
      beyond += largest > bar;
    }
    EXPECT_LE(worst, bar) << beyond << " pixels beyond, the worst at " << at % view.size.width << "," << at / view.size.width;
    EXPECT_LT(static_cast<double>(ambiguous), 0.1 * static_cast<double>(reference.color.size())) << "most pixels must count";
    EXPECT_GT(std::count_if(colors.texels.begin(), colors.texels.end(), [](const glm::vec4& c) { return c != glm::vec4(1); }), 5000);
  }
};

TEST_F(TransparentReference, ExactIsWithinOneStepPerspective) {
  const Scene scene = cloud(1500, 0.3, 2.0);
  expect_equal(scene, look(scene, {9, 12, 30}, {0, 0, 0}, {200, 125}), "oit = \"exact\"", 1.0);
  expect_equal(scene, look(scene, {9, 12, 30}, {0, 0, 0}, {200, 125}), "oit = \"exact\", surfaces = \"front\"", 1.0, false);
}
TEST_F(TransparentReference, ExactIsWithinOneStepOrthographic) {
  const Scene scene = cloud(1500, 0.3, 2.0);
  expect_equal(scene, look_orthographic(scene, {9, 12, 30}, {0, 0, 0}, {200, 125}, 24), "oit = \"exact\"", 1.0);
}
TEST_F(TransparentReference, ExactIsWithinOneStepFromInsideTheCloud) {
  const Scene scene = cloud(800, 0.3, 2.0);
  expect_equal(scene, look(scene, {1, 2, 3}, {0, 0, 0}, {200, 125}, 60), "oit = \"exact\"", 1.0);
  View cut = look(scene, {9, 12, 30}, {0, 0, 0}, {200, 125});
  cut.near_cut = 30;
  cut.far_cut = 36;
  expect_equal(scene, cut, "oit = \"exact\"", 1.0);
}

// Disjoint spheres with the eye outside: the power of the eye is the exact order.
TEST_F(TransparentReference, SortedIsExactForDisjointSpheres) {
  std::vector<glm::dvec4> spheres;
  std::vector<std::uint32_t> colors;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(0, 1);
  for (int x = 0; x < 9; ++x)
    for (int y = 0; y < 9; ++y)
      for (int z = 0; z < 9; ++z) {
        spheres.emplace_back(x - 4 + 0.2 * u(random), y - 4 + 0.2 * u(random), z - 4 + 0.2 * u(random), 0.1 + 0.29 * u(random));
        colors.push_back(static_cast<std::uint32_t>(random()));
      }
  const Scene scene = scene_of(spheres, colors);
  for (const char* order : {"back_to_front", "front_to_back"}) {
    expect_equal(scene, look(scene, {5, 7, 14}, {0, 0, 0}, {200, 125}), fmt::format("order = \"{}\"", order), 1.0);
    expect_equal(scene, look_orthographic(scene, {5, 7, 14}, {0, 0, 0}, {200, 125}, 12), fmt::format("order = \"{}\"", order), 1.0);
  }
}

TEST_F(Transparent, ParametersThatDoNotGoTogether) {
  const auto expect_error = [](const std::string& params, const std::string& code, const std::vector<std::string>& words) {
    const Diagnostics diagnostics = check_graph(glyphs_over_opaque(params));
    ASSERT_TRUE(diagnostics.has_errors()) << params;
    for (const std::string& word : words) EXPECT_THAT(to_string(diagnostics), HasSubstr(word));
    EXPECT_THAT(to_string(diagnostics), HasSubstr("error " + code));
  };
  expect_error("oit = \"exact\", depth_write = true", "P006", {"test.toml:11:", "depth_write", "oit"});
  expect_error("oit = \"weighted\", blend = \"over\"", "P006", {"blend"});
  expect_error("oit = \"exact\", order = \"file\"", "P006", {"order"});
  expect_error("order = \"front_to_back\", blend = \"over\"", "P006", {"accumulates alpha"});
  expect_error("order = \"sorted\"", "G023", {"back_to_front, front_to_back, file"});
  expect_error("oit = \"peeling\"", "G023", {"none, weighted, exact"});
  expect_error("surfaces = \"back\"", "G023", {"both, front"});
  expect_error("memory = 0", "G022", {"memory"});
  const Diagnostics draw = check_graph(glyphs_over_opaque("", "draw = [\"opaqe\"]"));
  EXPECT_THAT(to_string(draw), HasSubstr("error G031"));
  EXPECT_THAT(to_string(draw), HasSubstr("Did you mean 'opaque'?"));
}

} // namespace
} // namespace mote::test
