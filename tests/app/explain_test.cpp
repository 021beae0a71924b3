// SPDX-License-Identifier: MIT
// What auto chooses at the command line, explain's account of it, and the costs that calibrate keeps.
#include "run_mote.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace mote::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using nlohmann::json;

class Explain : public CommandTest {};

const json* pass_named(const json& explained, const std::string& name) {
  for (const json& pass : explained["passes"])
    if (pass["name"] == name) return &pass;
  return nullptr;
}

TEST_F(Explain, OnePictureOfFewParticlesStaysOnVertices) {
  const Ran ran = mote("explain spheres:1e3:fit --size 320x180 --json");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json explained = json::parse(ran.out);
  const json* opaque = pass_named(explained, "opaque");
  ASSERT_TRUE(opaque);
  EXPECT_EQ((*opaque)["expansion"], "vertex");
  ASSERT_EQ((*opaque)["candidates"].size(), 3u);
  EXPECT_GT((*opaque)["candidates"][2]["with_once_ms"], (*opaque)["candidates"][2]["frame_ms"]);
  EXPECT_EQ((*opaque)["in_view"]["particles"], 1000);
  EXPECT_GT(explained["median_ms"], 0.0);
  EXPECT_THAT(explained["costs"], HasSubstr("shipped"));
  EXPECT_FALSE(pass_named(explained, "display")->contains("skipped"));
}

TEST_F(Explain, ManyParticlesOrManyFramesTakeTiles) {
  const Ran many = mote("explain spheres:1e6:fit --size 320x180 --json");
  ASSERT_EQ(many.exit, 0) << many.err;
  const json explained = json::parse(many.out);
  EXPECT_EQ((*pass_named(explained, "opaque"))["expansion"], "compute");
  EXPECT_GT((*pass_named(explained, "opaque"))["chunks"]["tiled"], 1000);
  EXPECT_THAT((*pass_named(explained, "display"))["skipped"], HasSubstr("'opaque' did its work"));
  const Ran text = mote("explain spheres:1e5:fill --size 320x180 --frames 1000");
  EXPECT_EQ(text.exit, 0) << text.err;
  for (const char* words : {"expansion compute: ", "predicted", "layers deep", "left out of this frame: 'opaque' did its work", "measured: "}) EXPECT_THAT(text.out, HasSubstr(words));
  const Ran bench = mote("bench spheres:1e5:fill --size 320x180 --frames 20 --json");
  EXPECT_EQ(json::parse(bench.out)["expansion"], "compute") << "bench reports what was really used";
}

// Nothing is left to the rasterizer, whether the centers are wanted besides or not (no AOVs here).
TEST_F(Explain, SamplesAndEdgesAreDrawnByTilesAlone) {
  for (const char* words : {"--expansion compute --set opaque.samples=4", "--expansion compute --set opaque.edges=analytic", "--set opaque.edges=analytic"}) {
    const Ran ran = mote(std::string("explain spheres:1e4:fit --size 96x54 --json ") + words);
    ASSERT_EQ(ran.exit, 0) << ran.err;
    const json explained = json::parse(ran.out);
    const json& opaque = *pass_named(explained, "opaque");
    EXPECT_EQ(opaque["expansion"], "compute") << words;
    EXPECT_GT(opaque["chunks"]["tiled"], 100) << words;
    EXPECT_EQ(opaque["chunks"]["drawn"], 0) << words;
  }
}

TEST_F(Explain, WhatTilesCannotIsNoCandidate) {
  write("points.csv", "x,y,z,opacity\n0,0,0,1\n1,0,0,1\n");
  write("scene.toml", "schema = 1\n[[data]]\nfile = \"points.csv\"\nmaterial = { model = \"phong\", specular = 0.5 }\n"
                      "[[data]]\nfile = \"points.csv\"\nmaterial = { model = \"blinn_phong\", specular = 0.5 }\n");
  const Ran ran = mote("explain scene.toml --size 64x64 --frames 1000");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("this scene has Phong and Blinn-Phong materials"));
  EXPECT_THAT(ran.out, Not(HasSubstr("expansion compute: ")));
  const Ran asked = mote("render scene.toml --size 64x64 --expansion compute -o x.png");
  EXPECT_EQ(asked.exit, 1);
  EXPECT_THAT(asked.err, HasSubstr("error P001: expansion 'compute' draws with one specular model a pass"));
  EXPECT_FALSE(exists("x.png"));
}

TEST_F(Explain, CalibrateKeepsWhatItMeasured) {
  const Ran ran = mote("calibrate --json");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json costs = json::parse(ran.out);
  for (const char* name : {"vertex", "compute"}) EXPECT_GT(costs["expansions"][name]["pixel_ns"].get<double>() + costs["expansions"][name]["unit_ns"].get<double>(), 0.0);
  std::string kept;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "cache" / "mote"))
    if (entry.path().filename().string().starts_with("costs-")) kept = "cache/mote/" + entry.path().filename().string();
  ASSERT_NE(kept, "");
  EXPECT_EQ(json::parse(read(kept)), costs);
  EXPECT_THAT(mote("explain spheres:1e3:fit --size 64x36").out, HasSubstr("costs:  measured by mote calibrate"));
}

TEST_F(Explain, CalibrateWithoutAPlaceForItsFile) {
  const Ran ran = mote("calibrate", "XDG_CACHE_HOME= HOME=");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_THAT(ran.err, HasSubstr("error A041: there is no folder for caches"));
}

TEST_F(Explain, MeasuredCostsDecideAndABadFileIsAWarning) {
  ASSERT_EQ(mote("render spheres:1e3:fit --size 64x36 -o x.png").exit, 0);
  std::string key; // device and driver, as in the name of the pipeline cache
  for (const auto& entry : std::filesystem::directory_iterator(folder / "cache" / "mote"))
    if (const std::string name = entry.path().stem().string(); name.starts_with("pipelines-")) key = name.substr(10);
  ASSERT_NE(key, "");
  const std::string file = "cache/mote/costs-" + key + ".json";
  json costs{{"version", 1}, {"device_uuid", key.substr(0, key.rfind('-'))}, {"aov_ns", 1}};
  for (const char* name : {"vertex", "geometry", "compute"})
    costs["expansions"][name] = {{"fixed_ms", 1000}, {"particle_ns", 1}, {"unit_ns", 1}, {"pixel_ns", 1}, {"pipeline_ms", 0}};
  costs["expansions"]["compute"]["fixed_ms"] = 1;
  write(file, costs.dump());
  const Ran ran = mote("explain spheres:1e3:fit --size 64x36");
  EXPECT_THAT(ran.out, HasSubstr("costs:  measured by mote calibrate")) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("expansion compute: "));
  const auto expect_warning = [&](const std::string& text, const std::string& words) {
    write(file, text);
    const Ran drawn = mote("render spheres:1e3:fit --size 64x36 -o x.png");
    EXPECT_EQ(drawn.exit, 0);
    EXPECT_THAT(drawn.err, HasSubstr("warning A040: the measured costs of the device cannot be read"));
    EXPECT_THAT(drawn.err, HasSubstr(words));
  };
  expect_warning("{", "parse error");
  expect_warning("{}", "version");
  expect_warning("[]", "array");
  json bad = costs;
  bad["expansions"]["compute"]["unit_ns"] = -1;
  expect_warning(bad.dump(), "unit_ns is -1");
  bad = costs;
  bad["device_uuid"] = "00";
  expect_warning(bad.dump(), "another device");
}

TEST_F(Explain, BenchTurnsAndCuts) {
  for (const char* words : {"--turn 2", "--cut", "--turn -1.5 --cut"}) {
    const Ran ran = mote(std::string("bench crystal:1000 --size 64x36 --frames 2 --json ") + words);
    ASSERT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(json::parse(ran.out)["primitives"], 1000);
  }
  EXPECT_EQ(mote("render dust:1e3 --size 64x36 -o d.png").exit, 0);
  EXPECT_EQ(mote("render slab:1e3:fill --size 64x36 -o s.png").exit, 0);
}

} // namespace
} // namespace mote::test
