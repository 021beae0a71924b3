// SPDX-License-Identifier: MIT
// docs/course.md: every command runs, every scene of the course and every picture is in it, and trace-pixel agrees with the
// pictures that are drawn.
#include "run_mote.hpp"

#include "core/image/exr.hpp"
#include "core/image/png.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace mote::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string document() { return (std::ostringstream() << std::ifstream(MOTE_SOURCE_DIR "/docs/course.md").rdbuf()).str(); }

class Course : public CommandTest {
protected:
  [[nodiscard]] Ran in_source(const std::string& words) const { return shell("cd '" MOTE_SOURCE_DIR "' && \"$MOTE\" " + words); }
};

TEST_F(Course, EveryCommandRuns) {
  const std::string text = document();
  const std::regex command("`mote ((?:render|trace-pixel|chart) [^`]*)`");
  std::set<std::string> pictures;
  int ran = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), command), end; it != end; ++it) {
    std::string words = (*it)[1];
    if (words.starts_with("chart") || words.find("SCENE") != std::string::npos) continue;
    if (words.starts_with("render")) {
      words = std::regex_replace(words, std::regex(" -o ([a-z_]+\\.png)"), " --size 48x32 -o '" + folder.string() + "/$1'");
      std::smatch name;
      ASSERT_TRUE(std::regex_search(words, name, std::regex("/([a-z_]+\\.png)'"))) << words;
      EXPECT_TRUE(pictures.insert(name[1]).second) << name[1] << " is made twice";
      const Ran done = in_source(words);
      EXPECT_EQ(done.exit, 0) << words << "\n" << done.err;
      EXPECT_EQ(done.err, "") << words;
      ASSERT_TRUE(exists(name[1])) << words;
      EXPECT_EQ(read_png((folder / name[1].str()).string()).width, 48u);
    } else {
      EXPECT_EQ(in_source(words).exit, 0) << words;
    }
    ++ran;
  }
  EXPECT_GE(ran, 30);
}

TEST_F(Course, EveryStepIsAnotherPicture) {
  std::set<std::string> pictures;
  for (const char* step : {"proxy", "discard", "shade", "depth", "quadratic", "points"}) {
    ASSERT_EQ(in_source(fmt::format("render app/scenes/course/spheres.toml --size 96x64 --samples 1 --set opaque.steps={0} -o '{1}/{0}.png'", step, folder.string())).exit, 0) << step;
    const auto pixels = read_png((folder / (std::string(step) + ".png")).string());
    pictures.insert(std::string(pixels.rgba8.begin(), pixels.rgba8.end()));
  }
  EXPECT_GE(pictures.size(), 5u) << "so near, the quadratic formula is right to the last step";
}

TEST_F(Course, EverySceneAndPictureIsInTheDocument) {
  const std::string text = document();
  for (const auto& file : std::filesystem::directory_iterator(MOTE_SOURCE_DIR "/app/scenes/course"))
    if (file.path().extension() == ".toml") {
      EXPECT_THAT(text, HasSubstr("app/scenes/course/" + file.path().filename().string()));
    }
  const std::regex image("\\]\\((images/course_[a-z]+\\.png)\\)");
  int images = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), image), end; it != end; ++it, ++images)
    EXPECT_TRUE(std::filesystem::exists(MOTE_SOURCE_DIR "/docs/" + (*it)[1].str())) << (*it)[1];
  EXPECT_GE(images, 10);
}

class TracePixel : public Course {
protected:
  // The scene-linear picture and the trace of some pixels of it agree within half floats.
  void compare(const std::string& scene, const std::string& options, const std::vector<std::pair<int, int>>& pixels, int least_fragments) {
    const std::string size = " --size 160x120 ";
    const Ran drawn = in_source("render " + scene + size + options + " -o '" + (folder / "p.exr").string() + "'");
    ASSERT_EQ(drawn.exit, 0) << drawn.err;
    const ExrPicture picture = read_exr((folder / "p.exr").string());
    int fragments = 0;
    for (const auto& [x, y] : pixels) {
      const Ran ran = in_source(fmt::format("trace-pixel {} {} {}{}{} --json", scene, x, y, size, options));
      ASSERT_EQ(ran.exit, 0) << ran.err;
      const json trace = json::parse(ran.out);
      const std::size_t at = static_cast<std::size_t>(y) * 160 + static_cast<std::size_t>(x);
      for (std::size_t k = 0; k < 3; ++k) {
        const ExrChannel* channel = picture.find(std::string(1, "RGB"[k]));
        ASSERT_TRUE(channel);
        EXPECT_NEAR(trace["linear"][k].get<double>(), static_cast<double>(channel->floats[at]), 2e-3) << scene << " " << options << " " << x << "," << y;
      }
      for (const json& pass : trace["passes"]) fragments += static_cast<int>(pass["fragments"].size());
    }
    EXPECT_GE(fragments, least_fragments) << scene;
  }
};

const std::vector<std::pair<int, int>> spread{{80, 60}, {70, 58}, {60, 64}, {95, 62}, {40, 50}, {110, 70}, {5, 5}, {84, 48}, {52, 76}};

TEST_F(TracePixel, EqualsThePicture) {
  compare("app/scenes/course/spheres.toml", "", spread, 5);
  compare("app/scenes/course/cylinders.toml", "", spread, 3);
  compare("app/scenes/stack.toml", "", spread, 10);
  compare("app/scenes/stack.toml", "--set variables.depth_test=always --set variables.depth_write=false", spread, 10);
  compare("app/scenes/course/glass.toml", "--set glyphs.order=file", spread, 6);
  compare("app/scenes/course/glass.toml", "", {{80, 60}, {60, 64}, {100, 62}}, 4);
  compare("app/scenes/course/glass.toml", "--set glyphs.oit=exact", spread, 6);
  compare("app/scenes/course/glass.toml", "--set glyphs.surfaces=front", spread, 3);
  compare("app/scenes/course/acne.toml", "", spread, 5);
  compare(gallery_without({"torus", "density"}), "", spread, 9);
  compare("app/scenes/transforms.toml", "", spread, 2);
  compare("app/scenes/packing.toml", "--set legend=false", spread, 9);
  compare("app/scenes/course/phong.toml", "", spread, 1); // orthographic
}

// The script's example, (0.8, 0, 0.1), and where the particle's center comes to lie.
TEST_F(TracePixel, TwoLayersNumberByNumber) {
  const Ran ran = in_source("trace-pixel app/scenes/course/layers.toml 440 360 --json");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json trace = json::parse(ran.out);
  const json& pass = trace["passes"][0];
  ASSERT_EQ(pass["fragments"].size(), 2u);
  EXPECT_EQ(pass["particles"].size(), 2u);
  const json& second = pass["fragments"][1];
  EXPECT_TRUE(second["passes"]);
  EXPECT_NEAR(second["after"][0].get<double>(), 0.8, 1e-12);
  EXPECT_NEAR(second["after"][2].get<double>(), 0.1, 1e-12);
  EXPECT_EQ(trace["display"]["rgba8"].size(), 4u);
  const json& red = pass["particles"][1];
  EXPECT_EQ(red["world"], json({-1.2, -0.2, 3.0}));
  EXPECT_NEAR(red["eye"][2].get<double>(), 7.0, 1e-12);
  EXPECT_NEAR(red["window"][0].get<double>(), 640 - 1.2 * 240, 1e-9) << "720 rows show 3 units";
  EXPECT_NEAR(red["window"][1].get<double>(), 360 + 0.2 * 240, 1e-9) << "rows run down";
  const Ran text = in_source("trace-pixel app/scenes/course/layers.toml 440 360");
  for (const char* words : {"object  ", "world   ", "eye     ", "clip    ", "ndc     ", "window  ", "depth test, nothing there: passes", "(0.8, 0, 0.1, 1)"}) EXPECT_THAT(text.out, HasSubstr(words));
}

TEST_F(TracePixel, WhatItCannotFollow) {
  const Ran weighted = in_source("trace-pixel app/scenes/course/glass.toml 80 60 --size 160x120 --set glyphs.oit=weighted");
  EXPECT_EQ(weighted.exit, 1);
  EXPECT_THAT(weighted.err, HasSubstr("error A060: pass 'glyphs' draws with oit = \"weighted\""));
  EXPECT_THAT(in_source("trace-pixel app/scenes/course/spheres.toml 80 60 --set opaque.steps=shade").err, HasSubstr("A060"));
  write("smoke.csv", "x,y,z\n0,0,0\n");
  write("smoke.toml", "schema = 1\ngraph = \"transparent\"\n[[data]]\nfile = \"smoke.csv\"\ndensity = 2.0\n");
  EXPECT_THAT(mote("trace-pixel smoke.toml 80 60 --size 160x120").err, HasSubstr("A060: pass 'glyphs' draws with a density"));
  const Ran outside = in_source("trace-pixel app/scenes/course/glass.toml 160 60 --size 160x120");
  EXPECT_EQ(outside.exit, 2);
  EXPECT_THAT(outside.err, HasSubstr("'160' is not a column of the picture: 0 to 159"));
  EXPECT_EQ(in_source("trace-pixel app/scenes/course/glass.toml").exit, 2);
}

} // namespace
} // namespace mote::test
