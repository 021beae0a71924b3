// SPDX-License-Identifier: MIT
// Shadows of spheres and ellipsoids that a transform scales unevenly or shears, by the default map: against an outline known in closed
// form, the same shapes given as type `ellipsoid`, and the reference's shadow rays; by every expansion.
#include "harness.hpp"
#include "shadow_harness.hpp"
#include "transforms.hpp"

#include "core/base/diagnostic.hpp"
#include "core/math/principal_axes.hpp"
#include "core/reference/reference.hpp"

#include <glm/gtc/quaternion.hpp>

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace mote::test {
namespace {

using passes::Expansion;
using testing::HasSubstr;

Light spot(glm::dvec3 position, glm::dvec3 target, double angle) {
  return {.name = "spot", .kind = LightKind::Spot, .direction = glm::normalize(target - position), .position = position, .intensity = 0.8,
          .inner_angle = 0.8 * angle, .outer_angle = angle, .shadows = true};
}
Scene lit(Scene scene, const Light& light) {
  scene.lights = {light};
  return scene;
}

class AffineShadows : public ShadowTest {};
INSTANTIATE_TEST_SUITE_P(, AffineShadows, testing::Values(Expansion::Vertex, Expansion::Geometry, Expansion::Compute, Expansion::Point),
                         [](const auto& p) { return std::string(to_string(p.param)); });

// Light from above: the shadow on the (nearly flat) ground is the ellipsoid's projection along y, whose extent along a direction n of
// the ground is |M^T n|. Points 0.06 within and beyond its outline (2 pixels), all around.
TEST_P(AffineShadows, OutlineOfAShearedSphere) {
  glm::dmat4 m = scaled(2.2, 0.5, 0.8);
  m[1] = glm::dvec4(0.5, 0.5, -0.3, 0); // sheared
  const Scene scene = lit(joined(scene_of({{0, -100, 0, 100}}), placed(scene_of({{0, 0, 0, 1}}), {moved(0.1, 4, 0.2) * m})), sun({0, -1, 0}));
  const View view = look(scene, {0, 20, 20}, {0, 0, -1}, {400, 300}, 22.0);
  const Picture p = draw(scene, view);
  for (int i = 0; i < 48; ++i) {
    const double a = 0.1309 * i;
    const glm::dvec3 n(std::cos(a), 0, std::sin(a)), reach = glm::transpose(glm::dmat3(m)) * n;
    const glm::dvec3 outline = glm::dvec3(0.1, 0, 0.2) + glm::dmat3(m) * glm::normalize(reach);
    for (const double off : {-0.06, 0.06}) {
      const glm::dvec2 ground = glm::dvec2(outline.x, outline.z) + off * glm::dvec2(n.x, n.z);
      const glm::dvec3 v = view.to_view({ground.x, -100 + std::sqrt(10000 - glm::dot(ground, ground)), ground.y});
      const std::size_t at = p.at(static_cast<std::uint32_t>(v.x / v.z * view.focal + 200), static_cast<std::uint32_t>(v.y / v.z * view.focal + 150));
      ASSERT_EQ(p.id[at], 0u) << "the ground is seen";
      if (off < 0) EXPECT_NEAR(p.color[at].g, 0.8 * 0.2, 2e-3) << "in the shadow, direction " << a;
      else EXPECT_GT(p.color[at].g, 0.7) << "beside it, direction " << a;
    }
  }
}

// What a linear map makes of spheres, said as particles of type `ellipsoid`.
Scene as_ellipsoids(const std::vector<glm::dvec4>& spheres, const glm::dmat4& m) {
  const PrincipalAxes shape = principal_axes(glm::dmat3(m));
  const glm::dquat q = glm::quat_cast(shape.axes);
  std::vector<Glyph> glyphs;
  for (const glm::dvec4& s : spheres)
    glyphs.push_back({glm::dvec3(m * glm::dvec4(glm::dvec3(s), 1)), 1.00001 * s.w * shape.longest(), s.w * shape.shortest(),
                      {glm::vec4(q.x, q.y, q.z, q.w), glm::vec4(glm::vec3(s.w * shape.lengths), 0)}});
  return glyph_scene("ellipsoid", glyphs);
}

TEST_P(AffineShadows, EqualThoseOfTheSameEllipsoids) {
  const std::vector<glm::dvec4> spheres = cloud(80, 4, 0.3, 0.9);
  const Scene ground = scene_of({{0, -20, 0, 14}});
  for (const Light& light : {sun({0.4, -1, 0.3}), spot({-9, 14, 6}, {0, -2, 0}, 0.7)}) {
    const Scene scene = lit(joined(ground, placed(scene_of(spheres), {general()})), light);
    const View view = look(scene, {4, 12, 26}, {0, -2, 0}, {240, 180}, 36.0);
    const Picture p = draw(scene, view), truth = GpuTest::draw(lit(joined(ground, as_ellipsoids(spheres, general())), light), view, {.expansion = Expansion::Vertex});
    const ReferencePicture reference = render_reference(scene, view);
    std::size_t dark = 0, off = 0;
    for (std::size_t i = 0; i < p.id.size(); ++i) {
      if (reference.ambiguous[i] || p.id[i] == 0xFFFFFFFFu) continue;
      dark += truth.color[i].g < 0.17;
      off += p.id[i] != truth.id[i] || std::abs(p.color[i].g - truth.color[i].g) > 0.01f;
    }
    EXPECT_GT(dark, 1000u);
    EXPECT_LE(off, 1u);
  }
}

TEST_P(AffineShadows, EqualShadowRays) {
  const Scene shapes = placed(scene_of(cloud(400, 7, 0.2, 0.9)), {general()});
  ASSERT_LT(glm::determinant(glm::dmat3(general())), 0.0) << "mirrored, too";
  const Light head{.name = "head", .kind = LightKind::Headlight, .intensity = 0.8, .shadows = true};
  for (const Light& light : {sun({1, -0.5, -0.4}), spot({20, 20, 8}, {0, 0, 0}, 0.45), head}) {
    const Scene scene = lit(shapes, light);
    const bool orthographic = light.kind == LightKind::Spot;
    const View view = orthographic ? look_orthographic(scene, {9, 12, 40}, {0, 0, 0}, {240, 160}, 22) : look(scene, {9, 12, 40}, {0, 0, 0}, {240, 160});
    const ShadowErrors e = shadow_errors(draw(scene, view), scene, view);
    EXPECT_GT(e.shadowed, light.kind == LightKind::Headlight ? 50u : 800u) << light.name;
    EXPECT_LE(e.wrong(), 1e-3) << light.name << ": " << e.false_shadow << " false shadow, " << e.false_light << " false light of " << e.facing;
  }
}

// One alone never shades itself, up to the limb of light, at any size of the map.
TEST_P(AffineShadows, NoAcneAtLimbs) {
  const Scene scene = lit(placed(scene_of({{0, 0, 0, 2}}), {general()}), sun({1, -0.2, -0.1}));
  const View view = look(scene, {0, 2, 14}, {0, 0, 0}, {240, 240});
  for (const std::string& size : {std::string("32"), std::string("1024")}) {
    const ShadowErrors e = shadow_errors(draw(scene, view, {}, {"shadow.size=" + size}), scene, view);
    EXPECT_GT(e.facing, 4000u);
    EXPECT_EQ(e.false_shadow + e.false_light, 0u);
  }
}

// Instances of one batch, of which some stay spheres: those are drawn by tiles where tiles are asked for, the others on top.
TEST_P(AffineShadows, InstancesOfManyKinds) {
  const glm::dmat4 stretched = moved(4, 1, 0) * scaled(0.6, 1.8, 1.0);
  const Scene scene = lit(placed(scene_of(cloud(90, 2.5, 0.2, 0.7)), {moved(-5, 0, 0), moved(0, 4, 0) * general(), stretched, moved(0, -3, 1) * turned(0.4, {1, 1, 0}) * scaled(-1.3, 1.3, 1.3)}),
                          sun({0.5, -1, -0.4}));
  const View view = look(scene, {3, 9, 30}, {0, 0, 0}, {280, 200}, 36.0);
  const ShadowErrors e = shadow_errors(draw(scene, view), scene, view);
  EXPECT_EQ(tiled_, GetParam() == Expansion::Compute);
  EXPECT_GT(e.shadowed, 2000u);
  EXPECT_LE(e.wrong(), 1e-3) << e.false_shadow << " false shadow, " << e.false_light << " false light of " << e.facing;
}

// A light inside a stretched sphere lights its inner wall only, and one close to others throws their shadows: chunks at the light's
// eye are placed in double.
TEST_P(AffineShadows, LightInsideAndNear) {
  const glm::dmat4 m = turned(0.5, {0, 0, 1}) * scaled(1.6, 0.8, 1.0);
  const Scene around = lit(placed(scene_of({{0, 0, 0, 2}, {0, -6, 0, 2}, {3, -6, 0, 0.4}}), {m}), spot({0, 0.4, 0}, {0, -9, 0}, 0.7));
  const View view = look(around, {0, 2, 22}, {0, -3, 0}, {200, 200}, 40.0);
  const ShadowErrors wall = shadow_errors(draw(around, view), around, view);
  EXPECT_GT(wall.shadowed, 300u);
  EXPECT_EQ(wall.false_shadow + wall.false_light, 0u);
  const Scene among = lit(placed(scene_of(cloud(300, 5, 0.1, 0.5)), {m}), spot({0.2, 0.1, 0.3}, {1, -3, -2}, 0.9));
  const View outside = look(among, {4, 8, 26}, {0, 0, 0}, {240, 160}, 34.0);
  const ShadowErrors e = shadow_errors(draw(among, outside), among, outside);
  EXPECT_GT(e.facing, 300u);
  EXPECT_GT(e.shadowed, 30u);
  EXPECT_LE(e.wrong(), 2e-3) << e.false_shadow << " false shadow, " << e.false_light << " false light of " << e.facing;
}

// Discs and needles that are thinner than a texel of the map, though their records' radii are not.
TEST_P(AffineShadows, CastersBelowATexel) {
  std::vector<glm::dvec4> spheres;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> u(-4, 4);
  for (int i = 0; i < 40; ++i) spheres.push_back({u(random), 2.5 * u(random), 10 * u(random), 0.8});
  const Scene scene = lit(joined(scene_of({{0, -8, 0, 8}}), placed(scene_of(spheres), {moved(0, 3, 0) * scaled(1.0, 0.06, 0.06)})), sun({0.05, -1, 0.02}));
  const View view = look(scene, {0, 15, 25}, {0, 0, 0}, {400, 260}, 30.0);
  const ShadowErrors e = shadow_errors(draw(scene, view, {}, {"shadow.size=128"}), scene, view); // texel 0.13, needles 0.096 across
  EXPECT_GT(e.shadowed, 300u);
  EXPECT_LE(static_cast<double>(e.false_light), 0.1 * static_cast<double>(e.shadowed)) << "of " << e.shadowed;
  EXPECT_EQ(e.false_shadow, 0u);
}

// ---- other types -------------------------------------------------------------------------------------
class AffineGlyphShadows : public GpuTest {
protected:
  AffineGlyphShadows() { graph_ = "shadowed"; }
  // Turned and of all proportions, up to 1:6.
  static std::vector<Glyph> shapes(int count) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> u(-1, 1);
    std::vector<Glyph> out;
    for (int i = 0; i < count; ++i) {
      const glm::vec3 half = 0.5f * glm::exp(0.9f * glm::vec3(u(random), u(random), u(random)));
      const glm::vec4 q = glm::normalize(glm::vec4(u(random), u(random), u(random), u(random)));
      out.push_back({4.0 * glm::dvec3(u(random), u(random), u(random)), 1.0001 * std::max(half.x, std::max(half.y, half.z)), std::min(half.x, std::min(half.y, half.z)), {q, glm::vec4(half, 0)}});
    }
    return out;
  }
};

// An ellipsoid under an affine map is another one, whose axes each fragment of the map finds.
TEST_F(AffineGlyphShadows, EllipsoidsEqualShadowRays) {
  const Scene shapes_ = placed(glyph_scene("ellipsoid", shapes(120)), {moved(-6, 0, 0) * general(), moved(6, 0, 0), moved(0, 6, 0) * scaled(1, 0.1, 1), moved(0, -6, 0) * scaled(0.3, 1.2, 1e-3)});
  for (const Light& light : {sun({1, -0.6, -0.5}), spot({12, 20, 14}, {0, 0, 0}, 0.7)}) {
    const Scene scene = lit(shapes_, light);
    const View view = look(scene, {4, 6, 34}, {0, 0, 0}, {280, 200}, 38.0);
    for (const Expansion expansion : {Expansion::Vertex, Expansion::Compute}) {
      const ShadowErrors e = shadow_errors(draw(scene, view, {.expansion = expansion}), scene, view);
      EXPECT_GT(e.shadowed, 2000u);
      EXPECT_LE(e.wrong(), 2e-3) << e.false_shadow << " false shadow, " << e.false_light << " false light of " << e.facing;
    }
  }
}

TEST_F(AffineGlyphShadows, OtherTypesAreRefused) {
  const auto message = [&](const Scene& scene, const std::vector<std::string>& settings) {
    return failure_of([&] { draw(scene, look(scene, {0, 0, 20}, {0, 0, 0}, {64, 64}), {}, settings); });
  };
  const std::vector<Glyph> rods{{{0, 0, 0}, 1.2, 0.3, {glm::vec4(0.7, 0.7, 0, 0.3), glm::vec4(0.3, 0, 0, 0)}}};
  Scene scene = lit(joined(scene_of({{0, 0, -3, 1}}), glyph_scene("cylinder", rods)), sun({1, -1, -1}));
  scene.batches[1].name = "rods";
  scene.batches[0].instances[0].world_from_data = general(); // spheres are welcome
  EXPECT_EQ(message(scene, {}), "it was drawn");
  scene.batches[1].instances[0].world_from_data[1][0] = 0.5; // sheared
  EXPECT_EQ(message(scene, {"shadow.method=\"depth\""}), "it was drawn");
  EXPECT_THAT(message(scene, {}), testing::AllOf(HasSubstr("error P018: 'rods' is scaled unevenly; a map of casters holds spheres and ellipsoids that are, but no particles of type 'cylinder'"),
                                                 HasSubstr("method = \"depth\" holds every shape")));
}

} // namespace
} // namespace mote::test
