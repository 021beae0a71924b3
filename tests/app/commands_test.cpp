// SPDX-License-Identifier: MIT
// What the commands do when all is well.
#include "run_mote.hpp"

#include "core/image/exr.hpp"
#include "core/image/npy.hpp"
#include "core/image/png.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace mote::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using nlohmann::json;

class Commands : public CommandTest {
protected:
  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
};

TEST_F(Commands, HelpAndVersion) {
  const Ran help = mote("--help");
  EXPECT_EQ(help.exit, 0);
  for (const char* command : {"render", "view", "info", "bench", "compare", "graph", "check", "formats", "colormaps"})
    EXPECT_THAT(help.out, HasSubstr(command));
  EXPECT_EQ(mote("render --help").exit, 0);
  EXPECT_THAT(mote("--version").out, HasSubstr("mote 0.1.0"));
  EXPECT_EQ(mote("").exit, 2);
}

TEST_F(Commands, Lists) {
  EXPECT_THAT(mote("formats").out, HasSubstr("xyz"));
  EXPECT_THAT(mote("colormaps").out, HasSubstr("viridis"));
  EXPECT_THAT(mote("views").out, HasSubstr("Un-tone-mapped  (default)"));
}

TEST_F(Commands, PictureAndAovs) {
  const Ran ran = mote("render spheres:1e3:fit -o out.png --size 160x90 --aov depth=z.npy --aov id=id.npy --aov normal=n.npy");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
  const PngPicture png = read_png(path("out.png"));
  EXPECT_EQ(png.width, 160u);
  EXPECT_EQ(png.height, 90u);
  EXPECT_EQ(png.rgba8[0], 255); // white corner
  const NpyArray z = read_npy(path("z.npy")), id = read_npy(path("id.npy")), n = read_npy(path("n.npy"));
  EXPECT_EQ(z.type, "<f4");
  EXPECT_THAT(z.shape, ::testing::ElementsAre(90u, 160u));
  EXPECT_EQ(id.type, "<u4");
  EXPECT_THAT(n.shape, ::testing::ElementsAre(90u, 160u, 3u));
  const auto ids = id.values<std::uint32_t>();
  const auto depths = z.values<float>();
  std::size_t hits = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ASSERT_EQ(ids[i] != 0xFFFFFFFFu, std::isfinite(depths[i]));
    hits += ids[i] != 0xFFFFFFFFu;
  }
  EXPECT_GT(hits, ids.size() / 10);
  bool source = false;
  for (const auto& [key, value] : png.text) source = source || (key == "Source" && value == "spheres:1e3:fit");
  EXPECT_TRUE(source);
}

TEST_F(Commands, TheReferenceAgrees) {
  ASSERT_EQ(mote("render spheres:1e3:fill -o gpu.exr --size 160x90 --aov depth=z.npy --aov id=id.npy --aov normal=n.npy").exit, 0);
  const Ran same = mote("compare gpu.exr --reference spheres:1e3:fill --limits id=0,rms=1 --json");
  EXPECT_EQ(same.exit, 0) << same.out << same.err;
  EXPECT_EQ(json::parse(same.out)["equal"], true);
  const Ran other = mote("compare gpu.exr --reference spheres:1e3:fill:seed=2 --limits id=0");
  EXPECT_EQ(other.exit, 1) << other.err;
  ASSERT_EQ(mote("render spheres:1e3:fill -o ref.png --reference --size 160x90 --aov id=ref_id.npy").exit, 0);
  EXPECT_EQ(mote("compare ref_id.npy --reference spheres:1e3:fill --limits id=0").exit, 0);
}

TEST_F(Commands, ExpansionsGiveTheSamePicture) {
  for (const char* name : {"vertex", "geometry"})
    ASSERT_EQ(mote(std::string("render spheres:1e3:inside --size 160x90 --expansion ") + name + " --aov id=" + name + ".npy -o " + name + ".png").exit, 0);
  EXPECT_EQ(read("vertex.npy"), read("geometry.npy"));
  EXPECT_EQ(mote("compare vertex.png geometry.png").exit, 0);
}

TEST_F(Commands, SettingsReachSceneAndGraph) {
  ASSERT_EQ(mote("render spheres:1e3:fit -o a.png --size 64x36 --set background=#000 --set display.exposure=-20").exit, 0);
  const PngPicture dark = read_png(path("a.png"));
  for (std::size_t i = 0; i < dark.rgba8.size(); ++i)
    if (i % 4 != 3) {
      ASSERT_EQ(dark.rgba8[i], 0);
    }
}

TEST_F(Commands, DeepTransparentAndLinearPictures) {
  ASSERT_EQ(mote("render spheres:1e3:fit -o deep.png --bits 16 --transparent --size 64x36").exit, 0);
  const PngPicture deep = read_png(path("deep.png"));
  ASSERT_EQ(deep.rgba16.size(), 64u * 36 * 4);
  EXPECT_TRUE(deep.has_alpha);
  EXPECT_EQ(deep.rgba16[3], 0);
  ASSERT_EQ(mote("render spheres:1e3:fit -o linear.exr --size 64x36 --aov id=id.npy").exit, 0);
  const ExrPicture exr = read_exr(path("linear.exr"));
  ASSERT_TRUE(exr.find("R") && exr.find("id"));
  EXPECT_EQ(exr.find("R")->floats[0], 1.0f); // background
  EXPECT_EQ(exr.find("id")->uints[0], 0xFFFFFFFFu);
}

TEST_F(Commands, PanelsGiveTheSameFiles) {
  const std::string what = "render spheres:1e3:inside --size 160x90 --aov depth=z.npy --aov id=id.npy --aov normal=n.npy --transparent -o ";
  ASSERT_EQ(mote(what + "a.exr").exit, 0);
  const std::string depth = read("z.npy"), id = read("id.npy"), normal = read("n.npy");
  ASSERT_EQ(mote(what + "b.exr --panel 48").exit, 0);
  EXPECT_EQ(read("z.npy"), depth);
  EXPECT_EQ(read("id.npy"), id);
  EXPECT_EQ(read("n.npy"), normal);
  EXPECT_EQ(read("a.exr"), read("b.exr"));
  ASSERT_EQ(mote("render spheres:1e3:fit --size 17000x2 -o wide.png").exit, 0) << "wider than a texture";
  EXPECT_EQ(read_png(path("wide.png")).width, 17000u);
}

TEST_F(Commands, StretchedSpheresAreEllipsoids) {
  write("ball.csv", "x,y,z,radius\n0,0,0,1\n");
  write("scene.toml", "schema = 1\n[camera]\nprojection = \"orthographic\"\nheight = 9.0\neye = [0, 0, 10]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n"
                      "[[data]]\nfile = \"ball.csv\"\ntransform = [ { scale = [4, 2, 1] }, { reflect = [1, 0, 0] } ]\n");
  ASSERT_EQ(mote("render scene.toml --size 90x90 -o a.exr").exit, 0);
  const Ran ran = mote("compare a.exr --reference scene.toml --limits id=0");
  EXPECT_EQ(ran.exit, 0) << ran.out << ran.err;
  const ExrPicture exr = read_exr(path("a.exr"));
  std::size_t hits = 0;
  for (const std::uint32_t id : exr.find("id")->uints) hits += id == 0;
  EXPECT_NEAR(static_cast<double>(hits), 3.14159265 * 40 * 20, 40.0); // an ellipse of 40 by 20 pixels
}

TEST_F(Commands, GraphFilesBuildOnShippedOnes) {
  write("mine.toml", "schema = 1\ninclude = \"default\"\nvariables = { stops = 0.0 }\n[[pass]]\nname = \"display\"\nparams = { exposure = \"$stops\" }\n");
  ASSERT_EQ(mote("render spheres:1e3:fit --graph mine.toml --size 64x36 -o a.png").exit, 0);
  ASSERT_EQ(mote("render spheres:1e3:fit --size 64x36 -o b.png").exit, 0);
  EXPECT_EQ(read_png(path("a.png")).rgba8, read_png(path("b.png")).rgba8);
  const Ran dark = mote("render spheres:1e3:fit --graph mine.toml --size 64x36 --set variables.stops=-20 -o a.png");
  ASSERT_EQ(dark.exit, 0) << dark.err;
  EXPECT_EQ(read_png(path("a.png")).rgba8[0], 0);
  const Ran wrong = mote("render spheres:1e3:fit --graph mine.toml --set variables.stop=1 -o a.png");
  EXPECT_NE(wrong.exit, 0);
  EXPECT_THAT(wrong.err, HasSubstr("G028"));
  EXPECT_THAT(mote("graph mine.toml --plan").out, HasSubstr("opaque"));
  const json schema = json::parse(mote("graph --schema").out);
  EXPECT_EQ(schema["definitions"]["pass"]["allOf"].size(), json::parse(mote("graph --kinds --json").out)["kinds"].size());
}

TEST_F(Commands, StandardOutputAndDumps) {
  const Ran ran = mote("render spheres:1e3:fit -o - --size 64x36 --dump opaque.depth=d.npy --dump opaque.color=c.exr");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.out.substr(1, 3), "PNG");
  EXPECT_THAT(read_npy(path("d.npy")).shape, ::testing::ElementsAre(36u, 64u));
  EXPECT_EQ(read_exr(path("c.exr")).channels.size(), 4u);
}

// Pictures to look at have analytic edges; EXR has the samples of the pixel centers.
TEST_F(Commands, SmoothOutlinesWhereOnlyThePictureIsWanted) {
  const auto pixels = [&](const std::string& words) {
    const Ran ran = mote("render spheres:1e3:fit --size 96x54 -o a.png " + words);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return read_png(path("a.png")).rgba8;
  };
  const auto sampled = pixels("--edges sampled"), smooth = pixels("--edges analytic");
  EXPECT_NE(sampled, smooth);
  EXPECT_EQ(pixels(""), smooth);
  EXPECT_EQ(pixels("--expansion compute"), smooth);
  const auto by_quads = pixels("--expansion vertex");
  EXPECT_NE(by_quads, smooth);
  EXPECT_EQ(pixels("--expansion geometry"), by_quads);
  EXPECT_EQ(pixels("--aov id=id.npy --aov depth=d.npy"), smooth) << "what else is asked for does not change the picture";
  const auto dumped = pixels("--dump opaque.color=c.npy"); // shown from half floats then
  int most = 0;
  for (std::size_t i = 0; i < smooth.size(); ++i) most = std::max(most, std::abs(int{dumped[i]} - int{smooth[i]}));
  EXPECT_LE(most, 1);
  for (const char* words : {"--samples 1", "--panel 48", "--set opaque.samples=1", "--set opaque.edges=sampled"})
    EXPECT_EQ(pixels(words), sampled) << words;
  EXPECT_NE(pixels("--samples 4"), sampled);
  EXPECT_EQ(pixels("--samples 4 --graph smooth"), pixels("--set variables.samples=4 --graph smooth"));
  EXPECT_EQ(mote("render spheres:1e3:fit -o a.png --samples 4 --edges analytic").exit, 2);
  const Ran five = mote("render spheres:1e3:fit -o a.png --samples 5");
  EXPECT_NE(five.exit, 0);
  EXPECT_THAT(five.err, HasSubstr("P007"));
  ASSERT_EQ(mote("render spheres:1e3:fit --size 96x54 -o a.exr").exit, 0);
  EXPECT_EQ(mote("compare a.exr --reference spheres:1e3:fit --limits id=0,rms=0.5").exit, 0);
}

TEST_F(Commands, EqualInputGivesEqualFiles) {
  ASSERT_EQ(mote("render spheres:1e3:fill -o a.png --size 160x90").exit, 0);
  ASSERT_EQ(mote("render spheres:1e3:fill -o b.png --size 160x90").exit, 0);
  EXPECT_EQ(read("a.png"), read("b.png"));
}

TEST_F(Commands, WithoutAHomeThereIsNoCacheAndNoError) {
  const Ran ran = shell("env -u HOME -u XDG_CACHE_HOME \"$MOTE\" render spheres:1e3:fit -o a.png --size 64x36");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
}

TEST_F(Commands, NoParticlesAreABackground) {
  write("none.xyz", "0\n\n");
  const Ran ran = mote("render none.xyz -o a.png --size 16x9");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(read_png(path("a.png")).rgba8[0], 255);
}

TEST_F(Commands, InfoHasTheContractedKeys) {
  write("a.xyz", "2\n\nO 0 0 0\nH 0.96 1 -2\n");
  const Ran ran = mote("info a.xyz --json");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json info = json::parse(ran.out);
  EXPECT_EQ(info["count"], 2);
  EXPECT_EQ(info["instances"], 1);
  EXPECT_EQ(info["frames"], 1);
  EXPECT_EQ(info["bounds"]["min"], json({0.0, 0.0, -2.0}));
  EXPECT_EQ(info["attributes"][0]["name"].is_string(), true);
  for (const json& attribute : info["attributes"])
    for (const char* key : {"name", "type", "components", "min", "max"}) EXPECT_TRUE(attribute.contains(key));
  EXPECT_THAT(mote("info a.xyz").out, HasSubstr("2 particles"));
}

TEST_F(Commands, BenchHasTheContractedKeys) {
  const Ran ran = mote("bench spheres:1e3:fill --frames 3 --size 160x90 --json");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json bench = json::parse(ran.out);
  for (const char* key : {"median_ms", "min_ms", "max_ms", "first_ms", "device", "expansion", "primitives", "passes"}) EXPECT_TRUE(bench.contains(key)) << key;
  EXPECT_EQ(bench["primitives"], 1000);
  ASSERT_EQ(bench["passes"].size(), 2u);
  for (const char* key : {"name", "gpu_ms", "cpu_ms"}) EXPECT_TRUE(bench["passes"][0].contains(key)) << key;
  for (const char* key : {"values_ms", "chunks_ms", "upload_ms"}) EXPECT_GT(bench["prepare"][key].get<double>(), 0.0) << key;
  EXPECT_GT(bench["memory"]["prepared_bytes"], 1'000'000u) << "of the whole process";
  EXPECT_GE(bench["memory"]["peak_bytes"], bench["memory"]["resident_bytes"]);
  EXPECT_GE(bench["max_ms"].get<double>(), bench["median_ms"].get<double>());
  EXPECT_GE(bench["median_ms"].get<double>(), bench["min_ms"].get<double>());
}

TEST_F(Commands, GraphsArePrinted) {
  EXPECT_THAT(mote("graph default --plan").out, HasSubstr("opaque"));
  EXPECT_THAT(mote("graph --dot").out, HasSubstr("digraph"));
  EXPECT_THAT(mote("graph --kinds").out, HasSubstr("opaque_impostors"));
  EXPECT_TRUE(json::parse(mote("graph --kinds --json").out).contains("kinds"));
  EXPECT_THAT(mote("graph default --check").out, HasSubstr("no errors"));
}

TEST_F(Commands, WhatIsAskedForAndNotDrawnIsSaid) {
  write("a.csv", "x,y,z\n0,0,0\n1,0,0\n");
  write("s.toml", "schema = 1\n[[light]]\nname = \"sun\"\nkind = \"directional\"\ndirection = [0, 0, -1]\nshadows = true\n[[data]]\nfile = \"a.csv\"\nalpha = 0.5\n");
  const Ran ran = mote("check s.toml --graph default");
  EXPECT_EQ(ran.exit, 0);
  EXPECT_THAT(ran.err, HasSubstr("warning A020"));
  EXPECT_THAT(ran.err, HasSubstr("warning A021"));
  EXPECT_THAT(ran.out, HasSubstr("no errors, 2 particles"));
  const Ran transparent = mote("check s.toml"); // takes the graph that draws them
  EXPECT_THAT(transparent.err, Not(HasSubstr("A020")));
  EXPECT_THAT(transparent.out, HasSubstr("graph 'transparent'"));
}

// A baked view transform says how far it is from the exact one; an exact one has nothing to say.
TEST_F(Commands, BakedViewTransformsSayTheirError) {
  const Ran baked = mote("render spheres:1e3:fit --size 64x36 --view \"ACES SDR\" -o a.png");
  EXPECT_EQ(baked.exit, 0);
  EXPECT_THAT(baked.err, HasSubstr("sRGB / ACES SDR, baked"));
  const Ran exact = mote("render spheres:1e3:fit --size 64x36 --view \"ACES SDR\" --exact -o a.png");
  EXPECT_EQ(exact.err, "");
}

TEST_F(Commands, SignalsEndWithTheirStatus) {
  EXPECT_EQ(shell("timeout --preserve-status -s INT 1 \"$MOTE\" bench spheres:1e5:fill --frames 100000").exit, 130);
  EXPECT_EQ(shell("timeout --preserve-status -s TERM 1 \"$MOTE\" bench spheres:1e5:fill --frames 100000").exit, 143);
}

} // namespace
} // namespace mote::test
