// SPDX-License-Identifier: MIT
// Particle type `sphere` through the default graph on lavapipe: answers known in closed form, and the
// double-precision reference for everything else. Each case is drawn by every expansion.
#include "harness.hpp"

#include <cmath>

namespace mote::test {
namespace {

class Sphere : public GpuTest {};

// One sphere of radius 2 at distance 10, focal 200 px: the silhouette cone has sine 1/5, so its outline is the circle of
// radius f tan(asin(1/5)) = 40.8248 px; the nearest point lies 8 in front.
TEST_F(Sphere, OneSphereHasItsExactOutlineAndDepth) {
  const Scene scene = scene_of({{0, 0, 0, 2}});
  const Size2d size{161, 161};
  const View view = look(scene, {0, 0, 10}, {0, 0, 0}, size, 2.0 * glm::degrees(std::atan(80.5 / 200.0)));
  ASSERT_NEAR(view.focal, 200.0, 1e-9);
  const Picture p = check(scene, view);
  EXPECT_FLOAT_EQ(p.depth[p.at(80, 80)], 8.0f);
  EXPECT_NEAR(p.normal[p.at(80, 80)].z, 1.0f, 1e-6f);
  const double radius = 200.0 * std::tan(std::asin(0.2));
  for (std::uint32_t y = 0; y < size.height; ++y)
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const double d = std::hypot(x - 80.0, y - 80.0);
      if (std::abs(d - radius) > 1e-3) {
        ASSERT_EQ(p.id[p.at(x, y)], d < radius ? 0u : 0xFFFFFFFFu) << x << "," << y;
      }
    }
}

// Lambert under a head light: color * (0.2 + 0.8 n.l), with n.l = 1 at the center and the background elsewhere.
TEST_F(Sphere, ShadesAsTheEquationSays) {
  const Scene scene = scene_of({{0, 0, 0, 2}}, {0xFF0000FFu}); // sRGB red
  const Picture p = draw(scene, look(scene, {0, 0, 10}, {0, 0, 0}, {161, 161}));
  EXPECT_NEAR(p.color[p.at(80, 80)].r, 1.0f, 1e-3f);
  EXPECT_NEAR(p.color[p.at(80, 80)].g, 0.0f, 1e-3f);
  EXPECT_EQ(p.display[p.at(80, 80)], glm::u8vec4(255, 0, 0, 255));
  EXPECT_EQ(p.display[p.at(0, 0)], glm::u8vec4(255, 255, 255, 255));
}

TEST_F(Sphere, CloudPerspective) {
  const Scene scene = scene_of(cloud(3000, 10, 0.05, 1.0));
  check(scene, look(scene, {9, 12, 30}, {0, 0, 0}, {320, 200}), {.least_hits = 0.2});
}

TEST_F(Sphere, CloudOrthographic) {
  const Scene scene = scene_of(cloud(3000, 10, 0.05, 1.0));
  check(scene, look_orthographic(scene, {9, 12, 30}, {0, 0, 0}, {320, 200}, 24), {.least_hits = 0.2});
}

// FC-10: wide angle; the outlines near the corners are long ellipses.
TEST_F(Sphere, OffAxisAtWideAngle) {
  const Scene scene = scene_of(cloud(2000, 10, 0.05, 1.0));
  check(scene, look(scene, {0, 0, 6}, {0, 0, 0}, {320, 200}, 110), {.least_hits = 0.3});
}

// FC-07, FC-08, FC-09: the eye inside a sphere, spheres around the eye plane.
TEST_F(Sphere, EyeInsideTheCloud) {
  std::vector<glm::dvec4> spheres = cloud(2000, 10, 0.05, 1.0);
  spheres.emplace_back(0.1, 0.2, 0.3, 2.0); // holds the eye
  const Scene scene = scene_of(spheres);
  check(scene, look(scene, {0, 0, 0}, {1, 0.2, 0.1}, {320, 200}, 60), {.least_hits = 1.0});
}

TEST_F(Sphere, EyeInsideAtSeveralDepths) {
  for (const double e : {0.0, 0.5, 0.999, 1.001}) {
    const Scene scene = scene_of({{0, 0, 0, 1.0}, {3, 0, 0, 0.5}});
    check(scene, look(scene, {e, 0, 0}, {e - 1.0, 0.1, 0}, {160, 100}, 60),
          {.least_hits = e < 1.0 ? 1.0 : 0.0});
  }
}

// A near plane that cuts spheres shows their inside; a far plane cuts what lies behind it.
TEST_F(Sphere, NearAndFarCut) {
  const Scene scene = scene_of(cloud(2000, 10, 0.05, 1.5));
  View view = look(scene, {9, 12, 30}, {0, 0, 0}, {320, 200});
  view.near_cut = 30.0;
  check(scene, view, {.least_hits = 0.1});
  view.far_cut = 34.0;
  check(scene, view, {.least_hits = 0.05});
  View orthographic = look_orthographic(scene, {0, 0, 30}, {0, 0, 0}, {320, 200}, 24);
  orthographic.near_cut = 31.0;
  check(scene, orthographic, {.least_hits = 0.1});
}

// FC-04: coordinates a million from the origin.
TEST_F(Sphere, FarFromTheOrigin) {
  for (const double offset : {1e3, 1e6}) {
    std::vector<glm::dvec4> spheres = cloud(2000, 10, 0.05, 1.0);
    for (glm::dvec4& s : spheres) s += glm::dvec4(offset, -offset, offset, 0);
    const Scene scene = scene_of(spheres);
    const glm::dvec3 o(offset, -offset, offset);
    check(scene, look(scene, o + glm::dvec3(9, 12, 30), o, {320, 200}), {.least_hits = 0.2});
  }
}

// FC-25 and huge radii: the whole scene scaled; a sphere ten thousand times the others.
TEST_F(Sphere, ExtremeScales) {
  for (const double scale : {1e-6, 1e6}) {
    std::vector<glm::dvec4> spheres = cloud(500, 10, 0.2, 1.0);
    for (glm::dvec4& s : spheres) s *= scale;
    const Scene scene = scene_of(spheres);
    check(scene, look(scene, glm::dvec3(9, 12, 30) * scale, {0, 0, 0}, {160, 100}), {.least_hits = 0.05});
  }
  std::vector<glm::dvec4> spheres = cloud(200, 5, 0.2, 1.0);
  spheres.emplace_back(0, -1e4, 0, 1e4);
  const Scene scene = scene_of(spheres);
  // Most of the giant is seen at a grazing angle, where a ray's own rounding would show.
  check(scene, look(scene, {0, 8, 30}, {0, 0, 0}, {160, 100}), {.least_hits = 0.2});
}

// FC-06: two meters above a sphere of the size of the earth. A grazing ray's rounding (6e-8 rad) would move its hit by
// 6e-8 / (angle of incidence); near the eye rays are carried in two floats.
TEST_F(Sphere, EyeJustAboveAGiant) {
  const Scene scene = scene_of({{0, 0, 0, 6.4e6}});
  check(scene, look(scene, {0, 6.4e6 + 2, 0}, {3, 6.4e6, 0.5}, {160, 100}, 60),
        {.least_hits = 0.5, .most_ambiguous = 0.5});
}

// FC-01 in the picture: small field of view from far away.
TEST_F(Sphere, LongLens) {
  for (const double kappa : {1e2, 1e4, 1e6}) {
    const Scene scene = scene_of({{0, 0, 0, 1.0}, {0.5, 0.5, 0.5, 0.7}});
    check(scene, look(scene, {0, 0.1 * kappa, kappa}, {0, 0, 0}, {128, 128}, glm::degrees(3.0 / kappa)),
          {.least_hits = 0.1, .most_ambiguous = kappa > 1e5 ? 0.1 : 0.01});
  }
}

// FC-21: radius 0 draws nothing and disturbs nothing; ids count the rows of the file.
TEST_F(Sphere, RadiusZeroIsNothing) {
  const Scene scene = scene_of({{0, 0, 1, 0.0}, {0, 0, 0, 1.0}});
  const Picture p = check(scene, look(scene, {0, 0, 10}, {0, 0, 0}, {64, 64}));
  EXPECT_EQ(p.id[p.at(32, 32)], 1u);
}

TEST_F(Sphere, NoParticlesGiveTheBackground) {
  Scene scene = scene_of({});
  scene.background = {0, 0, 1, 1};
  const Picture p = draw(scene, look(scene, {0, 0, 10}, {0, 0, 0}, {32, 32}));
  for (const glm::u8vec4& c : p.display) ASSERT_EQ(c, glm::u8vec4(0, 0, 255, 255));
}

// The sample offset moves the rays and the proxies together.
TEST_F(Sphere, SampleOffset) {
  const Scene scene = scene_of(cloud(2000, 10, 0.02, 0.3));
  for (const glm::dvec2 offset : {glm::dvec2(0.01, 0.99), glm::dvec2(0.9, 0.2)}) {
    View view = look(scene, {9, 12, 30}, {0, 0, 0}, {320, 200});
    view.sample_offset = offset;
    check(scene, view);
  }
}

// Instances: turned, scaled, mirrored; ids are instance-major.
TEST_F(Sphere, Instances) {
  Scene scene = scene_of(cloud(200, 3, 0.2, 0.8));
  Batch& batch = scene.batches[0];
  batch.id_base = 1000;
  for (int k = 0; k < 3; ++k) {
    const double c = std::cos(0.7 * k), s = std::sin(0.7 * k), scale = 1.0 - 0.25 * k;
    glm::dmat4 m(1.0);
    m[0] = glm::dvec4(c, s, 0, 0) * scale;
    m[1] = glm::dvec4(-s, c, 0, 0) * scale * (k == 2 ? -1.0 : 1.0); // mirrored
    m[2] = glm::dvec4(0, 0, 1, 0) * scale;
    m[3] = glm::dvec4(7.0 * k - 7.0, 0, 0, 1);
    if (k == 0) batch.instances.clear();
    batch.instances.push_back({m});
  }
  const Picture p = check(scene, look(scene, {2, 6, 30}, {0, 0, 0}, {320, 200}), {.least_hits = 0.1});
  std::uint32_t least = 0xFFFFFFFFu, most = 0;
  for (const std::uint32_t id : p.id)
    if (id != 0xFFFFFFFFu) least = std::min(least, id), most = std::max(most, id);
  EXPECT_GE(least, 1000u);
  EXPECT_GT(most, 1400u);
  EXPECT_LT(most, 1600u);
}

} // namespace
} // namespace mote::test
