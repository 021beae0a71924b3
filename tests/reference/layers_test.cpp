// SPDX-License-Identifier: MIT
// Exact transparency of the reference: closed forms of one pixel, and every sphere against every pixel
// written from the definition.
#include "scenes.hpp"

#include "core/reference/layers.hpp"
#include "core/reference/shade.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace mote::test {
namespace {

View ahead() { return look({0, -10, 0}, {0, 0, 0}, {33, 33}, 20.0); }
constexpr std::size_t middle = 33 * 16 + 16;

// Balls with a color and an alpha each (8 bits), lit by ambient light of 1 alone.
Scene colored(const std::vector<Ball>& balls, const std::vector<std::uint32_t>& colors) {
  Scene scene = scene_of(balls);
  auto chunks = std::make_shared<ChunkSet>(*scene.batches[0].chunks);
  chunks->colors.assign(chunks->record_count(), 0u);
  for (std::size_t i = 0; i < balls.size(); ++i) chunks->colors[i] = colors[i % colors.size()];
  scene.batches[0].chunks = chunks;
  scene.lights.clear();
  scene.ambient = glm::dvec3(1);
  return scene;
}

void expect_near(const glm::dvec4& found, const glm::dvec4& wanted, double tolerance = 1e-12) {
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(found[k], wanted[k], tolerance) << "channel " << k;
}

TEST(ReferenceLayers, TwoOverOneAnother) {
  const double a = 0x66 / 255.0, b = 0x99 / 255.0;
  Scene scene = colored({{{0, 2, 0}, 0.5}, {{0, -2, 0}, 0.5}}, {0x6600FF00u, 0x990000FFu}); // far green, near red
  scene.background = {0, 0, 1, 1};
  for (const bool two : {true, false}) {
    const ReferencePicture p = render_reference(scene, ahead(), {.two_surfaces = two});
    expect_near(p.color[middle], {b, (1 - b) * a, (1 - b) * (1 - a), 1});
    EXPECT_EQ(p.id[middle], reference_no_id) << "AOVs show opaque surfaces";
    EXPECT_EQ(p.layers_ambiguous[middle], 0);
    EXPECT_EQ(p.color[0], scene.background);
  }
  scene.background = {0, 0, 1, 0};
  const double alpha = b + (1 - b) * a;
  expect_near(render_reference(scene, ahead()).color[middle], {b / alpha, (1 - b) * a / alpha, 0, alpha});
}

// Entry and exit around an opaque ball: only the entry is before it.
TEST(ReferenceLayers, StopAtOpaqueSurfaces) {
  Scene scene = colored({{{0, 0, 0}, 1.0}, {{0, 0, 0}, 0.5}}, {0x800000FFu, 0xFF00FF00u});
  const double a = 1.0 - std::sqrt(1.0 - 0x80 / 255.0);
  const ReferencePicture p = render_reference(scene, ahead());
  expect_near(p.color[middle], {a, 1 - a, 0, 1});
  EXPECT_EQ(p.id[middle], 1u);
}

TEST(ReferenceLayers, CutByTheNearPlane) {
  Scene scene = colored({{{0, 0, 0}, 1.0}}, {0x800000FFu});
  scene.background = {0, 0, 0, 1};
  View view = ahead();
  view.near_cut = 10.0; // in the middle
  const double alpha = 0x80 / 255.0;
  expect_near(render_reference(scene, view).color[middle], {1.0 - std::sqrt(1.0 - alpha), 0, 0, 1});
  expect_near(render_reference(scene, view, {.two_surfaces = false}).color[middle], {alpha, 0, 0, 1});
  view.near_cut = 12.0;
  EXPECT_EQ(render_reference(scene, view).color[middle], scene.background);
}

// Particles in one place count each, unlike opaque ones.
TEST(ReferenceLayers, DuplicatesAreKept) {
  Scene scene = colored(std::vector<Ball>(20, Ball{{0, 0, 0}, 1.0}), {0x400000FFu});
  scene.background = {0, 0, 1, 1};
  const double through = std::pow(1.0 - 0x40 / 255.0, 20);
  const ReferencePicture p = render_reference(scene, ahead());
  expect_near(p.color[middle], {1 - through, 0, through, 1});
  EXPECT_EQ(p.layers_ambiguous[middle], 1) << "surfaces at one depth";
}

TEST(ReferenceLayers, EqualsEverySphereAgainstEveryPixel) {
  const std::vector<Ball> balls = random_balls(300, 3.0, 0.3, 1.2, 5);
  std::vector<std::uint32_t> colors;
  std::mt19937 random(9);
  for (std::size_t i = 0; i < balls.size(); ++i) colors.push_back(static_cast<std::uint32_t>(random()) | (i % 5 ? 0u : 0xFF000000u));
  Scene scene = colored(balls, colors);
  scene.background = {0.2, 0.4, 0.6, 0.5};
  const View view = ahead();
  const ReferencePicture p = render_reference(scene, view);
  const ChunkSet& chunks = *scene.batches[0].chunks;
  struct Surface {
    double t;
    std::uint32_t color;
  };
  double deepest = 0;
  for (std::uint32_t y = 0; y < 33; ++y)
    for (std::uint32_t x = 0; x < 33; ++x) {
      std::vector<Surface> surfaces;
      const glm::dvec3 d = view.ray_direction(x, y);
      for (std::uint64_t i = 0; i < chunks.record_count(); ++i) {
        if (chunks.rows[i] == no_row) continue;
        const glm::dvec3 c = view.to_view(chunks.center(i));
        const double r = chunks.records[i].w, a = glm::dot(d, d), b = glm::dot(d, c), q = b * b - a * (glm::dot(c, c) - r * r);
        if (q < 0) continue;
        for (const double t : {(b - std::sqrt(q)) / a, (b + std::sqrt(q)) / a})
          if (t > 0) surfaces.push_back({t, chunks.colors[i]});
      }
      std::sort(surfaces.begin(), surfaces.end(), [](const Surface& s, const Surface& o) { return s.t < o.t; });
      glm::dvec3 light(0);
      double through = 1.0;
      for (const Surface& s : surfaces) {
        const double own = (s.color >> 24) / 255.0, alpha = own >= 1.0 ? 1.0 : 1.0 - std::sqrt(1.0 - own);
        const glm::dvec3 rgb(reference::srgb_to_linear((s.color & 255u) / 255.0), reference::srgb_to_linear((s.color >> 8 & 255u) / 255.0),
                             reference::srgb_to_linear((s.color >> 16 & 255u) / 255.0));
        light += through * alpha * rgb;
        through *= 1.0 - alpha;
      }
      deepest = std::max(deepest, double(surfaces.size()));
      light += through * 0.5 * glm::dvec3(scene.background);
      const double alpha = 1.0 - 0.5 * through;
      expect_near(p.color[std::size_t{y} * 33 + x], glm::dvec4(light / alpha, alpha), 1e-9);
    }
  EXPECT_GT(deepest, 20) << "the rays must cross many surfaces";
}

} // namespace
} // namespace mote::test
