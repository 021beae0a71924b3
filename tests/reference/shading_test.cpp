// SPDX-License-Identifier: MIT
// The shading equation of scene.hpp, term by term, at the middle of one sphere.
#include "core/reference/shade.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace mote {
namespace {

using namespace mote::test;

constexpr Size2d odd{33, 33};
constexpr std::size_t middle = 16 * 33 + 16;

// A unit sphere seen from (0, -5, 0): the middle pixel's point is (0, -1, 0), n = v = (0, -1, 0).
struct Stage {
  Scene scene{scene_of({{{0, 0, 0}, 1.0}})};
  View view{look({0, -5, 0}, {0, 0, 0}, odd)};
  Stage() {
    scene.lights.clear();
    scene.ambient = glm::dvec3(0);
    scene.batches[0].color = {0.5, 0.25, 1.0};
  }
  [[nodiscard]] glm::dvec3 color(const ReferenceOptions& options = {}) const {
    return glm::dvec3(render_reference(scene, view, options).color[middle]);
  }
};

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  EXPECT_NEAR(glm::distance(a, b), 0.0, 1e-12)
      << a.x << " " << a.y << " " << a.z << ", expected " << b.x << " " << b.y << " " << b.z;
}

Light sun(const glm::dvec3& to_light) {
  Light light;
  light.kind = LightKind::Directional;
  light.direction = -glm::normalize(to_light);
  return light;
}

TEST(ReferenceShading, AmbientAndHeadlight) {
  Stage s;
  s.scene.ambient = {0.2, 0.1, 0.0};
  s.scene.batches[0].material.ambient = 0.5;
  expect_near(s.color(), glm::dvec3(0.5, 0.25, 1.0) * 0.5 * s.scene.ambient);
  Light head;
  head.intensity = 0.8;
  head.color = {1, 0.5, 0.25};
  s.scene.lights.push_back(head);
  expect_near(s.color(), glm::dvec3(0.5, 0.25, 1.0) * (0.5 * s.scene.ambient + 0.8 * head.color));
}

TEST(ReferenceShading, DirectionalObliqueAndFromBehind) {
  Stage s;
  s.scene.lights.push_back(sun({0, -1, 1}));
  expect_near(s.color(), glm::dvec3(0.5, 0.25, 1.0) * std::sqrt(0.5));
  s.scene.lights[0] = sun({0, 1, 0});
  s.scene.batches[0].material.specular = 1.0;
  s.scene.batches[0].material.exponent = 0.0;
  expect_near(s.color(), glm::dvec3(0)); // S = 0 where n.l <= 0, whatever the exponent
}

TEST(ReferenceShading, SpecularModels) {
  Stage s;
  s.scene.lights.push_back(sun({0, -1, std::tan(0.6)})); // 0.6 rad off the normal, which points to the eye
  Material& m = s.scene.batches[0].material;
  m = {ShadingModel::Phong, 0, 0, 0.7, 5.0};
  expect_near(s.color(), glm::dvec3(0.7 * std::pow(std::cos(0.6), 5.0)));
  m.model = ShadingModel::BlinnPhong;
  expect_near(s.color(), glm::dvec3(0.7 * std::pow(std::cos(0.3), 5.0)));
  m.exponent = 0.0;
  expect_near(s.color(), glm::dvec3(0.7));
  m.model = ShadingModel::Lambert;
  expect_near(s.color(), glm::dvec3(0));
}

TEST(ReferenceShading, PointLightFades) {
  Stage s;
  Light light;
  light.kind = LightKind::Point;
  light.position = {0, -3, 0}; // 2 from the point
  light.attenuation = {1, 0.5, 0.25};
  s.scene.lights.push_back(light);
  expect_near(s.color(), glm::dvec3(0.5, 0.25, 1.0) / 3.0);
}

TEST(ReferenceShading, SpotFadesFromInnerToOuter) {
  Stage s;
  Light light;
  light.kind = LightKind::Spot;
  light.position = {0, -3, 0};
  light.inner_angle = 0.2;
  light.outer_angle = 0.4;
  s.scene.lights.push_back(light);
  const auto at = [&](double angle) {
    s.scene.lights[0].direction = {std::sin(angle), std::cos(angle), 0};
    return s.color().z;
  };
  EXPECT_NEAR(at(0.1), 1.0, 1e-12);
  EXPECT_NEAR(at(0.5), 0.0, 1e-12);
  const double x = (std::cos(0.3) - std::cos(0.4)) / (std::cos(0.2) - std::cos(0.4));
  EXPECT_NEAR(at(0.3), x * x * (3 - 2 * x), 1e-12);
  s.scene.lights[0].inner_angle = 0.4; // a hard edge divides by nothing
  EXPECT_NEAR(at(0.39), 1.0, 1e-12);
  EXPECT_NEAR(at(0.41), 0.0, 1e-12);
}

TEST(ReferenceShading, ParticleColorsAreDecodedExactly) {
  EXPECT_DOUBLE_EQ(reference::srgb_to_linear(0.0), 0.0);
  EXPECT_DOUBLE_EQ(reference::srgb_to_linear(1.0), 1.0);
  EXPECT_NEAR(reference::srgb_to_linear(0.5), 0.21404114048223255, 1e-15);
  EXPECT_NEAR(reference::srgb_to_linear(10.0 / 255.0), 10.0 / 255.0 / 12.92, 1e-16);
  Stage s;
  auto chunks = std::make_shared<ChunkSet>(*s.scene.batches[0].chunks);
  chunks->colors.assign(chunks->record_count(), 0xFF0A80FFu); // R lowest
  s.scene.batches[0].chunks = chunks;
  s.scene.ambient = glm::dvec3(1);
  expect_near(s.color(), {1.0, std::pow((128.0 / 255.0 + 0.055) / 1.055, 2.4), 10.0 / 255.0 / 12.92});
}

TEST(ReferenceShading, OrthographicEyeVectorIsTheAxis) {
  Stage s;
  s.view = look_parallel({0, -5, 0}, {0, 0, 0}, odd, 3.0);
  s.scene.batches[0].material = {ShadingModel::Phong, 0, 0, 1.0, 3.0};
  s.scene.lights.push_back({});
  const ReferencePicture p = render_reference(s.scene, s.view);
  const std::size_t aside = 16 * 33 + 20;
  const double cosine = -glm::dot(p.normal[aside], glm::dvec3(0, 1, 0));
  EXPECT_LT(cosine, 0.99);
  EXPECT_NEAR(p.color[aside].x, std::pow(2 * cosine * cosine - 1, 3.0), 1e-12);
}

TEST(ReferenceShading, ShadowsOfOtherParticlesOnly) {
  Stage s;
  s.scene.lights.push_back(sun({0, -1, 1}));
  s.scene.lights[0].shadows = true;
  const glm::dvec3 lit = s.color();
  EXPECT_GT(lit.x, 0.1) << "a convex particle does not shade itself";
  Scene blocker = scene_of({{{0, -3, 2}, 0.3}});
  s.scene.batches.push_back(blocker.batches[0]);
  s.scene.batches[1].id_base = 1;
  expect_near(s.color(), glm::dvec3(0));
  ReferenceOptions without;
  without.shadows = false;
  expect_near(s.color(without), lit);
  s.scene.lights[0].shadows = false;
  expect_near(s.color(), lit);
  Light lamp; // nearer than the blocker
  lamp.kind = LightKind::Point;
  lamp.position = {0, -2, 1};
  lamp.shadows = true;
  s.scene.lights = {lamp};
  EXPECT_GT(s.color().x, 0.1);
  const double before = 2.45 / std::sqrt(2.0); // in the blocker's box, but short of its surface
  s.scene.lights[0].position = {0, -1 - before, before};
  EXPECT_GT(s.color().x, 0.1);
  s.scene.lights[0].position = {0, -6, 5};
  expect_near(s.color(), glm::dvec3(0));
}

TEST(ReferenceShading, NoParticleShadesItself) {
  Stage s;
  s.scene.lights.push_back(sun({0.3, -1, 1}));
  s.scene.lights[0].shadows = true;
  const ReferencePicture with = render_reference(s.scene, s.view);
  s.scene.lights[0].shadows = false;
  EXPECT_EQ(with.color, render_reference(s.scene, s.view).color);
}

TEST(ReferenceShading, AreaAveragesThePixel) {
  Stage s;
  s.scene.ambient = glm::dvec3(1);
  s.scene.background = {0, 0, 0, 0};
  s.view.size = {1, 1};
  s.view.projection = Projection::Orthographic;
  s.view.focal = 0.25; // the pixel is 4 wide, the sphere's disk pi
  const auto area = render_reference_area(reference::build_world(s.scene), s.view, 64);
  EXPECT_NEAR(area[0].a, 3.14159265 / 16.0, 2e-3);
  expect_near(glm::dvec3(area[0]), s.scene.batches[0].color); // straight alpha: the color itself
}

} // namespace
} // namespace mote
