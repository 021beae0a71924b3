// SPDX-License-Identifier: MIT
// `shadow_map` and the passes that take its map, against answers known in closed form and against the
// reference's shadow rays. "Wrong" is a pixel that faces the light and shows light where the ray is
// blocked, or the reverse (method book, section 8.2; failure cases FC-42, FC-44).
#include "harness.hpp"
#include "shadow_harness.hpp"

#include "core/reference/reference.hpp"
#include "core/scene/generated.hpp"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace mote::test {
namespace {

using passes::Expansion;
using testing::HasSubstr;

class Shadows : public ShadowTest {
protected:
  static Scene cloud(std::size_t n, double radius, const Light& light) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> u(-10, 10);
    std::vector<glm::dvec4> spheres;
    for (std::size_t i = 0; i < n; ++i) spheres.push_back({u(random), u(random), u(random), radius});
    Scene scene = scene_of(spheres);
    scene.lights = {light};
    return scene;
  }
};

// A small sphere throws its disc onto a large one: the point under it is dark, one beside it is not.
TEST_P(Shadows, KnownAnswer) {
  for (const char* method : {"ids", "depth"}) {
    Scene scene = scene_of({{0, 0, 0, 2}, {0, 5, 0, 0.5}});
    scene.lights = {sun({0, -1, 0})};
    const View view = look(scene, {0, 12, 12}, {0, 2, 0}, {200, 200});
    const Picture p = draw(scene, view, {}, {std::string("shadow.method=\"") + method + "\""});
    const auto at = [&](glm::dvec3 world) {
      const glm::dvec3 v = view.to_view(world);
      return p.color[p.at(static_cast<std::uint32_t>(v.x / v.z * view.focal + 100), static_cast<std::uint32_t>(v.y / v.z * view.focal + 100))].g;
    };
    EXPECT_NEAR(at({0, 2, 0}), 0.8 * 0.2, 1e-3) << method << ": ambient light only";
    const double y = std::sqrt(4 - 0.8 * 0.8);
    EXPECT_NEAR(at({0.8, y, 0}), 0.8 * (0.2 + 0.8 * y / 2), 6e-3) << method << ": beside the shadow";
    const ShadowErrors e = shadow_errors(p, scene, view);
    EXPECT_GT(e.shadowed, 100u);
    EXPECT_LE(e.wrong(), 1e-3) << method;
  }
}

// Depth, id, normal and unshadowed color are what the passes without shadows draw.
TEST_P(Shadows, AovsAndShadingAreThoseOfTheReference) {
  Scene scene = cloud(200, 1.4, sun({1, -0.4, -0.3}));
  scene.batches[0].material = {ShadingModel::BlinnPhong, 0.9, 0.8, 0.5, 30.0};
  scene.lights.push_back({.name = "lamp", .kind = LightKind::Point, .position = {20, 20, 20}, .intensity = 0.3});
  for (const bool orthographic : {false, true}) {
    const View view = orthographic ? look_orthographic(scene, {5, 8, 60}, {0, 0, 0}, {192, 108}, 24) : look(scene, {5, 8, 60}, {0, 0, 0}, {192, 108});
    Scene open = scene;
    for (Light& light : open.lights) light.shadows = false;
    expect_equals_reference(draw(open, view), open, view, {.least_hits = 0.2}); // the map's pass is idle
    const Picture p = draw(scene, view);
    const ShadowErrors e = shadow_errors(p, scene, view);
    EXPECT_GT(e.shadowed, 300u);
    EXPECT_EQ(e.false_shadow + e.false_light, 0u);
    expect_equals_reference(p, scene, view, {.least_hits = 0.2});
  }
}

// At most one wrong pixel in a thousand, in windows of any shape; false shadow never.
TEST_P(Shadows, FewPixelsAreWrongInWindowsOfAnyShape) {
  const Scene scene = cloud(10000, 0.4, sun({1, -0.35, 0.2}));
  for (const Size2d size : {Size2d{480, 270}, Size2d{270, 480}, Size2d{300, 300}}) {
    const View view = look(scene, {18, 12, 45}, {0, 0, 0}, size);
    const ShadowErrors e = shadow_errors(draw(scene, view, {}, {"shadow.size=768"}), scene, view);
    EXPECT_EQ(tiled_, GetParam() == Expansion::Compute);
    EXPECT_GT(e.facing, 5000u);
    EXPECT_GT(static_cast<double>(e.shadowed), 0.2 * static_cast<double>(e.facing));
    EXPECT_LE(e.wrong(), 1e-3) << e.false_shadow << " false shadow, " << e.false_light << " false light of " << e.facing;
    EXPECT_LE(e.false_shadow, 2u);
  }
}

// The scene that speed and accuracy are stated for, at the map's default size. MOTE_ACCURACY=full (tests/accuracy.sh)
// draws it in full-size windows, too.
TEST_P(Shadows, TheBenchmarkSceneAtTheDefaultSize) {
  const GeneratedParticles made = generate_spheres(100000, 1);
  std::vector<glm::dvec4> spheres;
  for (std::size_t i = 0; i < made.radii.size(); ++i) spheres.push_back({made.positions[3 * i], made.positions[3 * i + 1], made.positions[3 * i + 2], made.radii[i]});
  Scene scene = scene_of(spheres);
  scene.lights = {sun({1, 0.4, -0.3})};
  const bool full = std::getenv("MOTE_ACCURACY") != nullptr;
  for (const Size2d size : {Size2d{640, 360}, Size2d{1920, 1080}, Size2d{1080, 1920}}) {
    if (size.width > 640 && !full) continue;
    const View view = make_view(generated_camera({.count = 100000}), size, scene.bounds.diagonal());
    const ShadowErrors e = shadow_errors(draw(scene, view), scene, view);
    if (full) fmt::print("{}x{}: {} wrong of {} facing ({} false shadow, {} false light)\n", size.width, size.height, e.false_shadow + e.false_light, e.facing, e.false_shadow, e.false_light);
    EXPECT_LE(e.wrong(), 1e-3) << e.false_shadow << " false shadow, " << e.false_light << " false light of " << e.facing;
    EXPECT_GT(e.shadowed, e.facing / 4);
  }
}

TEST_P(Shadows, DepthMapsErrLittleAndHaveNoAcne) {
  const Scene scene = cloud(1000, 0.9, sun({1, -0.35, 0.2}));
  const View view = look(scene, {18, 12, 45}, {0, 0, 0}, {320, 240});
  const ShadowErrors soft = shadow_errors(draw(scene, view, {}, {"shadow.method=\"depth\"", "shadow.size=2048"}), scene, view);
  EXPECT_LE(soft.wrong(), 0.02);
  const ShadowErrors hard = shadow_errors(draw(scene, view, {}, {"shadow.method=\"depth\"", "shadow.size=2048", "shadow.pcf=0"}), scene, view);
  EXPECT_LE(hard.wrong(), 0.008);
  const ShadowErrors coarse = shadow_errors(draw(scene, view, {}, {"shadow.method=\"depth\"", "shadow.size=128", "shadow.pcf=0"}), scene, view);
  EXPECT_GT(coarse.wrong(), hard.wrong()) << "the measure sees what a coarse map does";
}

// One sphere alone never shades itself, up to the limb of light; the same picture without the offset does.
TEST_P(Shadows, NoAcneAtLimbs) {
  Scene scene = scene_of({{0, 0, 0, 3}});
  scene.lights = {sun({1, -0.2, -0.1})};
  const View view = look(scene, {0, 2, 14}, {0, 0, 0}, {300, 300});
  for (const std::string& size : {std::string("32"), std::string("1024")}) {
    const ShadowErrors ids = shadow_errors(draw(scene, view, {}, {"shadow.size=" + size}), scene, view);
    EXPECT_EQ(ids.false_shadow, 0u);
    EXPECT_GT(ids.facing, 10000u);
    EXPECT_EQ(shadow_errors(draw(scene, view, {}, {"shadow.method=\"depth\"", "shadow.size=" + size}), scene, view).false_shadow, 0u);
    EXPECT_GT(shadow_errors(draw(scene, view, {}, {"shadow.method=\"depth\"", "shadow.normal_offset=0.0", "shadow.size=" + size}), scene, view).false_shadow, 100u);
  }
}

// Two touching spheres, the light along the line of their centers: the shadow begins at the contact. Its gap is
// measured in a view that has 500 pixels a radius.
TEST_P(Shadows, ContactGap) {
  Scene scene = scene_of({{0, 0, 0, 1}, {0, 2, 0, 1}});
  scene.lights = {sun({-0.6, -1, 0})};
  const View view = look_orthographic(scene, {0, 1, 40}, {0, 1, 0}, {400, 400}, 0.8);
  const Picture p = draw(scene, view);
  const ReferencePicture truth = render_reference(scene, view);
  double gap = 0.0;
  std::size_t shadowed = 0;
  for (std::size_t i = 0; i < truth.id.size(); ++i) {
    if (truth.id[i] == reference_no_id || truth.ambiguous[i]) continue;
    shadowed += truth.color[i].g < 0.17;
    if (std::abs(p.color[i].g - truth.color[i].g) < 0.02) continue;
    const double x = (static_cast<double>(i % 400) - 199.5) / 500, y = (static_cast<double>(i / 400) - 199.5) / 500;
    gap = std::max(gap, std::hypot(x, y));
  }
  EXPECT_GT(shadowed, 2000u);
  EXPECT_LT(gap, 0.02);
}

// The eye within the cloud: what is near it is no matter for tiles, and shadows are asked of the surfaces that all leave.
TEST_P(Shadows, FromWithinTheCloud) {
  const Scene scene = cloud(800, 0.5, sun({1, -0.35, 0.2}));
  const View view = look(scene, {-5.3, 0.2, 0.1}, {5, 1, 2}, {320, 240}, 60.0);
  const ShadowErrors e = shadow_errors(draw(scene, view, {}, {"shadow.size=2048"}), scene, view);
  EXPECT_GT(e.shadowed, 5000u);
  EXPECT_GT(e.facing, e.shadowed + 5000u);
  EXPECT_LE(e.wrong(), 1e-3) << e.false_shadow << " false shadow, " << e.false_light << " false light of " << e.facing;
}

// Casters of several batches and instances: each is one of its own, and no particle shadows itself.
TEST_P(Shadows, BatchesAndInstances) {
  Scene scene = placed(cloud(500, 0.8, sun({1, -0.35, 0.2})), {glm::dmat4(1.0), glm::translate(glm::dmat4(1.0), glm::dvec3(4, 3, -2))});
  Scene more = placed(cloud(700, 0.6, sun({1, -0.35, 0.2})), {glm::translate(glm::dmat4(1.0), glm::dvec3(-3, 5, 3)), glm::translate(glm::dmat4(1.0), glm::dvec3(1, -4, 2))});
  more.batches[0].id_base = scene.particle_count();
  scene.batches.push_back(more.batches[0]);
  scene.bounds.add(more.bounds);
  const View view = look(scene, {18, 12, 55}, {0, 0, 0}, {320, 240});
  const ShadowErrors e = shadow_errors(draw(scene, view), scene, view);
  EXPECT_EQ(tiled_, GetParam() == Expansion::Compute);
  EXPECT_GT(e.shadowed, 2000u);
  EXPECT_LE(e.wrong(), 1e-3) << e.false_shadow << " false shadow, " << e.false_light << " false light of " << e.facing;
}

// Casters of a texel or less, which tiles draw by splats: too small for the map, but tiles are no worse than quads are.
TEST_P(Shadows, CastersOfATexel) {
  const Scene scene = cloud(60000, 0.1, sun({1, -0.35, 0.2}));
  const View view = look(scene, {18, 12, 45}, {0, 0, 0}, {480, 360});
  for (const char* size : {"shadow.size=160", "shadow.size=256"}) { // by splats, and not
    const ShadowErrors own = shadow_errors(draw(scene, view, {}, {size}), scene, view);
    const ShadowErrors quads = shadow_errors(GpuTest::draw(scene, view, {.expansion = Expansion::Vertex}, {size}), scene, view);
    EXPECT_EQ(tiled_, GetParam() == Expansion::Compute);
    EXPECT_GT(own.shadowed, 1500u) << size;
    EXPECT_LE(own.wrong(), 1.1 * quads.wrong()) << size << ", of " << own.facing << " facing the light, " << own.shadowed << " in shadow";
  }
}

TEST_P(Shadows, SpotLights) {
  Light spot{.name = "spot", .kind = LightKind::Spot, .direction = glm::normalize(glm::dvec3(-1, -1, -0.2)), .position = {22, 22, 5},
             .intensity = 0.8, .inner_angle = 0.3, .outer_angle = 0.4, .shadows = true};
  const Scene scene = cloud(1500, 0.8, spot);
  const View view = look(scene, {18, 12, 45}, {0, 0, 0}, {320, 240});
  const ShadowErrors e = shadow_errors(draw(scene, view), scene, view);
  EXPECT_GT(e.shadowed, 500u);
  EXPECT_LE(e.wrong(), 1e-3) << e.false_shadow << " false shadow, " << e.false_light << " false light of " << e.facing;
}

// Each light asks its own map: with the other's intensity 0, shadows are those of the one that is left.
TEST_P(Shadows, TwoLightsAMapEach) {
  graph_ = "../../tests/passes/two_shadows";
  Scene scene = cloud(1500, 0.8, sun({1, -0.35, 0.2}));
  scene.lights.push_back({.name = "lamp", .kind = LightKind::Point, .position = {20, 20, 20}, .intensity = 0.1});
  scene.lights.push_back({.name = "spot", .kind = LightKind::Spot, .direction = glm::normalize(glm::dvec3(-1, -1, -0.2)), .position = {22, 22, 5},
                          .intensity = 0.8, .inner_angle = 0.3, .outer_angle = 0.4, .shadows = true});
  const View view = look(scene, {18, 12, 45}, {0, 0, 0}, {320, 240});
  const Picture both = draw(scene, view);
  EXPECT_EQ(tiled_, GetParam() == Expansion::Compute);
  for (const std::size_t other : {0u, 2u}) {
    Scene one = scene;
    one.lights[other].intensity = 0.0;
    const ShadowErrors e = shadow_errors(draw(one, view), one, view);
    EXPECT_GT(e.shadowed, 500u);
    EXPECT_LE(e.wrong(), 1e-3) << e.false_shadow << " false shadow, " << e.false_light << " false light of " << e.facing;
  }
  const ReferencePicture truth = render_reference(scene, view);
  std::size_t off = 0, hits = 0;
  for (std::size_t i = 0; i < truth.id.size(); ++i) {
    if (truth.id[i] == reference_no_id || truth.ambiguous[i]) continue;
    ++hits;
    off += std::abs(both.color[i].g - truth.color[i].g) > 4e-3;
  }
  EXPECT_LE(static_cast<double>(off), 1e-3 * static_cast<double>(hits)) << "of " << hits;
}

// FC-44: a light inside a sphere lights its inner wall only.
TEST_P(Shadows, LightInsideASphere) {
  Scene scene = scene_of({{0, 0, 0, 2}, {0, -6, 0, 2}, {3, -6, 0, 0.4}});
  scene.lights = {{.name = "spot", .kind = LightKind::Spot, .direction = {0, -1, 0}, .position = {0, 0.5, 0}, .intensity = 0.8,
                   .inner_angle = 0.6, .outer_angle = 0.7, .shadows = true}};
  const View view = look(scene, {0, 2, 20}, {0, -3, 0}, {200, 200});
  const ShadowErrors e = shadow_errors(draw(scene, view), scene, view);
  EXPECT_GT(e.shadowed, 500u);
  EXPECT_EQ(e.false_shadow + e.false_light, 0u);
}

// A head light stands behind the eye but looks along the view axis: off the axis its shadows are seen.
TEST_P(Shadows, HeadLight) {
  Scene scene = cloud(1500, 0.8, {.name = "head", .kind = LightKind::Headlight, .intensity = 0.8, .shadows = true});
  const View view = look(scene, {0, 0, 30}, {0, 0, 0}, {320, 240}, 50.0);
  const ShadowErrors e = shadow_errors(draw(scene, view), scene, view);
  EXPECT_GT(e.shadowed, 100u);
  EXPECT_LE(e.wrong(), 1e-3);
}

// FC-43, FC-46: casters thinner than a texel.
TEST_P(Shadows, CastersBelowATexel) {
  std::vector<glm::dvec4> spheres{{0, 0, 0, 8}};
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> u(-6, 6);
  for (int i = 0; i < 300; ++i) spheres.push_back({u(random), 10 + 0.1 * u(random), u(random), 0.05});
  Scene scene = scene_of(spheres);
  scene.lights = {sun({0.05, -1, 0.02})};
  const View view = look(scene, {0, 25, 25}, {0, 3, 0}, {600, 400}, 35.0);
  const ShadowErrors e = shadow_errors(draw(scene, view, {}, {"shadow.size=128"}), scene, view); // texel 0.15, casters 0.1 across
  EXPECT_GT(e.shadowed, 300u);
  EXPECT_LE(static_cast<double>(e.false_light), 0.05 * static_cast<double>(e.shadowed)) << "of " << e.shadowed;
  EXPECT_EQ(e.false_shadow, 0u);
}

TEST_P(Shadows, TransparentParticlesCastNoneUnlessAsked) {
  Scene scene = scene_of({{0, 0, 0, 2}});
  Batch veil = scene_of({{0, 5, 0, 0.5}}).batches[0];
  veil.alpha = 0.5;
  veil.id_base = 1;
  scene.batches.push_back(veil);
  scene.bounds.add({0, 5, 0}, 0.5);
  scene.lights = {sun({0, -1, 0})};
  const View view = look_orthographic(scene, {0, 2.4, 20}, {0, 2.4, 0}, {100, 100}, 8);
  const std::uint32_t x = 50, y = 55; // just below the top of the large sphere
  const double lit = draw(scene, view).color[y * 100 + x].g, dark = draw(scene, view, {}, {"shadow.transparent=true"}).color[y * 100 + x].g;
  EXPECT_GT(lit, 0.5);
  EXPECT_NEAR(dark, 0.16, 2e-3);
}

// ---- what can go wrong ------------------------------------------------------------------------------
class ShadowMistakes : public Shadows {
protected:
  std::string message(const Scene& scene, const std::vector<std::string>& settings) {
    return failure_of([&] { draw(scene, look(scene, {0, 0, 20}, {0, 0, 0}, {64, 64}), {}, settings); });
  }
};

TEST_P(ShadowMistakes, ALightThatIsNotThere) {
  Scene scene = cloud(10, 0.5, sun({1, 0, 0}));
  EXPECT_EQ(message(scene, {"shadow.light=\"sun\""}), "it was drawn");
  EXPECT_THAT(message(scene, {"shadow.light=\"sum\""}), testing::AllOf(HasSubstr("error P015: the scene has no light named 'sum'"),
                                                                       HasSubstr("Lights: sun."), HasSubstr("Did you mean 'sun'?")));
}

TEST_P(ShadowMistakes, LightsThatOneMapCannotHold) {
  Scene scene = cloud(10, 0.5, sun({1, 0, 0}));
  scene.lights[0].kind = LightKind::Point;
  EXPECT_THAT(message(scene, {}), testing::AllOf(HasSubstr("error P017"), HasSubstr("'sun' is a point light")));
  scene.lights[0].kind = LightKind::Spot;
  scene.lights[0].outer_angle = 1.5;
  EXPECT_THAT(message(scene, {}), testing::AllOf(HasSubstr("error P017"), HasSubstr("85.94 degrees")));
}

TEST_P(ShadowMistakes, AMapThatTheDeviceOrMemoryCannotHold) {
  const Scene scene = cloud(10, 0.5, sun({1, 0, 0}));
  EXPECT_THAT(message(scene, {"shadow.size=65536"}), testing::AllOf(HasSubstr("shadowed.toml:7:1: error G070: the width of 'shadow.map'"), HasSubstr("65536")));
  EXPECT_THAT(message(scene, {"shadow.size=16384"}), HasSubstr("shadowed.toml:7:1: error G071: 'shadow.map' cannot be made"));
}

INSTANTIATE_TEST_SUITE_P(, Shadows, testing::Values(Expansion::Vertex, Expansion::Compute), [](const auto& p) { return std::string(to_string(p.param)); });
INSTANTIATE_TEST_SUITE_P(, ShadowMistakes, testing::Values(Expansion::Vertex, Expansion::Compute), [](const auto& p) { return std::string(to_string(p.param)); });

} // namespace
} // namespace mote::test
