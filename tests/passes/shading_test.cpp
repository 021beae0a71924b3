// SPDX-License-Identifier: MIT
// Lights and materials of `opaque_impostors` against the reference, and where a closed form is short,
// against that.
#include "harness.hpp"

#include <cmath>

namespace mote::test {
namespace {

class Shading : public GpuTest {
protected:
  static Scene ball() {
    Scene scene = scene_of({{0, 0, 0, 2}, {2.5, 1, 0.5, 0.8}}, {0xFF3080F0u, 0xFFFFFFFFu});
    scene.lights.clear();
    return scene;
  }
  static View view(const Scene& scene) { return look(scene, {1, 2, 10}, {0, 0, 0}, {160, 120}); }
  void check(const Scene& scene) { expect_equals_reference(draw(scene, view(scene)), scene, view(scene), {.least_hits = 0.05}); }
};

TEST_F(Shading, AmbientAlone) {
  Scene scene = ball();
  scene.ambient = {0.5, 0.25, 0.125};
  const Picture p = draw(scene, view(scene));
  const glm::vec4 c = p.color[p.at(80, 60)];
  EXPECT_NEAR(c.r, 0.8714 * 0.5, 2e-3); // sRGB 0xF0 decodes to 0.8714
  check(scene);
}

TEST_F(Shading, EveryModelAndLight) {
  for (const ShadingModel model : {ShadingModel::Lambert, ShadingModel::Phong, ShadingModel::BlinnPhong})
    for (const LightKind kind : {LightKind::Headlight, LightKind::Directional, LightKind::Point, LightKind::Spot}) {
      Scene scene = ball();
      scene.batches[0].material = {model, 0.9, 0.7, 0.6, 20.0};
      Light light{.kind = kind, .direction = glm::normalize(glm::dvec3(-1, -1.5, -2)), .position = {3, 5, 6}, .color = {1, 0.9, 0.7}};
      light.attenuation = {1, 0.01, 0.002};
      light.inner_angle = 0.2;
      light.outer_angle = 0.5;
      scene.lights.push_back(light);
      check(scene);
    }
}

TEST_F(Shading, SeveralLightsAddUp) {
  Scene scene = ball();
  scene.batches[0].material = {ShadingModel::BlinnPhong, 1, 0.6, 0.4, 50.0};
  for (int i = 0; i < 5; ++i)
    scene.lights.push_back({.kind = i % 2 ? LightKind::Point : LightKind::Directional,
                            .direction = glm::normalize(glm::dvec3(i - 2.0, -1, -1)), .position = {4.0 * i - 8, 6, 8},
                            .color = {0.3, 0.2, 0.25}, .intensity = 0.8});
  check(scene);
}

// Exponent 0 lights everything that faces the light; large ones stay finite.
TEST_F(Shading, ExtremeExponents) {
  for (const double exponent : {0.0, 0.5, 1.0, 1e4}) {
    Scene scene = ball();
    scene.batches[0].material = {ShadingModel::Phong, 0, 0, 1.0, exponent};
    scene.lights.push_back({.kind = LightKind::Headlight});
    check(scene);
  }
}

TEST_F(Shading, NoLightAtAll) {
  Scene scene = ball();
  scene.ambient = {0, 0, 0};
  const Picture p = draw(scene, view(scene));
  EXPECT_EQ(p.display[p.at(80, 60)], glm::u8vec4(0, 0, 0, 255));
}

} // namespace
} // namespace mote::test
