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

// Words of the cells of a column of the first table; commas count as blanks.
std::set<std::string> words_of_column(const std::string& document, int column) {
  std::set<std::string> words;
  std::istringstream lines(document.substr(document.find("| format |")));
  std::string line;
  for (int number = 0; std::getline(lines, line) && line.starts_with('|'); ++number) {
    if (number < 2) continue; // the head
    for (int k = 0; k < column; ++k) line.erase(0, line.find('|', 1));
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
  EXPECT_EQ(words_of_column(read("formats.md"), 0), formats);
}

TEST(FormatsDoc, NamesEveryEnding) {
  std::set<std::string> endings;
  for (const mote::data::Format& format : mote::data::formats()) {
    std::istringstream split{std::string(format.extensions)};
    for (std::string word; split >> word;) endings.insert(word);
  }
  EXPECT_EQ(words_of_column(read("formats.md"), 1), endings);
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
