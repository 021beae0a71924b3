// SPDX-License-Identifier: MIT
// Spheres under transforms that are no similarities: exact ellipsoids, against closed forms and the
// double-precision reference, by every expansion.
#include "harness.hpp"
#include "transforms.hpp"

#include <cmath>

namespace mote::test {
namespace {

class Ellipsoid : public GpuTest {};

// Half axes 3, 2, 1 with the eye on the third one at distance 10: the silhouette cone is
// (x/z)^2 / 3^2 + (y/z)^2 / 2^2 = 1 / (10^2 - 1^2), the nearest point lies 9 in front.
TEST_F(Ellipsoid, OneHasItsExactOutlineAndDepth) {
  const Scene scene = placed(scene_of({{0, 0, 0, 1}}), {scaled(3, 2, 1)});
  const Size2d size{161, 161};
  const View view = look(scene, {0, 0, 10}, {0, 0, 0}, size, 2.0 * glm::degrees(std::atan(80.5 / 200.0)));
  const Picture p = check(scene, view);
  EXPECT_FLOAT_EQ(p.depth[p.at(80, 80)], 9.0f);
  EXPECT_NEAR(p.normal[p.at(80, 80)].z, 1.0f, 1e-6f);
  for (std::uint32_t y = 0; y < size.height; ++y)
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const double u = (x - 80.0) / 200.0 / 3.0, v = (y - 80.0) / 200.0 / 2.0;
      const double excess = (u * u + v * v) * 99.0 - 1.0;
      if (std::abs(excess) > 1e-4) {
        ASSERT_EQ(p.id[p.at(x, y)], excess < 0.0 ? 0u : 0xFFFFFFFFu) << x << "," << y;
      }
    }
}

// Normals go by the inverse transpose: at a point of the ellipsoid (x/3)^2 + (y/2)^2 + z^2 = 1 along (x/9, y/4, z).
TEST_F(Ellipsoid, OrthographicOutlineAndNormals) {
  const Scene scene = placed(scene_of({{0, 0, 0, 1}}), {scaled(3, 2, 1)});
  const View view = look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {161, 161}, 8.05); // 20 pixels a unit
  const Picture p = check(scene, view);
  for (const auto& [px, py] : {std::pair(80u, 80u), std::pair(120u, 80u), std::pair(80u, 50u), std::pair(110u, 100u)}) {
    const double x = (px - 80.0) / 20.0, y = (80.0 - py) / 20.0, z = std::sqrt(1.0 - x * x / 9.0 - y * y / 4.0);
    EXPECT_NEAR(p.depth[p.at(px, py)], 10.0 - z, 2e-6);
    const glm::dvec3 n = glm::normalize(glm::dvec3(x / 9.0, y / 4.0, z));
    EXPECT_LT(glm::length(glm::dvec3(p.normal[p.at(px, py)]) - n), 1e-6) << px << "," << py;
  }
  EXPECT_EQ(p.id[p.at(80 + 59, 80)], 0u);
  EXPECT_EQ(p.id[p.at(80 + 61, 80)], 0xFFFFFFFFu);
  EXPECT_EQ(p.id[p.at(80, 80 + 39)], 0u);
  EXPECT_EQ(p.id[p.at(80, 80 + 41)], 0xFFFFFFFFu);
}

TEST_F(Ellipsoid, CloudPerspective) {
  const Scene scene = placed(scene_of(cloud(3000, 8, 0.05, 1.0)), {general()});
  check(scene, look(scene, {9, 12, 30}, {0, 0, 0}, {320, 200}), {.least_hits = 0.2});
  check(scene, look(scene, {0, 0, 8}, {0, 0, 0}, {320, 200}, 100), {.least_hits = 0.2});
}

TEST_F(Ellipsoid, CloudOrthographic) {
  const Scene scene = placed(scene_of(cloud(3000, 8, 0.05, 1.0)), {general()});
  check(scene, look_orthographic(scene, {9, 12, 30}, {0, 0, 0}, {320, 200}, 24), {.least_hits = 0.2});
}

// The half axes travel as floats: their rounding shows in the depth of a surface around the eye, so the factor.
TEST_F(Ellipsoid, EyeInside) {
  std::vector<glm::dvec4> spheres = cloud(2000, 10, 0.05, 1.0);
  spheres.emplace_back(0.1, 0.2, 0.3, 2.0); // holds the eye
  const Scene scene = placed(scene_of(spheres), {general()});
  check(scene, look(scene, {0, 0, 0}, {1, 0.2, 0.1}, {320, 200}, 60), {.least_hits = 1.0, .depth_factor = 3});
}

TEST_F(Ellipsoid, NearAndFarCut) {
  const Scene scene = placed(scene_of(cloud(2000, 10, 0.05, 1.5)), {general()});
  View view = look(scene, {9, 12, 30}, {0, 0, 0}, {320, 200});
  view.near_cut = 30.0;
  check(scene, view, {.least_hits = 0.1});
  view.far_cut = 34.0;
  check(scene, view, {.least_hits = 0.05});
  View orthographic = look_orthographic(scene, {0, 0, 30}, {0, 0, 0}, {320, 200}, 24);
  orthographic.near_cut = 31.0;
  check(scene, orthographic, {.least_hits = 0.1});
}

TEST_F(Ellipsoid, FarFromTheOrigin) {
  const glm::dvec3 o(1e6, -1e6, 1e6);
  const Scene scene = placed(scene_of(cloud(2000, 8, 0.05, 1.0)), {moved(o.x, o.y, o.z) * general()});
  check(scene, look(scene, o + glm::dvec3(9, 12, 30), o, {320, 200}), {.least_hits = 0.2});
}

// A needle and a pancake, a hundred and a thousand times as long as thick.
TEST_F(Ellipsoid, NeedlesAndPancakes) {
  const Scene needles = placed(scene_of({{0, 0, 0, 4}, {0.5, 20, 30, 3}}), {turned(0.5, {1, 1, 0}) * scaled(1, 0.01, 0.01)});
  check(needles, look(needles, {2, 3, 12}, {0, 0, 0}, {320, 200}), {.least_hits = 0.001});
  const Scene pancakes = placed(scene_of({{0, 0, 0, 4}, {0.5, 1, 1000, 3}}), {turned(0.5, {1, 1, 0}) * scaled(1, 1, 0.001)});
  check(pancakes, look(pancakes, {2, 3, 12}, {0, 0, 0}, {320, 200}), {.least_hits = 0.05});
}

// Spheres and ellipsoids of one chunk set side by side, one of them mirrored; ids stay instance-major.
TEST_F(Ellipsoid, InstancesOfBothKinds) {
  Scene scene = placed(scene_of(cloud(200, 3, 0.2, 0.8), {0xFF3080F0u, 0xFF80F030u}),
                       {moved(-7, 0, 0), moved(0, 0, 0) * scaled(1, -0.5, 1), moved(7, 0, 0) * turned(0.3, {1, 0, 1}) * scaled(-1, 1, 1), moved(0, 5, 0) * general()});
  scene.batches[0].id_base = 1000;
  scene.batches[0].material = {ShadingModel::BlinnPhong, 1, 0.7, 0.4, 30};
  const Picture p = check(scene, look(scene, {2, 6, 30}, {0, 0, 0}, {320, 200}), {.least_hits = 0.1});
  std::array<bool, 4> seen{};
  for (const std::uint32_t id : p.id)
    if (id != 0xFFFFFFFFu) seen.at((id - 1000) / 200) = true;
  EXPECT_EQ(seen, (std::array<bool, 4>{true, true, true, true}));
}

} // namespace
} // namespace mote::test
