// SPDX-License-Identifier: MIT
// Failure cases of particles other than spheres: naive formulas in float32, mote's passes as pictures against the reference.
#include "../passes/harness.hpp"

#include "app/charts/random.hpp"
#include "glyph_twins.hpp"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>

#include <cmath>

namespace mote::test {
namespace {

using app::Random;

constexpr double pad = 1.0 + 1e-6;

Glyph cylinder(const glm::dvec3& center, const glm::dvec3& h, double radius) {
  return {center, std::hypot(glm::length(h), radius) * pad, radius, {glm::vec4(glm::vec3(h), radius), glm::vec4(radius, 0, 0, 0)}};
}
Glyph cone(const glm::dvec3& center, const glm::dvec3& h, double radius) {
  return {center, std::hypot(glm::length(h), radius) * pad, radius, {glm::vec4(glm::vec3(h), radius), glm::vec4(0)}};
}
Glyph capsule(const glm::dvec3& center, const glm::dvec3& h, double radius) {
  return {center, (glm::length(h) + radius) * pad, radius, {glm::vec4(glm::vec3(h), radius)}};
}
Glyph arrow(const glm::dvec3& center, const glm::dvec3& h, double shaft, double head, double head_length) {
  return {center, std::hypot(glm::length(h), head) * pad + 1e-6, shaft, {glm::vec4(glm::vec3(h), shaft), glm::vec4(head, head_length, 0, 0)}};
}
// A view of about `extent` at any distance.
View from_afar(const Scene& scene, const glm::dvec3& direction, double distance, double extent, Size2d size = {160, 100}) {
  return look(scene, distance * glm::normalize(direction), {0, 0, 0}, size, glm::degrees(2.0 * std::atan(0.5 * extent / distance)));
}

class StabilityGlyphs : public GpuTest {};

// Rays at a cylinder from `distance`: by the books in float32, against double. Parts of the rays that hit.
struct Share {
  double wrong{}, off{}; // hit or missed wrongly; t more than a tenth of the radius off
};
Share naive_cylinder(const glm::dvec3& h, double radius, double distance) {
  Random random(11);
  const glm::dvec3 center = distance * random.direction();
  const auto exact = twin::rod<double>(center, h, radius);
  const auto naive = twin::rod<float>(center, h, radius);
  std::size_t hits = 0, wrong = 0, off = 0;
  for (int k = 0; k < 20000; ++k) {
    const glm::dvec3 d(glm::vec3(center + random.uniform(-1.1, 1.1) * h + radius * random.uniform(0, 1.3) * random.direction()));
    const auto truth = twin::nearest(exact, d);
    const auto found = twin::nearest(naive, glm::vec3(d));
    hits += truth.has_value();
    wrong += truth.has_value() != found.has_value();
    off += truth && found && std::abs(*truth - static_cast<double>(*found)) * glm::length(d) > 0.1 * radius;
  }
  return {static_cast<double>(wrong) / static_cast<double>(hits), static_cast<double>(off) / static_cast<double>(hits)};
}

TEST_F(StabilityGlyphs, FC13_CylindersThinAndFar) {
  EXPECT_GT(naive_cylinder({0, 0.6, 0.8}, 1.0, 3e4).off, 0.05);
  EXPECT_GT(naive_cylinder({0, 18, 24}, 1.0, 3e4).wrong, 0.2);
  for (const auto& [slenderness, far] : {std::pair(1.0, 1e2), std::pair(1.0, 1e4), std::pair(30.0, 1e1), std::pair(30.0, 1e3)}) { // half length / radius; distance / half length
    const glm::dvec3 h = slenderness * glm::dvec3(0.48, 0.6, 0.64);
    const Scene scene = glyph_scene("cylinder", {cylinder({0, 0, 0}, h, 1.0)});
    check(scene, from_afar(scene, {0.3, 0.2, 1}, far * slenderness, 2.6 * slenderness),
          {.least_hits = 0.005, .most_ambiguous = 0.03, .depth_factor = 2, .normal_factor = far > 1e3 ? 60.0 * slenderness : 8.0 * slenderness});
  }
  const Scene thread = glyph_scene("cylinder", {cylinder({0, 0, 0}, {100, 30, 5}, 0.01)});
  expect_equals_reference(draw(thread, look(thread, {0.1, 0.2, 3}, {0, 0, 0}, {160, 100}, 3)), thread, look(thread, {0.1, 0.2, 3}, {0, 0, 0}, {160, 100}, 3),
                          {.least_hits = 0.003, .most_ambiguous = 0.05, .depth_factor = 100, .normal_factor = 3e4});
}

TEST_F(StabilityGlyphs, FC14_ACylinderAlongItsAxis) {
  EXPECT_FALSE(std::isfinite(twin::side_root(twin::rod<float>({0.5, 0, 10}, {0, 0, 2}, 1.0), glm::vec3(0, 0, 1)))) << "division by a = 0";
  for (const double tilt : {0.0, 1e-7}) {
    const Scene scene = glyph_scene("cylinder", {cylinder({0, 0, 0}, {2 * tilt, 0, 2}, 1.0)});
    for (const View& view : {look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {101, 101}, 3.03), look(scene, {0, 0, 10}, {0, 0, 0}, {101, 101}, 20)}) {
      const Picture p = check(scene, view, {.least_hits = 0.2, .normal_factor = 6});
      EXPECT_EQ(p.id[p.at(50, 50)], 0u);
      EXPECT_NEAR(p.depth[p.at(50, 50)], 8.0, 1e-5) << "the disc at the near end";
      for (const glm::vec4& n : p.normal) ASSERT_FALSE(std::isnan(n.x + n.y + n.z));
    }
  }
}

TEST_F(StabilityGlyphs, FC15_TheEyeOnOrInACylinder) {
  const glm::dvec3 h(0, 0, 3);
  EXPECT_LT(twin::side_root(twin::rod<float>({0.3, 0, 0}, h, 1.0), glm::vec3(0.3f, 0.2f, 1)), 0.0f) << "inside the nearer root lies behind the eye";
  const Scene scene = glyph_scene("cylinder", {cylinder({0, 0, 0}, h, 1.0), cylinder({0, 4, -12}, {1, 0, 0.5}, 0.5)});
  struct Place {
    glm::dvec3 eye;
    double hits;
  };
  for (const Place& place : {Place{{0, 0, 0}, 1.0}, {{0, 0, 6}, 0.1}, {{0.5, 0.2, 5}, 0.1}, {{0.9, 0, 1}, 1.0}, {{0.999, 0, 1}, 1.0}, {{1.001, 0, 1}, 0.2}})
    check(scene, look(scene, place.eye, place.eye + glm::dvec3(-0.1, 0.05, -1), {160, 100}, 60),
          {.least_hits = place.hits, .most_ambiguous = 0.05, .normal_factor = 20});
}

// Rays at the edge between side and disc from the inside of the solid: two comparisons, each rounded for itself, lose some.
TEST_F(StabilityGlyphs, FC16_SparklingRims) {
  Random random(23);
  std::size_t lost = 0, rays = 0;
  for (int k = 0; k < 40000; ++k) {
    const glm::dvec3 center = 1000.0 * random.direction(), axis = random.direction();
    const double elevation = std::abs(glm::dot(glm::normalize(center), axis));
    if (elevation < 0.34 || elevation > 0.94) continue; // 20 to 70 degrees
    const double end = glm::dot(center, axis) < 0 ? 1.0 : -1.0; // the disc that is seen
    const glm::dvec3 side = glm::normalize(glm::cross(axis, random.direction()));
    const glm::dvec3 rim = center + end * axis + side;
    const glm::dvec3 d(glm::vec3(rim - random.uniform(0, 5e-3) * (side + end * axis)));
    if (!twin::nearest(twin::rod<double>(center, axis, 1.0), d)) continue;
    ++rays;
    lost += !twin::nearest(twin::rod<float>(center, axis, 1.0), glm::vec3(d));
  }
  EXPECT_GT(static_cast<double>(lost), 0.01 * static_cast<double>(rays)) << rays;
  std::vector<Glyph> many;
  for (int i = 0; i < 400; ++i) many.push_back(cylinder({(i % 20 - 9.5) * 3.0, (i / 20 - 9.5) * 3.0, 0}, random.direction() * 0.9, 1.0));
  const Scene scene = glyph_scene("cylinder", many);
  for (const double pixels : {1.0, 3.0, 10.0}) // radius on the image, from a thousand radii away
    check(scene, from_afar(scene, {0.2, 0.3, 1}, 1000.0, 200.0 / pixels, {200, 200}), {.least_hits = 0.03, .most_ambiguous = 0.03, .normal_factor = 12});
}

TEST_F(StabilityGlyphs, FC17_AConeThroughItsApex) {
  // Apex (0, 0, 8), half as wide as high: the generator on the left runs along (-0.5, 0, 1) from there.
  const auto upright = twin::rod<float>({0, 0, 9}, {0, 0, -1}, 1.0);
  EXPECT_FALSE(std::isfinite(twin::cone_side(upright, glm::vec3(-0.5f, 0, 1)).value_or(NAN))) << "along a generator a = 0";
  std::vector<Glyph> cones{cone({0, 0, 0}, {0, 0, 1}, 1.0), cone({3, 0, 0}, {0, 0, -1}, 1.0), cone({-3, 0, 0}, {0, 1, 0}, 0.5)};
  const glm::dvec3 generator = glm::normalize(glm::dvec3(1.0, 0, 2.0)); // of the first: from (-1, 0, -1) to its apex
  const Scene scene = glyph_scene("cone", cones);
  for (const View& view : {look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {161, 101}, 5.05), look_orthographic(scene, generator * 10.0, {0, 0, 0}, {161, 101}, 5.05),
                           look(scene, generator * 8.0 + glm::dvec3(0, 0, 1), {0, 0, 1}, {161, 101}, 40), look(scene, {0, 0, 1.5}, {0, 0, 0}, {161, 101}, 60)}) {
    const Picture p = check(scene, view, {.least_hits = 0.05, .most_ambiguous = 0.05, .depth_factor = 3, .normal_factor = 30});
    for (const glm::vec4& n : p.normal) ASSERT_FALSE(std::isnan(n.x + n.y + n.z));
  }
  // A ray that meets the mirror nappe alone misses: the axis prolonged beyond the apex.
  const Picture side = draw(scene, look_orthographic(scene, {0, -10, 0}, {0, 0, 0}, {161, 101}, 5.05));
  EXPECT_EQ(side.id[side.at(80, 20)], 0xFFFFFFFFu) << "above the apex of the first";
  EXPECT_EQ(side.id[side.at(80, 60)], 0u);
}

TEST_F(StabilityGlyphs, FC18_NeedlesAndHeadsWithoutShaft) {
  Random random(5);
  const glm::dvec3 center(0, 0, 3), h(0.8, 0.6, 0.2);
  std::size_t wrong = 0, hits = 0;
  for (int k = 0; k < 20000; ++k) {
    const double along = random.uniform(-1, 1);
    const glm::dvec3 d(glm::vec3(center + along * h + 0.5e-4 * (1 - along) * random.uniform(0, 1.2) * random.direction()));
    const bool truth = twin::cone_side(twin::rod<double>(center, h, 1e-4), d).has_value();
    hits += truth;
    wrong += truth != twin::cone_side(twin::rod<float>(center, h, 1e-4), glm::vec3(d)).has_value();
  }
  EXPECT_GT(static_cast<double>(wrong), 0.1 * static_cast<double>(hits));
  const Bars thin{.least_hits = 0.003, .most_ambiguous = 0.05, .depth_factor = 1000, .normal_factor = 3e5};
  const Scene needle = glyph_scene("cone", {cone({0, 0, 0}, {80, 60, 20}, 0.01)});
  check(needle, look(needle, {0.1, 0.2, 3}, {0, 0, 0}, {160, 100}, 2), thin);
  const Scene heads = glyph_scene("arrow", {arrow({-1.5, 0, 0}, {0, 1, 0.2}, 0.2, 0.5, 2.0 * std::hypot(1.0, 0.2)), arrow({1.5, 0, 0}, {0, 1, 0.2}, 0.2, 0.5, 0.8)});
  const Picture p = check(heads, look(heads, {1, 2, 9}, {0, 0, 0}, {200, 120}), {.least_hits = 0.03, .most_ambiguous = 0.03, .normal_factor = 12});
  EXPECT_NE(std::count(p.id.begin(), p.id.end(), 0u), 0);
}

// Two capsules end in the same ball. Its depth is computed from two centers, so the last bits differ: which of the two a pixel
// shows follows rounding, but never another picture twice.
TEST_F(StabilityGlyphs, FC19_CoincidentEnds) {
  const glm::dvec3 end(0.1, 0.2, 0.3), h1(1.1, 0.3, -0.4), h2(-0.7, 0.9, 0.2);
  std::size_t first = 0, second = 0;
  Random random(3);
  const glm::vec3 eye(0.3f, 0.4f, 9), one = glm::vec3(end + h1) - glm::vec3(h1), two = glm::vec3(end + h2) - glm::vec3(h2);
  for (int k = 0; k < 2000; ++k) {
    const glm::vec3 d(glm::normalize(end + 0.4 * random.direction() - glm::dvec3(eye)));
    const auto depth = [&](const glm::vec3& c) {
      const glm::vec3 m = c - eye, l = m - d * glm::dot(m, d);
      return glm::dot(m, d) - std::sqrt(0.25f - glm::dot(l, l));
    };
    first += depth(one) < depth(two);
    second += depth(two) < depth(one);
  }
  EXPECT_GT(first, 20u) << "which is nearer follows rounding";
  EXPECT_GT(second, 20u);
  const Scene scene = glyph_scene("capsule", {capsule(end + h1, h1, 0.5), capsule(end + h2, h2, 0.5)});
  const View view = look(scene, glm::dvec3(eye), {0, 0.3, 0}, {200, 120}, 30);
  const Picture a = check(scene, view, {.least_hits = 0.1, .most_ambiguous = 0.2, .normal_factor = 6}), b = draw(scene, view);
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.color, b.color);
}

TEST_F(StabilityGlyphs, FC22_SuperquadricsWithCreases) {
  EXPECT_FALSE(std::isfinite(twin::superquadric(glm::vec3(100, 30, 20), 0.1f, 0.1f))) << "the books' function overflows at a hundred sizes";
  EXPECT_EQ(twin::superquadric(glm::vec3(0.005f, 0.001f, 0.001f), 0.1f, 0.1f), 0.0f) << "and underflows near the center";
  const glm::dquat turn = glm::normalize(glm::dquat(0.9, 0.1, -0.3, 0.2));
  for (const glm::dvec2& e : {glm::dvec2(0.1, 0.1), {1, 0.1}, {2, 2}, {0.3, 1.7}}) {
    const Scene scene = glyph_scene("superquadric", {{.center = {0, 0, 0}, .bound = std::sqrt(14.0) * pad, .finest = 1.0,
                                                      .rest = {glm::vec4(turn.x, turn.y, turn.z, turn.w), glm::vec4(3, 2, 1, 0), glm::vec4(glm::vec2(e), 0, 0)}}});
    check(scene, from_afar(scene, {1, 2, 12}, e.y == 2.0 ? 400.0 : 12.0, 7.0, {64, 50}), {.least_hits = 0.1, .most_ambiguous = 0.03, .depth_factor = 5, .normal_factor = 400, .colors_off = 0.03});
  }
  // Along a face that is flat but for its creases.
  const Scene flat = glyph_scene("superquadric", {{.center = {0, 0, 0}, .bound = std::sqrt(3.0) * pad, .finest = 1.0, .rest = {glm::vec4(0, 0, 0, 1), glm::vec4(1, 1, 1, 0), glm::vec4(0.1f, 0.1f, 0, 0)}}});
  check(flat, look(flat, {0.3, -6, 1.02}, {0, 0, 0.9}, {64, 50}, 20), {.least_hits = 0.05, .most_ambiguous = 0.05, .depth_factor = 20, .normal_factor = 2000, .colors_off = 0.05});
}

TEST_F(StabilityGlyphs, FC24_ArrowsOfNoAndOfHugeLength) {
  const glm::vec3 none = glm::normalize(glm::vec3(0.0f));
  EXPECT_TRUE(std::isnan(none.x)) << "a vector of zeros has no direction";
  EXPECT_FALSE(std::isfinite(1.0f / (1.0f + -1.0f))) << "and a frame around (0, 0, -1) by 1 / (1 + z) has no axes";
  const Scene scene = glyph_scene("arrow", {arrow({0, 0, 0}, {0, 0, 0}, 0.2, 0.5, 0), arrow({2, 0, 0}, {0, 0, -1}, 0.2, 0.5, 0.6), arrow({-2, 0, 0}, {0, 0, 1}, 0.2, 0.5, 0.6),
                                            arrow({0, -2, 0}, {1, 0, 0}, 0.2, 0.5, 0.6)});
  const auto sound = [](const Picture& p) {
    for (std::size_t i = 0; i < p.id.size(); ++i) ASSERT_FALSE(std::isnan(p.color[i].r) || std::isnan(p.depth[i]) || std::isnan(p.normal[i].x));
  };
  for (const View& view : {look(scene, {0, 0, 9}, {0, 0, 0}, {160, 160}, 40), look_orthographic(scene, {0, 0, 9}, {0, 0, 0}, {160, 160}, 6), look(scene, {7, 3, 5}, {0, 0, 0}, {160, 160}, 40)}) {
    const Picture p = check(scene, view, {.least_hits = 0.02, .most_ambiguous = 0.03, .normal_factor = 12});
    sound(p);
    EXPECT_EQ(std::count(p.id.begin(), p.id.end(), 0u), 0) << "of no length: nothing";
  }
  for (const double length : {1e-30, 1e15, 1e30}) { // whose squares float32 does not have
    const Scene huge = glyph_scene("arrow", {arrow({0, 0, 0}, {length, 0, 0}, 0.2, 0.5, 0.6), arrow({0, 2, 0}, {1, 0, 0}, 0.2, 0.5, 0.6)});
    const View view = look(scene, {0, 0, 9}, {0, 0, 0}, {160, 160}, 40);
    const Picture p = draw(huge, view);
    sound(p);
    EXPECT_GT(std::count(p.id.begin(), p.id.end(), 1u), 100) << "its neighbor is as ever";
  }
}

} // namespace
} // namespace mote::test
