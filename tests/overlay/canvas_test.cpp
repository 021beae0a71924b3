// SPDX-License-Identifier: MIT
// Coverage of areas against known areas; letters; lines against depth.
#include "core/overlay/cell_lines.hpp"
#include "core/overlay/font.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace mote::overlay {
namespace {

double area(const Layer& layer) {
  double sum = 0;
  for (const glm::vec4& p : layer.pixels) sum += static_cast<double>(p.a);
  return sum;
}
float alpha(const Layer& layer, std::uint32_t x, std::uint32_t y) { return layer.pixels[y * layer.size.width + x].a; }

TEST(Canvas, RectanglesCoverTheirArea) {
  Canvas canvas({16, 12});
  canvas.rectangle({2.25, 3.5}, {7.5, 9.0}, glm::dvec3(1));
  const Layer layer = canvas.take();
  EXPECT_NEAR(area(layer), 5.25 * 5.5, 1e-4);
  EXPECT_NEAR(alpha(layer, 2, 3), 0.75 * 0.5, 1e-5);
  EXPECT_EQ(alpha(layer, 4, 5), 1.0f);
  EXPECT_NEAR(alpha(layer, 7, 8), 0.5, 1e-5);
}

TEST(Canvas, CirclesAndHolesAndEdgesOfThePicture) {
  const auto circle = [](double r, double turn) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i < 256; ++i) {
      const double a = turn * 2 * std::numbers::pi * i / 256;
      points.emplace_back(20 + r * std::cos(a), 20 + r * std::sin(a));
    }
    return points;
  };
  Canvas whole({40, 40});
  whole.fill({circle(10, 1), circle(4, -1)}, glm::dvec3(1));
  EXPECT_NEAR(area(whole.take()), std::numbers::pi * (100 - 16), 0.1);
  Canvas cut({20, 40}); // the right half lies outside
  cut.fill({circle(10, -1)}, glm::dvec3(1));
  EXPECT_NEAR(area(cut.take()), std::numbers::pi * 50, 0.1);
}

TEST(Canvas, LaterAreasLieOnTop) {
  Canvas canvas({1, 1});
  canvas.rectangle({0, 0}, {1, 1}, {1, 0, 0});
  canvas.rectangle({0, 0}, {1, 1}, {0, 1, 0}, 0.25);
  const glm::vec4 p = canvas.take().pixels[0];
  EXPECT_NEAR(p.r, 0.75, 1e-6);
  EXPECT_NEAR(p.g, 0.25, 1e-6);
  EXPECT_NEAR(p.a, 1.0, 1e-6);
}

// 'l' of DejaVu Sans is a bar of 184 by 1556 units; 'o' has a hole.
TEST(Letters, HaveTheirShapes) {
  Canvas canvas({40, 120});
  canvas.fill(text_path("l", 100, 5, 100), glm::dvec3(1));
  EXPECT_NEAR(area(canvas.take()), 184.0 * 1556 / 2048 / 2048 * 1e4, 2.0);
  Canvas ring({80, 120});
  ring.fill(text_path("o", 100, 5, 100), glm::dvec3(1));
  const Layer layer = ring.take();
  EXPECT_EQ(alpha(layer, 5 + 30, 100 - 27), 0.0f);
  EXPECT_EQ(alpha(layer, 5 + 9, 100 - 27), 1.0f);
}

TEST(Letters, UnknownOnesAreQuestionMarks) {
  EXPECT_EQ(text_width("\xff", 10), text_width("?", 10));
  EXPECT_EQ(text_width("漢", 10), text_width("?", 10));
  EXPECT_EQ(text_width("\xe6\xbc", 10), text_width("??", 10)); // cut off
  EXPECT_GT(text_width("Å", 10), 5.0);
  EXPECT_NE(text_width("⁷", 100), text_width("?", 100));
}

View view() {
  Camera camera;
  camera.eye = {0, 0, 10};
  camera.target = {0, 0, 0};
  camera.up = {0, 1, 0};
  camera.fov_y = 60;
  return make_view(camera, {101, 101}, 10.0);
}

TEST(CellLines, FallOnTheirPixelsAndHideBehindDepth) {
  CellOutline cell{{-1, -1, -1}, glm::dmat3(2.0), {1, 0, 0}, 2.0};
  const View v = view();
  Canvas open({101, 101});
  draw_cell(open, cell, v, {});
  const Layer all = open.take();
  // the front face lies at depth 9: half a side of 1 is focal / 9 pixels
  const double side = v.focal / 9.0;
  const auto right = static_cast<std::uint32_t>(50.5 + side);
  EXPECT_GT(alpha(all, right, 50), 0.9f);
  EXPECT_EQ(alpha(all, right + 4, 50), 0.0f);
  EXPECT_EQ(alpha(all, 50, 50), 0.0f);
  std::vector<float> depth(101 * 101, 10.0f); // a wall in the middle: the back face is hidden
  Canvas hidden({101, 101});
  draw_cell(hidden, cell, v, depth);
  const Layer front = hidden.take();
  EXPECT_GT(alpha(front, right, 50), 0.9f);
  const auto back = static_cast<std::uint32_t>(50.5 + v.focal / 11.0);
  EXPECT_GT(alpha(all, back, 50), 0.9f);
  EXPECT_EQ(alpha(front, back, 50), 0.0f);
}

TEST(CellLines, AroundTheEyeAndFarAway) {
  Canvas canvas({101, 101});
  draw_cell(canvas, {{-1e7, -1e7, -1e7}, glm::dmat3(2e7), {1, 0, 0}, 1.0}, view(), {});
  draw_cell(canvas, {{NAN, 0, 0}, glm::dmat3(1.0), {1, 0, 0}, 1.0}, view(), {});
  draw_cell(canvas, {{0, 0, 0}, glm::dmat3(0.0), {1, 0, 0}, 1.0}, view(), {});
  for (const glm::vec4& p : canvas.take().pixels) EXPECT_TRUE(p.a >= 0.0f && p.a <= 1.0f);
}

} // namespace
} // namespace mote::overlay
