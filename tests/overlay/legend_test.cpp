// SPDX-License-Identifier: MIT
// Legends on pictures: their colors are those of the map after the view transform, they fit pictures of any size, and
// they keep what lies under them where they are not.
#include "core/color/srgb.hpp"
#include "core/image/png.hpp"
#include "core/overlay/annotate.hpp"
#include "core/scene/colormaps.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <set>

namespace mote::overlay {
namespace {

Scene scene_with_key(bool logarithmic = false) {
  Scene scene;
  scene.camera.eye = {0, 0, 10};
  scene.camera.up = {0, 1, 0};
  ColorMap map;
  (void)find_color_map("viridis", map);
  ColorKey key{"speed", "A/ps", logarithmic ? 0.01 : 0.0, 12.5, logarithmic, {map.entries.begin(), map.entries.end()}, {}, {}, {}, {}};
  key.nan = 0xff00ff;
  scene.annotations.keys.push_back(key);
  scene.annotations.scale_bar = true;
  scene.annotations.length_unit = "A";
  scene.annotations.time = "t = 12.5 ps";
  return scene;
}

std::vector<std::uint8_t> picture_of(const Scene& scene, Size2d size, const char* view_transform, std::uint8_t gray = 255) {
  const View view = make_view(scene.camera, size, 10.0);
  std::vector<std::uint8_t> rgba(std::size_t{size.width} * size.height * 4, gray);
  for (std::size_t i = 3; i < rgba.size(); i += 4) rgba[i] = 255;
  const ColorConfig config = ColorConfig::load("");
  lay_over_display(draw_annotations(scene, view, {}), make_display_transform(config, {.view = view_transform}), std::span<std::uint8_t>(rgba));
  if (const char* folder = std::getenv("MOTE_KEEP_PICTURES"))
    write_png(std::string(folder) + "/legend_" + std::to_string(size.width) + view_transform + ".png", size.width, size.height, std::span<const std::uint8_t>(rgba));
  return rgba;
}

std::set<std::uint32_t> colors_of(const std::vector<std::uint8_t>& rgba) {
  std::set<std::uint32_t> out;
  for (std::size_t i = 0; i < rgba.size(); i += 4) out.insert(std::uint32_t{rgba[i]} << 16 | std::uint32_t{rgba[i + 1]} << 8 | rgba[i + 2]);
  return out;
}

TEST(Legend, ShowsTheColorsOfTheMap) {
  const Scene scene = scene_with_key();
  const std::set<std::uint32_t> found = colors_of(picture_of(scene, {1280, 720}, "Un-tone-mapped"));
  int there = 0;
  for (const std::uint32_t color : scene.annotations.keys[0].colors) there += found.contains(color) ? 1 : 0;
  EXPECT_GE(there, 250); // a row of pixels for every color
  EXPECT_TRUE(found.contains(0xff00ffu));
  EXPECT_TRUE(found.contains(0x000000u)); // letters
}

TEST(Legend, GoesThroughTheViewTransform) {
  const Scene scene = scene_with_key();
  const std::set<std::uint32_t> found = colors_of(picture_of(scene, {1280, 720}, "ACES SDR"));
  const std::uint32_t last = scene.annotations.keys[0].colors.back();
  std::vector<float> wanted{0, 0, 0, 1};
  for (std::size_t k = 0; k < 3; ++k) wanted[k] = static_cast<float>(srgb_decode((last >> (16 - 8 * k) & 255u) / 255.0));
  make_display_transform(ColorConfig::load(""), {.view = "ACES SDR"}).apply(wanted);
  const std::uint32_t displayed = std::uint32_t{to_8bit(wanted[0])} << 16 | std::uint32_t{to_8bit(wanted[1])} << 8 | to_8bit(wanted[2]);
  EXPECT_NE(displayed, last);
  EXPECT_TRUE(found.contains(displayed));
}

TEST(Legend, FitsEveryPicture) {
  for (const Size2d size : {Size2d{16, 9}, Size2d{1, 1}, Size2d{320, 180}, Size2d{90, 1600}, Size2d{1920, 1080}, Size2d{3000, 40}})
    for (const bool logarithmic : {false, true}) {
      Scene scene = scene_with_key(logarithmic);
      scene.annotations.keys.push_back({"kind", "", 0, 1, false, {0xff0000, 0x00ff00}, {"oxygen", "hydrogen"}, {}, {}, {}});
      (void)picture_of(scene, size, "Raw");
    }
}

TEST(Legend, LeavesTheRestAlone) {
  Scene scene = scene_with_key();
  scene.background = glm::dvec4(0, 0, 0, 1);
  const std::vector<std::uint8_t> rgba = picture_of(scene, {640, 360}, "Un-tone-mapped", 77);
  for (std::uint32_t y = 120; y < 240; ++y)
    for (std::uint32_t x = 0; x < 400; ++x) ASSERT_EQ(rgba[4 * (y * 640 + x)], 77);
  EXPECT_TRUE(colors_of(rgba).contains(0xffffffu)); // light letters on a dark background
}

TEST(Legend, OverLinearAndTransparentPictures) {
  Layer layer{{2, 1}, {glm::vec4(0.25f, 0, 0, 0.5f), glm::vec4(0)}};
  std::vector<float> clear{0, 0, 0, 0, 9, 8, 7, 0.5f};
  lay_over_linear(layer, std::span<float>(clear));
  EXPECT_THAT(clear, testing::ElementsAre(0.5f, 0, 0, 0.5f, 9, 8, 7, 0.5f));
  std::vector<glm::dvec4> solid{{0, 1, 0, 1}, {0, 1, 0, 1}};
  lay_over_linear(layer, std::span<glm::dvec4>(solid));
  EXPECT_NEAR(solid[0].r, 0.25, 1e-7);
  EXPECT_NEAR(solid[0].g, 0.5, 1e-7);
  EXPECT_EQ(solid[1], glm::dvec4(0, 1, 0, 1));
}

} // namespace
} // namespace mote::overlay
