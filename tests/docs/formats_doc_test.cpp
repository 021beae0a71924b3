// SPDX-License-Identifier: MIT
// docs/formats.md has a row for every format that is read, and no other; positions-only formats and endings are named.
#include "core/data/source.hpp"
#include "core/scene/colormaps.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <set>
#include <sstream>

namespace {

using testing::HasSubstr;

std::string read(const std::string& name) { return (std::ostringstream() << std::ifstream(MOTE_SOURCE_DIR "/docs/" + name).rdbuf()).str(); }

// Words of the first cells of the first table.
std::set<std::string> first_column(const std::string& document) {
  std::set<std::string> words;
  std::istringstream lines(document.substr(document.find("| format |")));
  std::string line;
  for (int number = 0; std::getline(lines, line) && line.starts_with('|'); ++number) {
    if (number < 2) continue; // the head
    std::string cell = line.substr(1, line.find('|', 1) - 1);
    std::replace(cell.begin(), cell.end(), ',', ' ');
    std::istringstream split(cell);
    for (std::string word; split >> word;) words.insert(word);
  }
  return words;
}

TEST(FormatsDoc, HasARowForEveryFormat) {
  std::set<std::string> formats;
  for (const mote::data::Format& format : mote::data::formats()) formats.emplace(format.name);
  EXPECT_EQ(first_column(read("formats.md")), formats);
}

TEST(FormatsDoc, NamesTheFormatsThatNeedATopology) {
  const std::string document = read("formats.md");
  for (const mote::data::Format& format : mote::data::formats())
    if (format.positions_only) {
      EXPECT_THAT(document, HasSubstr("`" + std::string(format.name) + "`"));
    }
}

TEST(ScenesDoc, NamesEveryColorMap) {
  const std::string document = read("particles.md");
  for (const mote::ColorMap& map : mote::color_maps()) EXPECT_THAT(document, HasSubstr("`" + std::string(map.name) + "`"));
}

} // namespace
