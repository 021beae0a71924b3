// SPDX-License-Identifier: MIT
// Types with an axis (capsule, ...) by every expansion, perspective and orthographic: against closed forms, and against the
// double-precision reference in clouds, from inside, cut, mirrored, unevenly scaled, far from the origin, and where they degenerate.
#include "harness.hpp"
#include "transforms.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace mote::test {
namespace {

glm::dmat4 mirrored() { return scaled(-1, 1, 1) * stretched(); }

constexpr double pad = 1.0 + 1e-6;

// A particle of a type from its axis h (half of it) and a radius; the other measures follow from the radius.
Glyph axial(const std::string& type, const glm::dvec3& center, const glm::dvec3& h, double radius) {
  const glm::vec3 hf(h);
  const auto r = static_cast<float>(radius);
  const double length = glm::length(glm::dvec3(hf));
  if (type == "capsule") return {center, (length + double{r}) * pad, double{r}, {glm::vec4(hf, r)}};
  const double bound = std::hypot(length, double{r}) * pad;
  if (type == "cylinder") return {center, bound, double{r}, {glm::vec4(hf, r), glm::vec4(r, 0, 0, 0)}};
  if (type == "open_cylinder") return {center, bound, 0.5 * double{r}, {glm::vec4(hf, r), glm::vec4(0.5f * r, 1, 0, 0)}}; // and tapered
  if (type == "cone") return {center, bound, double{r}, {glm::vec4(hf, r), glm::vec4(0, 0, 0, 0)}};
  return {center, bound, 0.5 * double{r}, {glm::vec4(hf, 0.5f * r), glm::vec4(r, std::min(static_cast<float>(length), 2 * r), 0, 0)}}; // arrow
}
std::string type_of(const std::string& name) { return name == "open_cylinder" ? "cylinder" : name; }

struct Cloud {
  std::size_t count{};
  double half{}, r_min{}, r_max{}, slenderness{4}; // half length over radius, at most
};
std::vector<Glyph> cloud_of(const std::string& type, const Cloud& c, unsigned seed = 5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Glyph> out;
  for (std::size_t i = 0; i < c.count; ++i) {
    const glm::dvec3 center = c.half * glm::dvec3(u(random), u(random), u(random));
    glm::dvec3 h(u(random), u(random), u(random));
    const double r = c.r_min * std::pow(c.r_max / c.r_min, 0.5 * (u(random) + 1));
    h *= r * c.slenderness / std::sqrt(3.0);
    if (i % 7 == 0) h = glm::dvec3(0, 0, r); // along the axis of the straight views
    out.push_back(axial(type, center, h, r));
  }
  return out;
}

class Axial : public GpuTest, public ::testing::WithParamInterface<std::string> {
protected:
  [[nodiscard]] Scene cloud_scene(const Cloud& c, unsigned seed = 5) const { return glyph_scene(type_of(GetParam()), cloud_of(GetParam(), c, seed)); }
};
INSTANTIATE_TEST_SUITE_P(Types, Axial, ::testing::Values("capsule", "cylinder", "open_cylinder", "cone", "arrow"), [](const auto& type) { return type.param; });

class CapsuleTest : public GpuTest {};

// Across the view at distance 10, 4 long between the balls' centers, radius 1: the nearest point is 9 away, its normal looks back;
// on the image of the orthographic camera the outline is 2 + 1 to the sides and 1 up and down.
TEST_F(CapsuleTest, OneHasItsExactOutlineAndDepth) {
  const Scene scene = glyph_scene("capsule", {axial("capsule", {0, 0, 0}, {2, 0, 0}, 1)});
  const View view = look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {161, 161}, 8.05); // 20 pixels a unit
  const Picture p = check(scene, view);
  EXPECT_FLOAT_EQ(p.depth[p.at(80, 80)], 9.0f);
  EXPECT_FLOAT_EQ(p.depth[p.at(119, 80)], 9.0f);
  EXPECT_NEAR(p.depth[p.at(130, 80)], 10.0 - std::sqrt(1.0 - 0.25), 2e-6); // half a radius beyond the end
  EXPECT_LT(glm::length(glm::dvec3(p.normal[p.at(130, 80)]) - glm::dvec3(0.5, 0, std::sqrt(0.75))), 1e-6);
  EXPECT_NEAR(p.depth[p.at(60, 90)], 10.0 - std::sqrt(1.0 - 0.25), 2e-6);
  for (const auto& [x, y, inside] : {std::tuple(139u, 80u, true), {141u, 80u, false}, {80u, 99u, true}, {80u, 101u, false}, {139u, 90u, false}})
    EXPECT_EQ(p.id[p.at(x, y)], inside ? 0u : 0xFFFFFFFFu) << x << "," << y;
}

TEST_F(CapsuleTest, WithoutLengthIsASphere) {
  Scene capsules = glyph_scene("capsule", {axial("capsule", {0.2, 0.1, 0}, {0, 0, 0}, 1.5), axial("capsule", {-3, 1, 2}, {0, 0, 0}, 0.5)});
  const Scene spheres = scene_of({{0.2, 0.1, 0, 1.5}, {-3, 1, 2, 0.5}});
  const View view = look(spheres, {1, 2, 12}, {0, 0, 0}, {320, 200});
  const Picture a = check(capsules, view), b = draw(spheres, view);
  EXPECT_EQ(a.id, b.id);
  std::size_t other = 0;
  for (std::size_t i = 0; i < a.id.size(); ++i) other += a.id[i] == 0 && std::abs(a.depth[i] - b.depth[i]) > 2e-6f;
  EXPECT_LE(other, 8u) << "but for the limb, where the sphere errs more";
}

class FrustumTest : public GpuTest {};

// A cylinder of radius 1 seen along its axis is a disc at the depth of its near end; a cone of which the tip looks at the eye
// has its tip there; an arrow from the side has its widest place at the head's base.
TEST_F(FrustumTest, KnownDepthsAndOutlines) {
  const auto straight = [&](const Scene& scene) { return look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {161, 161}, 8.05); }; // 20 pixels a unit
  const Scene cylinder = glyph_scene("cylinder", {axial("cylinder", {0, 0, 0}, {0, 0, 2}, 1)});
  Picture p = check(cylinder, straight(cylinder));
  EXPECT_FLOAT_EQ(p.depth[p.at(80, 80)], 8.0f);
  EXPECT_FLOAT_EQ(p.depth[p.at(98, 80)], 8.0f);
  EXPECT_EQ(p.normal[p.at(80, 80)], glm::vec4(0, 0, 1, 0));
  EXPECT_EQ(p.id[p.at(101, 80)], 0xFFFFFFFFu);
  const Scene cone = glyph_scene("cone", {axial("cone", {0, 0, 0}, {0, 0, 2}, 1)});
  p = check(cone, straight(cone));
  EXPECT_FLOAT_EQ(p.depth[p.at(80, 80)], 8.0f);
  EXPECT_NEAR(p.depth[p.at(90, 80)], 8.0 + 2.0, 2e-6); // half the radius: half the height
  EXPECT_LT(glm::length(glm::dvec3(p.normal[p.at(90, 80)]) - glm::dvec3(4, 0, 1) / std::sqrt(17.0)), 1e-6);
  const Scene arrow = glyph_scene("arrow", {axial("arrow", {0, 0, 0}, {2.5, 0, 0}, 1)}); // shaft 0.5, head 1 and 2 long
  p = check(arrow, straight(arrow));
  EXPECT_FLOAT_EQ(p.depth[p.at(60, 80)], 9.5f);
  EXPECT_EQ(p.id[p.at(60, 91)], 0xFFFFFFFFu);
  EXPECT_EQ(p.id[p.at(91, 98)], 0u);
  EXPECT_EQ(p.id[p.at(111, 88)], 0u); // half way to the tip, 0.5 wide
  EXPECT_EQ(p.id[p.at(111, 92)], 0xFFFFFFFFu);
}

// What is degenerate: an axis along the view, radii equal but for the last bit, needles, head as long as the arrow, none at all.
TEST_F(FrustumTest, DegenerateShapes) {
  std::vector<Glyph> cylinders, arrows;
  const float r = 0.3f, other = std::nextafter(r, 1.0f);
  for (int i = 0; i < 16; ++i) {
    const glm::dvec3 center((i % 4 - 1.5) * 2, (i / 4 - 1.5) * 2, 0);
    const double tilt = i < 8 ? 0.0 : std::pow(10.0, -i + 7); // along the axis of the view, and nearly
    Glyph g = axial("cylinder", center, {tilt, 0, 1}, i % 3 ? 0.3 : 0.001);
    if (i % 3) g.rest = {glm::vec4(glm::vec3(g.rest[0]), i % 3 == 1 ? other : r), glm::vec4(i % 3 == 1 ? r : other, i % 2, 0, 0)};
    g.bound *= 1.001;
    cylinders.push_back(g);
    Glyph a = axial("arrow", center, {tilt, 0.02 * i, 1}, 0.4);
    a.rest[1].y = i % 2 ? 2.0f * glm::length(glm::vec3(a.rest[0])) * 0.999999f : 0.001f;
    arrows.push_back(a);
  }
  const Scene a = glyph_scene("cylinder", cylinders), b = glyph_scene("arrow", arrows);
  for (const Scene* scene : {&a, &b}) {
    check(*scene, look_orthographic(*scene, {0, 0, 30}, {0, 0, 0}, {200, 200}, 9), {.least_hits = 0.01, .most_ambiguous = 0.03, .normal_factor = 100});
    check(*scene, look(*scene, {1, 2, 12}, {0, 0, 0}, {200, 200}, 45), {.least_hits = 0.01, .most_ambiguous = 0.03, .normal_factor = 100});
  }
}

// A needle 1e5 times as long as thick; its axis is rounded to float32, which moves its far ends: see docs/accuracy.md.
TEST_F(FrustumTest, Needles) {
  for (const std::string type : {"capsule", "cylinder", "arrow"}) {
    const Scene scene = glyph_scene(type, {axial(type, {0, 0, 0}, {100, 30, 5}, 0.001), axial(type, {0, 1, 1}, {-80, 40, -6}, 0.002)});
    const View view = look(scene, {0.1, 0.2, 3}, {0, 0, 0}, {320, 200}, 3);
    const Picture p = draw(scene, view, {.expansion = passes::Expansion::Vertex});
    const std::size_t hits = static_cast<std::size_t>(std::count_if(p.id.begin(), p.id.end(), [](std::uint32_t id) { return id != 0xFFFFFFFFu; }));
    EXPECT_GT(hits, 200u) << type;
    expect_equals_reference(p, scene, view, {.least_hits = 0.001, .most_ambiguous = 0.05, .depth_factor = 1000, .normal_factor = 3e5});
  }
}

TEST_P(Axial, CloudPerspective) {
  const Scene scene = cloud_scene({2500, 8, 0.05, 0.6});
  check(scene, look(scene, {9, 12, 30}, {0, 0, 0}, {320, 200}), {.least_hits = 0.2});
  check(scene, look(scene, {0, 0, 14}, {0, 0, 0}, {320, 200}, 100), {.least_hits = 0.2});
}

TEST_P(Axial, CloudOrthographic) {
  const Scene scene = cloud_scene({2500, 8, 0.05, 0.6});
  // Rays run exactly along generators of the cones that stand upright, and then along the axes of some.
  check(scene, look_orthographic(scene, {9, 12, 30}, {0, 0, 0}, {320, 200}, 24), {.least_hits = 0.2});
  check(scene, look_orthographic(scene, {0, 0, 30}, {0, 0, 0}, {320, 200}, 24), {.least_hits = 0.2});
}

TEST_P(Axial, EyeInside) {
  std::vector<Glyph> glyphs = cloud_of(GetParam(), {1500, 10, 0.05, 0.6});
  glyphs.push_back(axial(GetParam(), {0.1, 0.2, 0.3}, {2, 1, 0.5}, 1.5)); // holds the eye
  const Scene scene = glyph_scene(type_of(GetParam()), glyphs);
  check(scene, look(scene, {0, 0, 0}, {1, 0.2, 0.1}, {320, 200}, 60), {.least_hits = 0.9});
}

// Long, thin and slanting: of the tiles of their rectangles they touch few, and all that they touch show them.
TEST_P(Axial, LongOnesAcrossThePicture) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Glyph> glyphs;
  for (int i = 0; i < 150; ++i) glyphs.push_back(axial(GetParam(), {4 * u(random), 4 * u(random), 10 * u(random)}, {12 * u(random), 12 * u(random), 9 * u(random)}, 0.02 + 0.02 * u(random)));
  glyphs.push_back(axial(GetParam(), {-8, 0.1, 11}, {8, 0.1, 11}, 0.05)); // from beside the eye to far behind
  const Scene scene = glyph_scene(type_of(GetParam()), glyphs);
  for (const View& view : {look(scene, {0, 0.3, 24}, {0, 0, 0}, {200, 120}, 60), look_orthographic(scene, {3, 2, 30}, {0, 0, 0}, {200, 120}, 16)}) {
    const Picture quads = draw(scene, view, {.expansion = passes::Expansion::Vertex}), tiles = draw(scene, view, {.expansion = passes::Expansion::Compute});
    expect_equals_reference(tiles, scene, view, {.least_hits = 0.04, .most_ambiguous = 0.1, .depth_factor = 1000, .normal_factor = 3e5, .colors_off = 0.02});
    std::size_t missing = 0;
    for (std::size_t i = 0; i < quads.id.size(); ++i) missing += (quads.id[i] == 0xFFFFFFFFu) != (tiles.id[i] == 0xFFFFFFFFu);
    EXPECT_LE(missing, 5u);
  }
}

TEST_P(Axial, NearAndFarCut) {
  const Scene scene = cloud_scene({1500, 10, 0.05, 1.0});
  View view = look(scene, {9, 12, 30}, {0, 0, 0}, {320, 200});
  view.near_cut = 30.0;
  check(scene, view, {.least_hits = 0.1});
  view.far_cut = 34.0;
  check(scene, view, {.least_hits = 0.05});
}

TEST_P(Axial, FarFromTheOrigin) {
  const glm::dvec3 o(1e6, -1e6, 1e6);
  std::vector<Glyph> glyphs = cloud_of(GetParam(), {1500, 8, 0.05, 0.6});
  for (Glyph& g : glyphs) g.center += o;
  const Scene scene = glyph_scene(type_of(GetParam()), glyphs);
  check(scene, look(scene, o + glm::dvec3(9, 12, 30), o, {320, 200}), {.least_hits = 0.1});
}

// The eye at a thousand and a hundred thousand times the size.
TEST_P(Axial, FarAway) {
  for (const double far : {1e3, 1e5}) {
    std::vector<Glyph> glyphs;
    for (int i = 0; i < 9; ++i) glyphs.push_back(axial(GetParam(), {(i % 3 - 1) * 5.0, (i / 3 - 1) * 5.0, 0.0}, {0.9 * std::cos(i), 0.9 * std::sin(i), 0.3 * i - 1}, 0.7));
    const Scene scene = glyph_scene(type_of(GetParam()), glyphs);
    check(scene, look(scene, {0.3 * far, 0.2 * far, far}, {0, 0, 0}, {200, 200}, glm::degrees(20.0 / far)), {.least_hits = 0.02});
  }
}

TEST_P(Axial, InstancesOfEveryKind) {
  Scene scene = placed(glyph_scene(type_of(GetParam()), cloud_of(GetParam(), {150, 3, 0.1, 0.5}), {0xFF3080F0u, 0xFF80F030u}),
                       {moved(-7, 0, 0), moved(0, 0, 0) * scaled(1, -0.5, 1), moved(7, 0, 0) * turned(0.3, {1, 0, 1}) * scaled(-1, 1, 1), moved(0, 5, 0) * mirrored()});
  scene.batches[0].id_base = 1000;
  check(scene, look(scene, {2, 6, 30}, {0, 0, 0}, {320, 200}), {.least_hits = 0.1, .normal_factor = 2});
  check(scene, look_orthographic(scene, {2, 6, 30}, {0, 0, 0}, {320, 200}, 20), {.least_hits = 0.1, .normal_factor = 2});
}

TEST_P(Axial, UnevenlyScaledFromInside) {
  std::vector<Glyph> glyphs = cloud_of(GetParam(), {600, 6, 0.05, 0.6});
  glyphs.push_back(axial(GetParam(), {0.1, 0.2, 0.3}, {2, 1, 0.5}, 1.5));
  const Scene scene = placed(glyph_scene(type_of(GetParam()), glyphs), {mirrored()});
  check(scene, look(scene, {0, 0, 0}, {1, 0.2, 0.1}, {320, 200}, 60), {.least_hits = 0.8, .depth_factor = 3, .normal_factor = 2});
  View cut = look(scene, {9, 12, 30}, {0, 0, 0}, {320, 200});
  cut.near_cut = 31.0;
  check(scene, cut, {.least_hits = 0.05, .normal_factor = 2});
}

// Spheres and these in one picture: tiles draw the more frequent ones.
TEST_P(Axial, BesideSpheres) {
  const Scene scene = joined(scene_of(cloud(300, 6, 0.05, 0.6)), cloud_scene({300, 6, 0.05, 0.6}, 8));
  check(scene, look(scene, {9, 12, 30}, {0, 0, 0}, {320, 200}), {.least_hits = 0.1});
}

} // namespace
} // namespace mote::test
