// SPDX-License-Identifier: MIT
// A picture drawn in panels is the picture: bit for bit where both can be drawn, and against the reference
// where only panels can (rows of 20 000 pixels).
#include "harness.hpp"

#include "core/reference/reference.hpp"

#include <algorithm>
#include <cmath>

namespace mote::test {
namespace {

class Panels : public GpuTest {
protected:
  Picture assemble(const Scene& scene, const View& view, std::uint32_t most) {
    Picture whole;
    whole.size = view.size;
    const std::size_t pixels = std::size_t{view.size.width} * view.size.height;
    whole.depth.resize(pixels), whole.id.resize(pixels), whole.normal.resize(pixels), whole.color.resize(pixels), whole.display.resize(pixels);
    for (const View& part : panels(view, most)) {
      const Picture drawn = draw(scene, part);
      for (std::uint32_t y = 0; y < part.size.height; ++y)
        for (std::uint32_t x = 0; x < part.size.width; ++x) {
          const std::size_t from = drawn.at(x, y), to = whole.at(part.panel_origin.x + x, part.panel_origin.y + y);
          whole.depth[to] = drawn.depth[from];
          whole.id[to] = drawn.id[from];
          whole.normal[to] = drawn.normal[from];
          whole.color[to] = drawn.color[from];
          whole.display[to] = drawn.display[from];
        }
    }
    return whole;
  }
};

Scene spheres_and_ellipsoids() {
  std::vector<glm::dvec4> spheres = cloud(1500, 8, 0.05, 1.0);
  spheres.emplace_back(8.5, 11.5, 29.0, 0.6); // near the eye
  glm::dmat4 stretched(1.0);
  stretched[0][0] = 0.5;
  stretched[3] = glm::dvec4(1, 2, 0, 1);
  return placed(scene_of(spheres, {0xFF3080F0u, 0xFFFFFFFFu}), {glm::dmat4(1.0), stretched});
}

TEST_F(Panels, AreTheWholePictureBitForBit) {
  Scene scene = spheres_and_ellipsoids();
  scene.background = {0.5, 0.25, 0, 0}; // transparent
  for (const Size2d size : {Size2d{320, 200}, Size2d{161, 97}}) // both centers: between pixels and on one
    for (const View& view : {look(scene, {9, 12, 30}, {0, 0, 0}, size, 50), look_orthographic(scene, {9, 12, 30}, {0, 0, 0}, size, 24)}) {
      const Picture whole = draw(scene, view), parts = assemble(scene, view, 128);
      EXPECT_EQ(whole.id, parts.id);
      EXPECT_EQ(whole.depth, parts.depth);
      EXPECT_EQ(whole.normal, parts.normal);
      EXPECT_EQ(whole.color, parts.color);
      EXPECT_EQ(whole.display, parts.display);
      EXPECT_EQ(whole.display[0].a, 0) << "the background shows in the corner";
    }
}

TEST_F(Panels, RowsLongerThanAnyTexture) {
  const Scene scene = spheres_and_ellipsoids();
  // 20 000 pixels side by side see 90 degrees; 8 rows of them.
  const Size2d size{20000, 8};
  const double fov = 2.0 * glm::degrees(std::atan(8.0 / 20000.0));
  View view = look(scene, {9, 12, 30}, {2, 0, 0}, size, fov);
  ASSERT_GT(size.width, device().limits().max_texture_dimension_2d);
  const Picture picture = assemble(scene, view, 4096);
  expect_equals_reference(picture, scene, view, {.least_hits = 0.1});
}

TEST(PanelViews, TileThePicture) {
  View view;
  view.size = {1000, 130};
  const std::vector<View> parts = panels(view, 300);
  ASSERT_EQ(parts.size(), 4u);
  std::uint32_t x = 0;
  for (const View& part : parts) {
    EXPECT_EQ(part.panel_origin, glm::uvec2(x, 0));
    EXPECT_EQ(part.picture, view.size);
    EXPECT_EQ(part.size.height, 130u);
    EXPECT_LE(part.size.width, 300u);
    EXPECT_EQ(part.ray_direction(0.0, 0.0), view.ray_direction(x, 0.0));
    x += part.size.width;
  }
  EXPECT_EQ(x, 1000u);
  ASSERT_EQ(panels(view, 1000).size(), 1u);
  EXPECT_EQ(panels(view, 1000)[0].picture, Size2d{}) << "one that fits is its own only panel";
}

} // namespace
} // namespace mote::test
