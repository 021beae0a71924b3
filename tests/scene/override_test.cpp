// SPDX-License-Identifier: MIT
#include "core/toml/node.hpp"

#include <gmock/gmock.h>

namespace mote::config {
namespace {

using testing::HasSubstr;

constexpr std::string_view text = R"(
a = 1
[camera]
fov_y = 30.0
[[light]]
name = "sun"
intensity = 1.0
[[light]]
name = "lamp"
)";

Node overridden(std::string_view assignment) {
  Node root = parse(text, "f.toml", "S002");
  apply_override(root, assignment, "S017");
  return root;
}

TEST(Override, ReachesKeysItemsAndNames) {
  EXPECT_EQ(overridden("a=2").find("a")->integer, 2);
  EXPECT_EQ(overridden("camera.fov_y=40").find("camera")->find("fov_y")->real, 40.0);
  EXPECT_EQ(overridden("light[0].intensity=2").find("light")->items[0].find("intensity")->real, 2.0);
  EXPECT_EQ(overridden("light.lamp.intensity=3").find("light")->items[1].find("intensity")->real, 3.0);
  EXPECT_EQ(overridden("new.table.key=4").find("new")->find("table")->find("key")->real, 4.0);
  EXPECT_EQ(overridden("a=[1, 2]").find("a")->items.size(), 2u);
}

TEST(Override, WordsNeedNoQuotes) {
  EXPECT_EQ(overridden("background=#000").find("background")->text, "#000");
  EXPECT_EQ(overridden("graph=default").find("graph")->text, "default");
  EXPECT_EQ(overridden("graph=\"default\"").find("graph")->text, "default");
  EXPECT_EQ(overridden("tolerance=0.5px").find("tolerance")->text, "0.5px");
}

TEST(Override, CarriesThePlaceOfTheCommandLine) {
  EXPECT_EQ(overridden("camera.fov_y=40").find("camera")->find("fov_y")->loc.file, "--set");
  EXPECT_EQ(overridden("a=[1, 2]").find("a")->items[1].loc.file, "--set");
}

void expect_refused(std::string_view assignment, std::string_view words) {
  try {
    overridden(assignment);
    FAIL() << assignment << " was accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "S017");
    EXPECT_EQ(failure.exit(), Exit::Usage);
    EXPECT_THAT(failure.what(), HasSubstr(std::string(words)));
    EXPECT_THAT(failure.what(), HasSubstr("--set: error"));
  }
}

TEST(Override, PathsThatLeadNowhereAreRefused) {
  expect_refused("a", "there is no '='");
  expect_refused("=3", "a key is missing");
  expect_refused("camera.=3", "a key is missing");
  expect_refused("a.b=3", "a is an integer and has nothing inside");
  expect_refused("light[2].intensity=3", "light has 2 entries");
  expect_refused("light[x].intensity=3", "is not an index");
  expect_refused("light[1=3", "is not an index");
  expect_refused("light.moon.intensity=3", "names: sun, lamp");
  expect_refused("camera[0]=3", "has nothing inside");
}

TEST(Toml, PlacesAreKept) {
  const Node root = parse(text, "f.toml", "S002");
  EXPECT_EQ(root.find("camera")->find("fov_y")->loc, (SourceLoc{"f.toml", 4, 9}));
  EXPECT_EQ(root.find("light")->items[1].members[0].loc, (SourceLoc{"f.toml", 9, 1}));
}

TEST(Toml, SyntaxErrorsHaveAPlace) {
  try {
    parse("a = 1\nb = = 2\n", "f.toml", "S002");
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "S002");
    EXPECT_EQ(failure.diagnostic().loc.line, 2u);
    EXPECT_EQ(failure.exit(), Exit::BadInput);
  }
}

} // namespace
} // namespace mote::config
