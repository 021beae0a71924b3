// SPDX-License-Identifier: MIT
// Types with three axes of their own (ellipsoid, box, superquadric) by every expansion, perspective and orthographic: against closed
// forms, and against the double-precision reference in clouds, from inside, cut, mirrored, unevenly scaled, far from the
// origin, transparent and in shadow.
#include "harness.hpp"
#include "transforms.hpp"

#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <random>

namespace mote::test {
namespace {

glm::dmat4 mirrored() { return scaled(-1, 1, 1) * stretched(); }

Glyph oriented(const std::string& type, const glm::dvec3& center, const glm::dquat& turn, const glm::dvec3& axes, const glm::dvec2& exponents = {1, 1}) {
  const glm::vec3 a(axes);
  Glyph g{center, glm::length(glm::dvec3(a)) * (1.0 + 1e-6), double{std::min({a.x, a.y, a.z})},
          {glm::vec4(glm::dvec4(turn.x, turn.y, turn.z, turn.w)), glm::vec4(a, 0)}};
  if (type == "superquadric") g.rest.push_back(glm::vec4(glm::vec2(exponents), 0, 0));
  return g;
}

struct Cloud {
  std::size_t count{};
  double half{}, a_min{}, a_max{};
};
std::vector<Glyph> cloud_of(const std::string& type, const Cloud& c, unsigned seed = 5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Glyph> out;
  for (std::size_t i = 0; i < c.count; ++i) {
    const glm::dvec3 center = c.half * glm::dvec3(u(random), u(random), u(random));
    glm::dquat turn = glm::normalize(glm::dquat(u(random), u(random), u(random), u(random)));
    if (i % 7 == 0) turn = glm::dquat(1, 0, 0, 0); // along the axes of the straight views
    const double a = c.a_min * std::pow(c.a_max / c.a_min, 0.5 * (u(random) + 1));
    const auto axis = [&] { return a * std::pow(4.0, 0.5 * (u(random) - 1)); };
    const glm::dvec3 axes(axis(), axis(), axis());
    out.push_back(oriented(type, center, turn, axes, {1.1 + 0.9 * u(random), 1.1 + 0.9 * u(random)}));
  }
  return out;
}

class Oriented : public GpuTest, public ::testing::WithParamInterface<std::string> {
protected:
  [[nodiscard]] Scene cloud_scene(const Cloud& c, unsigned seed = 5) const { return glyph_scene(GetParam(), cloud_of(GetParam(), c, seed)); }
  // Superquadrics cost ten times as much.
  [[nodiscard]] static std::size_t many() { return GetParam() == "superquadric" ? 600 : 2000; }
  [[nodiscard]] static Size2d size() { return GetParam() == "superquadric" ? Size2d{128, 80} : Size2d{320, 200}; }
  // Edges between faces of one particle make no pixel ambiguous, but its normal and color.
  [[nodiscard]] Bars bars(double hits, double depth = 1.0, double normal = 1.0) const {
    const bool rounded = GetParam() == "superquadric";
    return {.least_hits = hits * (rounded ? 0.4 : 1.0), .depth_factor = depth * (rounded ? 3.0 : 1.0), .normal_factor = normal * (rounded ? 100.0 : 1.0),
            .colors_off = GetParam() == "ellipsoid" ? 0.0 : 2e-4};
  }
};
INSTANTIATE_TEST_SUITE_P(Types, Oriented, ::testing::Values("ellipsoid", "box", "superquadric"), [](const auto& type) { return type.param; });

class OrientedOne : public GpuTest {};

TEST_F(OrientedOne, EllipsoidEqualsAScaledSphere) {
  const glm::dquat turn = glm::normalize(glm::dquat(0.9, 0.1, -0.3, 0.2));
  const Scene own = glyph_scene("ellipsoid", {oriented("ellipsoid", {0, 0, 0}, turn, {3, 2, 1})});
  const View view = look(own, {1, 2, 12}, {0, 0, 0}, {200, 160});
  const Picture a = check(own, view, {.least_hits = 0.1});
  const Picture b = draw(placed(scene_of({{0, 0, 0, 1}}), {glm::mat4_cast(turn) * scaled(3, 2, 1)}), view);
  std::size_t other = 0;
  for (std::size_t i = 0; i < a.id.size(); ++i)
    other += a.id[i] != b.id[i] || (a.id[i] == 0 && (std::abs(a.depth[i] - b.depth[i]) > 4e-6f || glm::length(a.normal[i] - b.normal[i]) > 3e-5f));
  EXPECT_LE(other, 20u) << "but for the limb";
}

// Half extents 2, 1, 0.5 on a view along z at distance 10: the front face is 9.5 away, the outline that of the front face's corners.
TEST_F(OrientedOne, BoxHasItsExactOutlineAndDepth) {
  const Scene scene = glyph_scene("box", {oriented("box", {0, 0, 0}, glm::dquat(1, 0, 0, 0), {2, 1, 0.5})});
  const View view = look(scene, {0, 0, 10}, {0, 0, 0}, {161, 161}, 2.0 * glm::degrees(std::atan(80.5 / 200.0)));
  const Picture p = check(scene, view, {.least_hits = 0.05});
  EXPECT_FLOAT_EQ(p.depth[p.at(80, 80)], 9.5f);
  EXPECT_LT(glm::length(glm::dvec3(p.normal[p.at(80, 80)]) - glm::dvec3(0, 0, 1)), 1e-7);
  const double reach_x = 200.0 * 2.0 / 9.5, reach_y = 200.0 / 9.5; // 42.1 and 21.05 pixels
  for (int d = -60; d <= 60; ++d) {
    EXPECT_EQ(p.id[p.at(static_cast<std::uint32_t>(80 + d), 80)], std::abs(d) < reach_x ? 0u : 0xFFFFFFFFu) << d;
    EXPECT_EQ(p.id[p.at(80, static_cast<std::uint32_t>(80 + d))], std::abs(d) < reach_y ? 0u : 0xFFFFFFFFu) << d;
  }
}

TEST_F(OrientedOne, PlateOfNoThickness) {
  const Scene scene = glyph_scene("box", {oriented("box", {0, 0, 0}, glm::dquat(0.9, 0.2, 0.1, 0), {2, 1, 0})});
  check(scene, look(scene, {1, 2, 10}, {0, 0, 0}, {160, 120}), {.least_hits = 0.05, .colors_off = 1e-3});
}

// Exponents (1, 1) are the ellipsoid, (2, 2) the octahedron |x| + |y| + |z| = 1, small ones nearly the box.
TEST_F(OrientedOne, SuperquadricBetweenItsLimits) {
  const glm::dquat turn = glm::normalize(glm::dquat(0.9, 0.1, -0.3, 0.2));
  const auto of = [&](const std::string& type, glm::dvec2 e) { return glyph_scene(type, {oriented(type, {0, 0, 0}, turn, {3, 2, 1}, e)}); };
  const Scene round = of("superquadric", {1, 1});
  const View view = look(round, {1, 2, 12}, {0, 0, 0}, {200, 160});
  const Picture a = check(round, view, {.least_hits = 0.1, .depth_factor = 2, .normal_factor = 20}), b = draw(of("ellipsoid", {}), view);
  std::size_t other = 0;
  for (std::size_t i = 0; i < a.id.size(); ++i) other += a.id[i] != b.id[i] || (a.id[i] == 0 && std::abs(a.depth[i] - b.depth[i]) > 2e-5f);
  EXPECT_LE(other, 8u);
  const Scene octahedron = glyph_scene("superquadric", {oriented("superquadric", {0, 0, 0}, glm::dquat(1, 0, 0, 0), {2, 2, 2}, {2, 2})});
  const View along = look_orthographic(octahedron, {0, 0, 10}, {0, 0, 0}, {161, 161}, 8.05); // 20 pixels a unit
  const Picture p = check(octahedron, along, {.least_hits = 0.1, .depth_factor = 2, .normal_factor = 20, .colors_off = 0.02});
  EXPECT_NEAR(p.depth[p.at(90, 85)], 10.0 - (2.0 - 0.5 - 0.25), 1e-5);
  EXPECT_EQ(p.id[p.at(80 + 25, 80 + 14)], 0u);
  EXPECT_EQ(p.id[p.at(80 + 25, 80 + 16)], 0xFFFFFFFFu);
  const Scene sharp = of("superquadric", {0.05, 0.05});
  check(sharp, view, {.least_hits = 0.1, .depth_factor = 4, .normal_factor = 400, .colors_off = 0.01});
}

TEST_P(Oriented, CloudPerspective) {
  const Scene scene = cloud_scene({many(), 8, 0.1, 1.0});
  check(scene, look(scene, {9, 12, 30}, {0, 0, 0}, size()), bars(0.2));
  check(scene, look(scene, {0, 0, 14}, {0, 0, 0}, size(), 100), bars(0.2));
}

TEST_P(Oriented, CloudOrthographic) {
  const Scene scene = cloud_scene({many(), 8, 0.1, 1.0});
  check(scene, look_orthographic(scene, {9, 12, 30}, {0, 0, 0}, size(), 24), bars(0.2));
  check(scene, look_orthographic(scene, {0, 0, 30}, {0, 0, 0}, size(), 24), bars(0.2)); // along the axes of some
}

TEST_P(Oriented, EyeInside) {
  std::vector<Glyph> glyphs = cloud_of(GetParam(), {1200, 10, 0.1, 1.0});
  glyphs.push_back(oriented(GetParam(), {0.1, 0.2, 0.3}, glm::normalize(glm::dquat(0.9, 0.1, -0.3, 0.2)), {3, 2, 2}, {0.8, 1.2})); // holds the eye
  const Scene scene = glyph_scene(GetParam(), glyphs);
  check(scene, look(scene, {0, 0, 0}, {1, 0.2, 0.1}, size(), 60), bars(0.9, 6));
}

TEST_P(Oriented, NearAndFarCut) {
  const Scene scene = cloud_scene({1200, 10, 0.1, 1.5});
  View view = look(scene, {9, 12, 30}, {0, 0, 0}, size());
  view.near_cut = 30.0;
  check(scene, view, bars(0.1));
  view.far_cut = 34.0;
  check(scene, view, bars(0.05));
}

TEST_P(Oriented, FarFromTheOrigin) {
  const glm::dvec3 o(1e6, -1e6, 1e6);
  std::vector<Glyph> glyphs = cloud_of(GetParam(), {1200, 8, 0.1, 1.0});
  for (Glyph& g : glyphs) g.center += o;
  const Scene scene = glyph_scene(GetParam(), glyphs);
  check(scene, look(scene, o + glm::dvec3(9, 12, 30), o, size()), bars(0.1));
}

TEST_P(Oriented, InstancesOfEveryKind) {
  Scene scene = placed(glyph_scene(GetParam(), cloud_of(GetParam(), {150, 3, 0.2, 0.8}), {0xFF3080F0u, 0xFF80F030u}),
                       {moved(-7, 0, 0), scaled(1, -0.5, 1), moved(7, 0, 0) * turned(0.3, {1, 0, 1}) * scaled(-1, 1, 1), moved(0, 5, 0) * mirrored()});
  scene.batches[0].id_base = 1000;
  check(scene, look(scene, {2, 6, 30}, {0, 0, 0}, size()), bars(0.1, 1.5, 2));
  check(scene, look_orthographic(scene, {2, 6, 30}, {0, 0, 0}, size(), 20), bars(0.1, 1.5, 2));
}

TEST_P(Oriented, BesideSpheres) {
  const Scene scene = joined(scene_of(cloud(300, 6, 0.05, 0.6)), cloud_scene({300, 6, 0.1, 0.8}, 8));
  check(scene, look(scene, {9, 12, 30}, {0, 0, 0}, size()), bars(0.1));
}

} // namespace
} // namespace mote::test
