// SPDX-License-Identifier: MIT
// Color maps out of files: one of each kind, and what is wrong with others.
#include "core/scene/colormap_files.hpp"

#include <gmock/gmock.h>

namespace mote {
namespace {

using testing::HasSubstr;

TEST(ColorMapFiles, TablesOfNumbers) {
  std::string long_table = "r,g,b\n";
  for (int i = 0; i < 100; ++i) long_table += std::to_string(i) + ",0,255\n";
  const ColorMapFile table = parse_color_map(long_table, "a.csv");
  ASSERT_EQ(table.entries.size(), 100u); // as it is
  EXPECT_EQ(table.entries[7], 0x0700ffu);
  const ColorMapFile points = parse_color_map("# two points\n0 0 0\n1.0 0.5 0\n", "a.txt");
  ASSERT_EQ(points.entries.size(), 256u); // blended
  EXPECT_EQ(points.entries[0], 0x000000u);
  EXPECT_EQ(points.entries[255], 0xff8000u);
  EXPECT_EQ(points.entries[51], 0x331a00u); // a fifth of the way
}

TEST(ColorMapFiles, PositionsAndAlpha) {
  const ColorMapFile placed = parse_color_map("0;0;0;0\n0.25;1;1;1\n1;1;1;1\n", "a.csv");
  EXPECT_EQ(placed.entries[32], 0x808080u); // 32/255 of the way is half of the first quarter
  EXPECT_EQ(placed.entries[64], 0xffffffu);
  const ColorMapFile alpha = parse_color_map("0 0 0 1\n1 1 1 1\n", "a.txt"); // the last column is the same everywhere
  EXPECT_EQ(alpha.entries[255], 0xffffffu);
}

TEST(ColorMapFiles, HexWords) {
  EXPECT_EQ(parse_color_map("#ff0000\n#00ff00\n", "a.hex").entries, (std::vector<std::uint32_t>{0xff0000, 0x00ff00}));
}

TEST(ColorMapFiles, GimpPalette) {
  const ColorMapFile map = parse_color_map("GIMP Palette\nName: x\nColumns: 2\n#\n255   0   0 a red\n  0 128   0\n", "a.gpl");
  EXPECT_TRUE(map.categories);
  EXPECT_EQ(map.entries, (std::vector<std::uint32_t>{0xff0000, 0x008000}));
}

TEST(ColorMapFiles, Gmt) {
  const ColorMapFile map = parse_color_map("# COLOR_MODEL = RGB\n-1 0 0 255 0 255 255 255\n0 255/255/255 1 255/0/0 ; warm\nB 1 2 3\nF 4 5 6\nN 7 8 9\n", "a.cpt");
  EXPECT_EQ(map.entries[0], 0x0000ffu);
  EXPECT_EQ(map.entries[255], 0xff0000u);
  EXPECT_EQ(map.below, 0x010203u);
  EXPECT_EQ(map.above, 0x040506u);
  EXPECT_EQ(map.nan, 0x070809u);
}

TEST(ColorMapFiles, ParaView) {
  const ColorMapFile json = parse_color_map("[{\"ColorSpace\": \"RGB\", \"Name\": \"x\", \"NanColor\": [1, 0, 0],\n \"RGBPoints\": [-1, 0, 0, 1,\n 1, 1, 1, 0]}]", "a.json");
  EXPECT_EQ(json.entries[0], 0x0000ffu);
  EXPECT_EQ(json.entries[255], 0xffff00u);
  EXPECT_EQ(json.nan, 0xff0000u);
  const ColorMapFile xml = parse_color_map("<ColorMaps><ColorMap name=\"x\"><Point x=\"0\" o=\"1\" r=\"0\" g=\"0\" b=\"1\"/><Point x=\"2\" o=\"1\" r=\"1\" g=\"1\" b=\"0\"/></ColorMap></ColorMaps>", "a.xml");
  EXPECT_EQ(xml.entries, json.entries);
}

TEST(ColorMapFiles, WhatIsNone) {
  const auto refused = [](const std::string& text, const std::string& name, const std::string& words) {
    try {
      (void)parse_color_map(text, name);
      ADD_FAILURE() << "not refused: " << words;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.diagnostic().code, "S029");
      EXPECT_THAT(failure.what(), HasSubstr(words));
    }
  };
  refused("", "a.csv", "not two colors");
  refused("1 2 3\n", "a.csv", "not two colors");
  refused("0 0 0\n0 0\n", "a.csv", "a.csv:2: error S029: a line of 2 numbers");
  refused("0 0 0\nred 0 0\n", "a.csv", "is no color");
  refused("0 0 0\n1 1 1 1\n", "a.csv", "lines of 3 and of 4");
  refused("[{\"Name\": \"x\"}]", "a.json", "RGBPoints");
  refused("<ColorMap><Point x=\"0\" r=\"1\"/></ColorMap>", "a.xml", "lacks x, r, g or b");
  refused("0 1 2 3\n", "a.cpt", "z r g b z r g b");
  EXPECT_THROW((void)read_color_map("no/such.csv", {"s.toml", 3, 4}), Failure);
}

} // namespace
} // namespace mote
