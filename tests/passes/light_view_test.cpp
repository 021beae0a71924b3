// SPDX-License-Identifier: MIT
// The fit of shadow maps to what is seen, without a device.
#include "passes/shadows/light_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace mote;
using namespace mote::passes;

namespace {

const Bounds cube{glm::dvec3(-50), glm::dvec3(50)};

View look(glm::dvec3 eye, glm::dvec3 target, Size2d size, double fov_y = 30.0) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.up = {0, 1, 0};
  camera.fov_y = fov_y;
  return make_view(camera, size, 170.0);
}
Light sun(glm::dvec3 direction) { return {.kind = LightKind::Directional, .direction = glm::normalize(direction), .shadows = true}; }

// Texel of a world point, and its depth.
glm::dvec3 on_map(const View& map, const glm::dvec3& world) {
  const glm::dvec3 p = map.to_view(world);
  const glm::dvec2 t = map.projection == Projection::Orthographic ? glm::dvec2(p) : glm::dvec2(p) / p.z;
  return {t * map.focal + 0.5 * glm::dvec2(map.size.width, map.size.height), p.z};
}

// Everything seen lies on the map with the border free, and everything between it and the light before far_cut.
void expect_holds(const View& map, const View& camera, const Light& light) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(-50, 50);
  int seen = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 world(u(random), u(random), u(random)), p = camera.to_view(world);
    if (p.z <= 0 || std::abs(p.x / p.z) > 0.5 * camera.size.width / camera.focal || std::abs(p.y / p.z) > 0.5 * camera.size.height / camera.focal) continue;
    if (light.kind == LightKind::Spot && std::acos(glm::dot(glm::normalize(world - light.position), light.direction)) > light.outer_angle) continue;
    ++seen;
    const glm::dvec3 at = on_map(map, world);
    ASSERT_GT(std::min(at.x, at.y), 3.9);
    ASSERT_LT(at.x, map.size.width - 3.9);
    ASSERT_LT(at.y, map.size.height - 3.9);
    ASSERT_GT(at.z, map.depth_near);
    ASSERT_LT(at.z, map.far_cut);
  }
  EXPECT_GT(seen, 10);
}

TEST(LightView, HoldsWhatIsSeenInAWindowOfAnyShape) {
  for (const Size2d window : {Size2d{1920, 1080}, Size2d{1080, 1920}, Size2d{500, 500}, Size2d{2000, 100}})
    for (const glm::dvec3 direction : {glm::dvec3(1, -0.2, 0.1), glm::dvec3(0, 0, 1), glm::dvec3(0.3, -1, -0.5)}) {
      const View camera = look({200, 60, 120}, {0, 0, 0}, window);
      const auto map = light_view(cube, camera, sun(direction), {1024, 1024});
      ASSERT_TRUE(map);
      expect_holds(*map, camera, sun(direction));
    }
}

TEST(LightView, FollowsTheCameraIntoTheScene) {
  const Light light = sun({1, -0.3, 0.2});
  const auto far = light_view(cube, look({0, 0, 300}, {0, 0, 0}, {640, 360}), light, {1024, 1024});
  const View near_camera = look({0, 0, 60}, {0, 0, 0}, {640, 360}, 2.0);
  const auto near = light_view(cube, near_camera, light, {1024, 1024});
  ASSERT_TRUE(far && near);
  EXPECT_GT(near->focal, 1.3 * far->focal) << "a narrow view needs less of the scene";
  expect_holds(*near, near_camera, light);
}

// The map of a square face on: known texel size. Its border of four texels stays free.
TEST(LightView, TexelOfAKnownFit) {
  const auto map = light_view(cube, look({0, 0, 500}, {0, 0, 0}, {900, 900}), sun({0, 0, -1}), {1008, 1008});
  ASSERT_TRUE(map);
  EXPECT_NEAR(1.0 / map->focal, 100.0 / 1000.0, 1e-9);
}

// What stands between the light and the seen region stays in front of the map's eye plane, wherever the camera looks.
TEST(LightView, KeepsCasters) {
  const auto map = light_view(cube, look({0, 0, 60}, {40, 40, 40}, {640, 360}, 5.0), sun({0, -1, 0}), {512, 512});
  ASSERT_TRUE(map);
  for (const double x : {-50.0, 50.0})
    for (const double z : {-50.0, 50.0}) EXPECT_GT(map->to_view({x, 50, z}).z, map->depth_near);
}

TEST(LightView, SpotLights) {
  const View camera = look({200, 60, 120}, {0, 0, 0}, {1280, 720});
  Light light{.kind = LightKind::Spot, .direction = glm::normalize(glm::dvec3(-1, -1, 0)), .position = {120, 120, 0}, .outer_angle = 0.3, .shadows = true};
  const auto narrow = light_view(cube, camera, light, {1024, 1024});
  ASSERT_TRUE(narrow);
  EXPECT_EQ(narrow->projection, Projection::Perspective);
  expect_holds(*narrow, camera, light);
  light.outer_angle = 1.2; // wider than the scene: fitted to it
  const auto wide = light_view(cube, camera, light, {1024, 1024});
  ASSERT_TRUE(wide);
  expect_holds(*wide, camera, light);
  EXPECT_GT(wide->focal, 504.0 / std::tan(1.2));
  light.position = {0, 0, 0}; // among what is seen
  const auto inside = light_view(cube, camera, light, {1024, 1024});
  ASSERT_TRUE(inside);
  EXPECT_NEAR(inside->focal, 508.0 / std::tan(1.2), 1.0 + 4.0 / std::tan(1.2));
}

TEST(LightView, NothingToSee) {
  const View away = look({0, 0, 300}, {0, 0, 600}, {640, 360});
  EXPECT_FALSE(light_view(cube, away, sun({1, 0, 0}), {64, 64}));
  EXPECT_FALSE(light_view(Bounds{}, look({0, 0, 300}, {0, 0, 0}, {640, 360}), sun({1, 0, 0}), {64, 64}));
  Light spot{.kind = LightKind::Spot, .direction = {0, 1, 0}, .position = {0, 200, 0}, .outer_angle = 0.3, .shadows = true};
  EXPECT_FALSE(light_view(cube, look({0, 0, 300}, {0, 0, 0}, {640, 360}), spot, {64, 64})) << "the light shines away";
}

} // namespace
