// SPDX-License-Identifier: MIT
#include "core/scene/colormaps.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace mote {
namespace {

ColorMap map_named(std::string_view name) {
  ColorMap map;
  EXPECT_TRUE(find_color_map(name, map)) << name;
  return map;
}

TEST(ColorMaps, EndsAndMiddle) {
  const ColorMap viridis = map_named("viridis");
  EXPECT_EQ(viridis.at(0.0), 0x440154u);
  EXPECT_EQ(viridis.at(1.0), 0xfde725u);
  EXPECT_EQ(viridis.at(-5.0), 0x440154u);
  EXPECT_EQ(viridis.at(1e300), 0xfde725u);
  EXPECT_EQ(map_named("viridis_r").at(0.0), 0xfde725u);
  EXPECT_EQ(map_named("batlow").at(0.0), 0x011959u); // (0.0052, 0.0982, 0.3498)
  EXPECT_EQ(map_named("gray").at(0.5), 0x808080u);
  EXPECT_EQ(map_named("tab10").category(12), map_named("tab10").category(2));
  EXPECT_EQ(map_named("tab10").category(-1), map_named("tab10").category(9));
  ColorMap none;
  EXPECT_FALSE(find_color_map("jet", none));
}

TEST(ColorMaps, AllNamesAreThere) {
  EXPECT_THAT(color_map_names(), testing::UnorderedElementsAre("viridis", "plasma", "inferno", "magma", "cividis", "turbo",
                                                               "coolwarm", "twilight", "RdBu", "tab10", "gray", "batlow"));
  for (const ColorMap& map : color_maps()) EXPECT_FALSE(map.license.empty());
}

// Every entry against the published tables, where they are at hand.
TEST(ColorMaps, EntriesEqualThePublishedTables) {
  const std::filesystem::path folder = std::filesystem::path(MOTE_SOURCE_DIR) / "../shared/data/colormaps";
  if (!std::filesystem::exists(folder / "viridis.csv")) GTEST_SKIP() << "the published tables are not at hand: " << folder;
  for (const ColorMap& map : color_maps()) {
    if (map.name == "batlow") continue; // not among them
    std::ifstream file(folder / (std::string(map.name) + ".csv"));
    std::string line;
    std::size_t i = 0;
    while (std::getline(file, line)) {
      if (line.starts_with('#')) continue;
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream numbers(line);
      for (int shift : {16, 8, 0}) {
        double value = 0;
        numbers >> value;
        ASSERT_NEAR((map.entries[i] >> shift & 0xFFu) / 255.0, value, 0.5 / 255 + 1e-6) << map.name << " " << i;
      }
      ++i;
    }
    EXPECT_EQ(i, map.entries.size()) << map.name;
  }
}

} // namespace
} // namespace mote
