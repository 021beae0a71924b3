// SPDX-License-Identifier: MIT
// Exercises of the course documents with a derivable answer, computed by mote: stacks of blending by its passes, the maxima of the
// Phong terms on a sphere by its shading, products of transformations and the viewport by its scene and camera code.
#include "../passes/graph_test.hpp"

#include "core/reference/reference.hpp"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <gmock/gmock.h>

#include <cmath>

namespace mote::test {
namespace {

class Exercises : public GraphTest {
protected:
  static View view(const Scene& scene) { return look(scene, {0, 0, 10}, {0, 0, 0}, {65, 65}); }
  // The exercise's three objects in the order of their index: green, blue of 1/2, red of 1/2; red is the nearest, blue the farthest.
  static Scene three() { return join({flat_sphere({0, 0, 0, 1}, {0, 1, 0}), flat_sphere({0, 0, -3, 1}, {0, 0, 1}, 0.5), flat_sphere({0, 0, 3, 1}, {1, 0, 0}, 0.5)}); }
  glm::vec4 center(const Scene& scene, const std::string& params) {
    const std::string graph = fmt::format("schema = 1\noutput = \"all.color\"\n[[pass]]\nname = \"all\"\nkind = \"opaque_impostors\"\nparams = {{ blend = \"over\"{} }}\n", params);
    return draw_graph(scene, view(scene), graph, "all.color").center();
  }
};

void expect_color(const glm::vec4& found, const glm::dvec3& wanted) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], wanted[k], 1e-3) << k;
}

// Exercise c: what the marked pixel shows.
TEST_F(Exercises, BlendingOfThreeObjects) {
  expect_color(center(three(), ""), {0.5, 0.5, 0});                                                          // a. depth test "less"
  expect_color(center(three(), ", depth_test = \"always\", depth_write = false"), {0.5, 0.25, 0.25});        // b. no depth test
  Scene sorted = join({flat_sphere({0, 0, -3, 1}, {0, 0, 1}, 0.5), flat_sphere({0, 0, 0, 1}, {0, 1, 0}), flat_sphere({0, 0, 3, 1}, {1, 0, 0}, 0.5)});
  expect_color(center(sorted, ", depth_test = \"always\", depth_write = false"), {0.5, 0.5, 0});             // c. back to front
}

// The example of the script: (1, 0, 0, 0.8) before (0, 0, 1, 0.5) is (0.8, 0, 0.1) of alpha 0.9; over black that is what is seen.
TEST_F(Exercises, TwoObjectsOverBlack) {
  Scene scene = join({flat_sphere({0, 0, -3, 1}, {0, 0, 1}, 0.5), flat_sphere({0, 0, 3, 1}, {1, 0, 0}, 0.8)});
  scene.background = {0, 0, 0, 1};
  expect_color(center(scene, ", depth_test = \"always\", depth_write = false"), {0.8, 0, 0.1});
  Scene swapped = join({flat_sphere({0, 0, -3, 1}, {1, 0, 0}, 0.8), flat_sphere({0, 0, 3, 1}, {0, 0, 1}, 0.5)});
  swapped.background = scene.background;
  expect_color(center(swapped, ", depth_test = \"always\", depth_write = false"), {0.4, 0, 0.5}); // not commutative
}

// Assignment 3: k_d = k_s = 0.5, k_a = 0, n = sqrt(2), light of intensity 1. Diffuse is largest where the normal points to the light,
// specular where it halves the angle between light and eye; both are 0.5 there.
TEST_F(Exercises, MaximaOfDiffuseAndSpecular) {
  Scene scene = scene_of({{0, 0, 0, 1}});
  scene.ambient = glm::dvec3(0);
  scene.background = {0, 0, 0, 1};
  scene.batches[0].color = glm::dvec3(1);
  scene.lights = {{.kind = LightKind::Directional, .direction = {-1, 0, 0}}}; // from the right, the eye in front
  const Size2d size{401, 401};
  const View eye = look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, size, 2.2);
  struct Term {
    double diffuse, specular, x; // where it is largest, in radii
  };
  for (const Term& term : {Term{0.5, 0.0, 1.0}, Term{0.0, 0.5, std::sqrt(0.5)}}) {
    scene.batches[0].material = {ShadingModel::Phong, 0.0, term.diffuse, term.specular, std::sqrt(2.0)};
    const Picture p = check(scene, eye);
    std::size_t best = 0;
    for (std::size_t i = 0; i < p.color.size(); ++i)
      if (p.color[i].r > p.color[best].r) best = i;
    EXPECT_NEAR(p.color[best].r, 0.5, 2e-3);
    EXPECT_NEAR((static_cast<double>(best % size.width) - 200.0) * 2.2 / 401.0, term.x, 0.02);
    EXPECT_NEAR(static_cast<double>(best / size.width), 200.0, term.specular > 0 ? 3.0 : 30.0);
  }
}

// b1: the inverse of a translation after an isotropic scaling.
TEST_F(Exercises, InverseOfScalingAndTranslation) {
  const double s = 2.5;
  const glm::dvec3 t(1, -2, 3);
  const glm::dmat4 m = glm::translate(glm::dmat4(1), t) * glm::scale(glm::dmat4(1), glm::dvec3(s));
  const glm::dmat4 inverse = glm::translate(glm::scale(glm::dmat4(1), glm::dvec3(1 / s)), -t), expected = glm::inverse(m);
  for (int i = 0; i < 4; ++i) EXPECT_LT(glm::length(inverse[i] - expected[i]), 1e-12);
  EXPECT_LT(glm::length(glm::dvec3(inverse[3]) + t / s), 1e-12) << "its last column is -t / s";
  EXPECT_NEAR(*similarity_scale(m), s, 1e-12);
}

// c: the shear that maps (2, 0) to (2, 1) and (2, 2) to (2, 3).
TEST_F(Exercises, TheShearOfTheQuadrilateral) {
  glm::dmat3 m(1.0);
  m[0][1] = 0.5; // y' = y + x / 2
  EXPECT_EQ(m * glm::dvec3(2, 0, 1), glm::dvec3(2, 1, 1));
  EXPECT_EQ(m * glm::dvec3(2, 2, 1), glm::dvec3(2, 3, 1));
  EXPECT_EQ(m * glm::dvec3(0, 2, 1), glm::dvec3(0, 2, 1));
}

// The pixel of a point by the camera is where the viewport transformation puts it: x to the right, rows from the top.
TEST_F(Exercises, Viewport) {
  const Scene scene = scene_of({{0, 0, 0, 1}});
  const View v = look(scene, {0, 0, 10}, {0, 0, 0}, {1024, 512}, 30);
  const glm::dvec3 p = v.to_view({0.7, 0.4, 0.0});
  const glm::dvec2 pixel = v.center() + v.focal * glm::dvec2(p) / p.z;
  const double aspect = 2.0, scale = 1.0 / std::tan(glm::radians(15.0));
  const glm::dvec2 ndc(0.7 / 10.0 * scale / aspect, 0.4 / 10.0 * scale);
  EXPECT_NEAR(pixel.x, 1024 * (0.5 * ndc.x + 0.5), 1e-9);
  EXPECT_NEAR(pixel.y, 512 * (0.5 - 0.5 * ndc.y), 1e-9);
}

} // namespace
} // namespace mote::test
