// SPDX-License-Identifier: MIT
// Values changed in the text of a scene: only they change, and where that cannot be, nothing does.
#include "core/toml/patch.hpp"

#include <gmock/gmock.h>

namespace mote::config {
namespace {

using ::testing::HasSubstr;

constexpr const char* scene = R"(# my scene
schema = 1
background = "#ffffff"   # white

[camera] # from the front
eye = [1.0, 2.0,   # µ x y
       3.0]
target = [0, 0, 0]

[[light]]
name = "sun"
intensity = 0.8 # bright
# the end of the sun

[[light]]
name = 'back'
direction = [0, 1, 0]

[[data]]
file = "a # b.npy"
material = { model = "phong", specular = 0.25 }
color = { attribute = "speed", map = "viridis" } # fast
radius.attribute = "r"
)";

std::string patch(std::string_view path, std::string_view value, std::string_view text = scene) { return patched(text, path, value, "A053"); }
// The text with one piece replaced, which must be there once.
std::string with(std::string_view from, std::string_view to) {
  std::string text = scene;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  EXPECT_EQ(text.find(from, at + 1), std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST(Patch, ReplacesValuesInPlace) {
  EXPECT_EQ(patch("background", "#000000"), with("\"#ffffff\"", "\"#000000\""));
  EXPECT_EQ(patch("light.sun.intensity", "1.5"), with("0.8 #", "1.5 #"));
  EXPECT_EQ(patch("light[1].direction", "[1.0, 0.0, 0.0]"), with("[0, 1, 0]", "[1.0, 0.0, 0.0]"));
  EXPECT_EQ(patch("camera.eye", "[4, 5, 6]"), with("[1.0, 2.0,   # µ x y\n       3.0]", "[4, 5, 6]"));
  EXPECT_EQ(patch("data[0].material.specular", "0.5"), with("0.25", "0.5"));
  EXPECT_EQ(patch("data[0].color.map", "plasma"), with("\"viridis\"", "\"plasma\""));
  EXPECT_EQ(patch("data[0].color", "\"#ff0000\""), with("{ attribute = \"speed\", map = \"viridis\" }", "\"#ff0000\""));
  EXPECT_EQ(patch("data[0].file", "c \"d\".npy"), with("\"a # b.npy\"", "\"c \\\"d\\\".npy\""));
  EXPECT_EQ(patch("data[0].radius.attribute", "mass"), with("\"r\"", "\"mass\""));
}

TEST(Patch, AddsKeysToTheirTables) {
  EXPECT_EQ(patch("camera.fov_y", "40"), with("target = [0, 0, 0]\n", "target = [0, 0, 0]\nfov_y = 40\n"));
  EXPECT_EQ(patch("light.sun.shadows", "true"), with("0.8 # bright\n", "0.8 # bright\nshadows = true\n"));
  EXPECT_EQ(patch("data[0].material.exponent", "60"), with("0.25 }", "0.25, exponent = 60 }"));
  EXPECT_EQ(patch("data[0].alpha", "0.5"), std::string(scene) + "alpha = 0.5\n");
  EXPECT_EQ(patch("data[0].radius.map", "linear"), std::string(scene) + "radius.map = \"linear\"\n");
  EXPECT_EQ(patch("frame", "3"), with("# white\n", "# white\nframe = 3\n"));
  EXPECT_EQ(patch("ambient.intensity", "0.3"), std::string(scene) + "\n[ambient]\nintensity = 0.3\n");
  EXPECT_EQ(patch("frame", "3", ""), "frame = 3\n");
  EXPECT_EQ(patch("a.b", "{ c = 1 }", "[a]"), "[a]\nb = { c = 1 }");
  EXPECT_EQ(patch("a.b", "1", "a = {}"), "a = { b = 1 }");
  EXPECT_EQ(patch("a.x", "1", "[a.b]\nc = 1\n[a]\n\n[d]\n"), "[a.b]\nc = 1\n[a]\nx = 1\n\n[d]\n");
}

TEST(Patch, WhatCannotBeWrittenIsRefused) {
  for (const auto& [path, says] : std::vector<std::pair<std::string, std::string>>{
           {"camera", "several lines"}, {"light.moon.intensity", "'moon' is not there"}, {"background.x", "is not there"}, {"data[4].alpha", "'4' is not there"}}) {
    try {
      (void)patch(path, "1");
      ADD_FAILURE() << path;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.diagnostic().code, "A053");
      EXPECT_THAT(failure.what(), HasSubstr(says));
    }
  }
  EXPECT_THROW((void)patch("a", "1", "a = = 2"), Failure);
}

TEST(Patch, AppendsToLists) {
  const auto append = [](std::string_view text, std::string_view path, std::string_view values) { return appended(text, path, values, "A053"); };
  const std::string head = "[[data]]\nfile = \"a\" # a\n";
  EXPECT_EQ(append(head, "data[0].transform", "{ scale = 2 }"), "[[data]]\nfile = \"a\" # a\ntransform = [ { scale = 2 } ]\n") << "made where there is none";
  EXPECT_EQ(append(head + "transform = [] # none\n", "data[0].transform", "{ scale = 2 }"), head + "transform = [ { scale = 2 } ] # none\n");
  const std::string two = head + "transform = [\n  { scale = 2 }, # twice\n  { translate = [1, 0, 0] } # to the right ]\n] # end\n";
  EXPECT_EQ(append(two, "data[0].transform", "{ scale = 3 }, { scale = 4 }"),
            head + "transform = [\n  { scale = 2 }, # twice\n  { translate = [1, 0, 0] }, { scale = 3 }, { scale = 4 } # to the right ]\n] # end\n");
  EXPECT_EQ(append(head + "transform = [ { scale = 2 }, ]\n", "data[0].transform", "{ scale = 3 }"), head + "transform = [ { scale = 2 }, { scale = 3 }, ]\n");
  for (const auto& [path, values] : {std::pair("data[0].file", "1"), std::pair("data[1].transform", "1"), std::pair("data", "{ file = \"b\" }"), std::pair("data[0].transform", "{ scale")})
    EXPECT_THROW((void)append(head, path, values), Failure) << path;
}

TEST(Patch, ReadsWhatIsWritten) {
  EXPECT_EQ(written_value(scene, "light.sun.intensity", "A053"), "0.8");
  EXPECT_EQ(written_value(scene, "data[0].color", "A053"), "{ attribute = \"speed\", map = \"viridis\" }");
  EXPECT_EQ(written_value(scene, "camera.fov_y", "A053"), std::nullopt);
}

TEST(Patch, ManyChangesLeaveCommentsAlone) {
  std::string text = scene;
  for (int i = 0; i < 50; ++i) {
    text = patch("light.sun.intensity", std::to_string(i) + ".5", text);
    text = patch("camera.up", "[0, 0, 1]", text);
    text = patch("data[0].transform", "[{ translate = [" + std::to_string(i) + ", 0, 0] }]", text);
  }
  for (const char* comment : {"# my scene", "# white", "# from the front", "# bright", "# the end of the sun", "# fast"}) EXPECT_THAT(text, HasSubstr(comment));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), std::count(scene, scene + std::string_view(scene).size(), '\n') + 2);
}

} // namespace
} // namespace mote::config
