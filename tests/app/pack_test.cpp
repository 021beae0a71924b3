// SPDX-License-Identifier: MIT
// `mote info` and `mote render` without a flag on every particle file of the reference pack, and on every scene and graph that
// is shipped. Raw numbers have no heading: those are refused with a word on how to describe them.
#include "run_mote.hpp"

#include "core/image/png.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace mote::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path pack = fs::path(MOTE_SOURCE_DIR).parent_path() / "shared/data";
const fs::path scenes = fs::path(MOTE_SOURCE_DIR) / "app/scenes";

bool is_raw(const fs::path& file) {
  const std::string folder = file.parent_path().filename().string(), extension = file.extension().string();
  return folder == "nbody" || folder == "porenetwork" || extension == ".xyzd" || extension == ".nfo";
}

std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file()) out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

// Does the picture show something other than its corner?
bool shows_something(const PngPicture& picture) {
  for (std::size_t i = 4; i < picture.rgba8.size(); i += 4)
    if (!std::equal(picture.rgba8.begin(), picture.rgba8.begin() + 3, picture.rgba8.begin() + static_cast<std::ptrdiff_t>(i))) return true;
  return false;
}

class EveryFile : public CommandTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(EveryFile, IsDescribedAndDrawn) {
  if (!fs::exists(pack)) GTEST_SKIP() << "NOT TESTED: the reference pack is missing";
  int drawn = 0;
  for (const fs::path& file : files_of(pack / GetParam())) {
    if (is_raw(file)) continue;
    SCOPED_TRACE(file.filename().string());
    const Ran info = mote("info '" + file.string() + "' --json");
    ASSERT_EQ(info.exit, 0) << info.err;
    const nlohmann::json said = nlohmann::json::parse(info.out);
    EXPECT_GT(said["count"].get<std::uint64_t>(), 0u);
    EXPECT_GT(said["frames"].get<std::uint64_t>(), 0u);
    const Ran ran = mote("render '" + file.string() + "' -o picture.png --size 96x54");
    ASSERT_EQ(ran.exit, 0) << ran.err;
    EXPECT_THAT(ran.err, ::testing::Not(HasSubstr("error")));
    EXPECT_TRUE(shows_something(read_png((folder / "picture.png").string())));
    ++drawn;
  }
  EXPECT_GE(drawn, 3);
}
INSTANTIATE_TEST_SUITE_P(Pack, EveryFile, ::testing::Values("flow", "magnetic", "md", "mesh", "protein", "sph"), [](const auto& tested) { return tested.param; });

class Shipped : public CommandTest {};

TEST_F(Shipped, RawNumbersSayHowToDescribeThem) {
  if (!fs::exists(pack)) GTEST_SKIP() << "NOT TESTED: the reference pack is missing";
  const Ran ran = mote("info '" + (pack / "nbody/galaxy_20K.bin").string() + "'");
  EXPECT_EQ(ran.exit, 3);
  EXPECT_THAT(ran.err, HasSubstr("mote_raw = 1"));
  // The example of docs/formats.md.
  std::ifstream page(fs::path(MOTE_SOURCE_DIR) / "docs/formats.md");
  std::string text((std::istreambuf_iterator<char>(page)), {});
  text = text.substr(text.find("mote_raw = 1\nbox"));
  text = text.substr(0, text.find("```"));
  text.replace(text.find("galaxy_20K.bin"), 14, (pack / "nbody/galaxy_20K.bin").string());
  write("galaxy.toml", text);
  const Ran info = mote("info galaxy.toml");
  EXPECT_EQ(info.exit, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("20000 particles"));
  const Ran picture = mote("render galaxy.toml -o galaxy.png --size 96x54");
  EXPECT_EQ(picture.exit, 0) << picture.err;
}

TEST_F(Shipped, EverySceneIsDrawnAsTheReferenceSays) {
  int drawn = 0;
  for (const fs::path& file : files_of(scenes)) {
    std::ifstream in(file);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    if (file.extension() != ".toml" || text.find("[[data]]") == std::string::npos) continue; // a graph
    if (file.stem() == "stack") continue; // blends in the opaque pass, which the reference does not; TheStackOfStates has its answer
    SCOPED_TRACE(file.filename().string());
    const Ran ran = mote("render '" + file.string() + "' -o a.exr --size 160x90");
    ASSERT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    std::string other = "--reference '" + file.string() + "'";
    if (text.find("particle_types") != std::string::npos) { // the reference does not know types from folders: another expansion does
      other = "b.exr";
      ASSERT_EQ(mote("render '" + file.string() + "' -o b.exr --size 160x90 --expansion geometry").exit, 0);
    }
    const Ran equal = mote("compare a.exr " + other + " --limits " + (other == "b.exr" ? "rms=0.5" : "id=0"));
    EXPECT_EQ(equal.exit, 0) << equal.out << equal.err;
    ++drawn;
  }
  EXPECT_GE(drawn, 4);
}

TEST_F(Shipped, TheGallerysOwnTypesAreDrawnAsTheReferenceSays) {
  const std::string gallery = gallery_without({"torus"});
  ASSERT_EQ(mote("render '" + gallery + "' -o a.exr --size 160x90").exit, 0);
  const Ran equal = mote("compare a.exr --reference '" + gallery + "' --limits id=0");
  EXPECT_EQ(equal.exit, 0) << equal.out << equal.err;
}

TEST_F(Shipped, EveryGraphIsSoundAndDraws) {
  int drawn = 0;
  for (const fs::path& file : files_of(fs::path(MOTE_SOURCE_DIR) / "app/graphs")) {
    const std::string name = file.stem().string();
    SCOPED_TRACE(name);
    EXPECT_THAT(mote("graph " + name + " --check").out, HasSubstr("no errors"));
    const Ran ran = mote("render spheres:1e3:fit --graph " + name + " -o " + name + ".png --size 160x90");
    ASSERT_EQ(ran.exit, 0) << ran.err;
    EXPECT_TRUE(shows_something(read_png((folder / (name + ".png")).string())));
    std::ifstream page(fs::path(MOTE_SOURCE_DIR) / "docs/graph-file.md");
    const std::string text((std::istreambuf_iterator<char>(page)), {});
    EXPECT_THAT(text, HasSubstr("| `" + name + "` |")) << "docs/graph-file.md lists every shipped graph";
    ++drawn;
  }
  EXPECT_GE(drawn, 6);
}

// The stack of the scene: .5 .5 0 with a depth test, .5 .25 .25 in the order of the file. Middle of the picture, scene-linear,
// a step of 8-bit apart from exact.
TEST_F(Shipped, TheStackOfStates) {
  const auto middle = [&](const std::string& settings) {
    const Ran ran = mote("render '" + (scenes / "stack.toml").string() + "' -o s.png --view Raw --size 101x101 " + settings);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    const PngPicture p = read_png((folder / "s.png").string());
    const std::size_t at = (50 * 101 + 50) * 4;
    return std::vector<int>{p.rgba8[at], p.rgba8[at + 1], p.rgba8[at + 2]};
  };
  EXPECT_THAT(middle(""), ::testing::ElementsAre(::testing::AnyOf(127, 128), ::testing::AnyOf(127, 128), 0));
  EXPECT_THAT(middle("--set variables.depth_test=always --set variables.depth_write=false"),
              ::testing::ElementsAre(::testing::AnyOf(127, 128), ::testing::AnyOf(63, 64), ::testing::AnyOf(63, 64)));
}

// Sprites where they can be right and quads elsewhere: the same bits, for each of the three faults of sprites.
TEST_F(Shipped, TheSpritesOfThePointExpansion) {
  const std::string draw = "render '" + (scenes / "sprites.toml").string() + "' --size 1280x720 --edges sampled ";
  for (const char* by : {"point", "vertex"}) {
    const std::string name(by);
    const Ran ran = mote(draw + "--expansion " + name + " -o " + name + ".png --aov id=" + name + "_id.npy --aov depth=" + name + "_depth.npy --aov normal=" + name + "_normal.npy");
    ASSERT_EQ(ran.exit, 0) << ran.err;
  }
  EXPECT_EQ(read_png((folder / "point.png").string()).rgba8, read_png((folder / "vertex.png").string()).rgba8);
  for (const char* aov : {"_id.npy", "_depth.npy", "_normal.npy"}) EXPECT_EQ(read("point" + std::string(aov)), read("vertex" + std::string(aov))) << aov;
}

// Panels are the picture, bit for bit: also with a shadow map, which is fitted to the whole picture.
TEST_F(Shipped, ThePosterInPanels) {
  const std::string draw = "render '" + (scenes / "poster.toml").string() + "' --size 320x180 --samples 1 ";
  for (const auto& [name, panel] : {std::pair("whole", ""), std::pair("panels", " --panel 75")}) {
    const std::string n(name);
    const Ran ran = mote(draw + "-o " + n + ".png --aov id=" + n + "_id.npy --aov depth=" + n + "_depth.npy" + panel);
    ASSERT_EQ(ran.exit, 0) << ran.err;
  }
  EXPECT_EQ(read_png((folder / "panels.png").string()).rgba8, read_png((folder / "whole.png").string()).rgba8);
  for (const char* aov : {"_id.npy", "_depth.npy"}) EXPECT_EQ(read("panels" + std::string(aov)), read("whole" + std::string(aov))) << aov;
  const Ran lit = mote(draw + "-o lit.png --graph default"); // the shadows are there at all
  ASSERT_EQ(lit.exit, 0) << lit.err;
  EXPECT_NE(read_png((folder / "lit.png").string()).rgba8, read_png((folder / "whole.png").string()).rgba8);
}

TEST_F(Shipped, VariablesOfSmooth) {
  const auto pixels = [&](const std::string& settings) {
    const Ran ran = mote("render spheres:1e3:fit --graph smooth -o s.png --size 96x54 " + settings);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return read_png((folder / "s.png").string()).rgba8;
  };
  const auto four = pixels("--set variables.samples=4"), poisson = pixels("--set variables.samples=4 --set variables.pattern=poisson");
  EXPECT_NE(four, poisson);
  const Ran ran = mote("render spheres:1e3:fit --graph smooth --set variables.samples=5 -o s.png");
  EXPECT_NE(ran.exit, 0);
  EXPECT_THAT(ran.err, HasSubstr("P007"));
}

// What a pass did is known in closed form: four vertices and two triangles a particle, and nothing interpolated.
TEST_F(Shipped, StatsCountTheWork) {
  const Ran ran = mote("bench spheres:1e3:fit --expansion vertex --stats --json --frames 1 --size 160x90");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const nlohmann::json passes = nlohmann::json::parse(ran.out)["passes"];
  const nlohmann::json& counts = passes[0]["counts"];
  EXPECT_EQ(counts["vertices"].get<int>() % 6, 0);
  EXPECT_GE(counts["vertices"].get<int>(), 6000);
  EXPECT_EQ(counts["primitives"].get<int>() * 3, counts["vertices"].get<int>());
  EXPECT_LE(counts["clipping_primitives"].get<int>(), 2000);
  EXPECT_GT(counts["fragment_invocations"].get<int>(), 1000);
  EXPECT_EQ(counts["interpolated_components"], 0);
  EXPECT_GT(counts["flat_components"].get<int>(), 4 * counts["fragment_invocations"].get<int>());
  EXPECT_GE(passes[1]["counts"]["fragment_invocations"].get<int>(), 160 * 90);
  const Ran text = mote("render spheres:1e3:fit --expansion compute --stats -o a.png --size 160x90");
  EXPECT_EQ(text.exit, 0) << text.err;
  EXPECT_THAT(text.err, ::testing::AllOf(HasSubstr("opaque\n"), HasSubstr("kernels are not counted")));
}

// Opacity by an attribute, through the map, into one order and into exact lists.
TEST_F(Shipped, OpacityByAttributeIsDrawnAsTheReferenceSays) {
  write("a.csv", "x,y,z,radius,density\n0,0,0,1,0\n0.4,2.5,0.3,1,1\n-0.3,5,-0.2,1,2\n0.2,-2.5,0.1,1,4\n");
  write("s.toml", "schema = 1\nlegend = false\n[camera]\neye = [4, 18, 5]\ntarget = [0, 1, 0]\n[[data]]\nfile = \"a.csv\"\ncolor = \"#3366cc\"\n"
                  "alpha = { attribute = \"density\", to = [0.1, 1.0] }\n");
  for (const char* order : {"order=back_to_front", "order=front_to_back", "oit=exact"}) {
    const Ran ran = mote(std::string("render s.toml -o a.exr --size 160x90 --set glyphs.") + order);
    ASSERT_EQ(ran.exit, 0) << ran.err;
    const Ran equal = mote("compare a.exr --reference s.toml --limits id=0,rms=0.5");
    EXPECT_EQ(equal.exit, 0) << order << equal.out << equal.err;
  }
}

} // namespace
} // namespace mote::test
