// SPDX-License-Identifier: MIT
// Scenes over time: which frame is drawn, and what must be the same in all pictures of a series.
#include "tests/scene/realize_fixture.hpp"

#include <fmt/format.h>

namespace mote {
namespace {

using testing::HasSubstr;

class SeriesScene : public Realize {
protected:
  void SetUp() override {
    Realize::SetUp();
    std::string text;
    for (int k = 0; k < 5; ++k) // two particles: one rests, one goes along x; s is 0..4 and 10..14
      text += fmt::format("2\nProperties=pos:R:3:s:R:1:name:S:1 Time={}\n0 0 0 {} {}\n{} 0 0 {} b\n", 0.5 * k, k, k == 0 ? "b" : "a", 1 + k, 10 + k);
    write("t.xyz", text);
  }
};

TEST_F(SeriesScene, FramesByIndex) {
  const auto x_of = [&](const Scene& s) { return s.batches.at(0).chunks->center(place(s, 1)).x; };
  EXPECT_EQ(x_of(scene("t.xyz")), 1.0);
  EXPECT_EQ(x_of(scene_at(3, "t.xyz")), 4.0);
  EXPECT_EQ(x_of(scene("t.xyz", "", "frame = -1")), 5.0);
  (void)scene_at(5, "t.xyz");
  EXPECT_TRUE(diagnostics.has("D017"));
  EXPECT_THAT(printed(), HasSubstr("there are 5 frames (0 to 4"));
}

TEST_F(SeriesScene, RangesCamerasAndRadiiAreThoseOfTheSeries) {
  const std::string color = "color = { attribute = \"s\" }";
  const Scene first = scene_at(0, "t.xyz", color), last = scene_at(4, "t.xyz", color);
  EXPECT_EQ(first.annotations.keys.at(0), last.annotations.keys.at(0));
  EXPECT_EQ(first.annotations.keys.at(0).low, 0.0);
  EXPECT_EQ(first.annotations.keys.at(0).high, 14.0);
  EXPECT_EQ(first.camera.eye, last.camera.eye);
  EXPECT_EQ(radius(first, 0), 0.5f);
  EXPECT_EQ(radius(last, 0), 0.5f); // though the neighbors are far by then
  EXPECT_NEAR(last.bounds.max.x, 5.5, 1e-9);
  EXPECT_EQ(last.annotations.time, "t = 2");
  const Scene alone = scene("t.xyz", color); // the first frame without its series
  EXPECT_EQ(alone.annotations.keys.at(0).high, 10.0);
  EXPECT_EQ(alone.annotations.time, "");
  const Scene own = scene_at(4, "t.xyz", "color = { attribute = \"s\", range = \"frame\" }");
  EXPECT_EQ(own.annotations.keys.at(0).low, 4.0);
}

TEST_F(SeriesScene, WordsKeepTheirColors) {
  const std::string color = "color = { attribute = \"name\", map = \"tab10\" }";
  const Scene first = scene_at(0, "t.xyz", color), last = scene_at(4, "t.xyz", color);
  EXPECT_EQ(rgb(first, 1), rgb(last, 1)); // b, whichever word the frame has first
  EXPECT_NE(rgb(first, 0), rgb(last, 0));
}

TEST_F(SeriesScene, StaticDataStandsBesideTheSeries) {
  write("still.csv", "x,y,z\n9,9,9\n");
  const Scene s = scene_at(4, "t.xyz", "[[data]]\nfile = \"still.csv\"");
  EXPECT_FALSE(diagnostics.has_errors()) << printed();
  EXPECT_EQ(s.batches.size(), 2u);
  EXPECT_NEAR(s.bounds.max.y, 9.5, 1e-9);
}

TEST_F(SeriesScene, ListsPatternsAndPairs) {
  for (int k = 0; k < 12; ++k) write(fmt::format("f_{}.csv", k), fmt::format("x,y,z\n{},0,0\n{},0,1\n", k, k));
  const auto x_of = [&](const Scene& s) { return s.batches.at(0).chunks->center(0).x; };
  EXPECT_EQ(x_of(scene_at(10, "f_*.csv")), 10.0);
  diagnostics = {};
  const SceneDesc list = parse_scene("schema = 1\nframe = 1\n[[data]]\nfile = [\"f_3.csv\", \"f_7.csv\"]\n", "s.toml", folder, {}, diagnostics);
  EXPECT_EQ(x_of(realize(list, {64, 36}, diagnostics)), 7.0);
  (void)scene("g_*.csv");
  EXPECT_TRUE(diagnostics.has("D025")) << printed();
  const std::vector<std::string> words{"a.gro", "b.xtc", "c.xtc", "d.xyz", "e.dcd", "f.csv"};
  const SceneDesc pairs = describe(words, {}, diagnostics);
  ASSERT_EQ(pairs.data.size(), 3u);
  EXPECT_EQ(pairs.data[0].trajectory.size(), 2u);
  EXPECT_EQ(pairs.data[1].trajectory.at(0), "e.dcd");
  EXPECT_TRUE(pairs.data[2].trajectory.empty());
}

TEST(SpreadFrames, BothEndsAreAmongThem) {
  EXPECT_EQ(spread_frames(3, 8), (std::vector<std::uint64_t>{0, 1, 2}));
  const std::vector<std::uint64_t> some = spread_frames(1000, 8);
  EXPECT_EQ(some.size(), 8u);
  EXPECT_EQ(some.front(), 0u);
  EXPECT_EQ(some.back(), 999u);
}

// A scene whose data sets were moved is the one that realize() makes of the moved description, to the bit.
TEST_F(SeriesScene, PlacedAgainIsRealizedAgain) {
  write("still.csv", "x,y,z\n9,9,9\n1,2,3\n");
  write("cell.xyz", "2\nLattice=\"4 0 0 0 5 0 0 0 6\" Properties=species:S:1:pos:R:3\nC 0 0 0\nO 1 1 1\n");
  const auto text = [](const std::string& first, const std::string& second) {
    return "schema = 1\n[[data]]\nfile = \"t.xyz\"\n" + first + "[[data]]\nfile = \"still.csv\"\n[[data]]\nfile = \"cell.xyz\"\nreplicas = [2, 1, 1]\ncell = true\n" + second;
  };
  for (const std::optional<std::uint64_t> index : {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(0), std::optional<std::uint64_t>(3)}) {
    const SceneDesc before = parse_scene(text("", "transform = [ { scale = 2 } ]\n"), "s.toml", folder, {}, diagnostics);
    const SceneDesc after = parse_scene(text("transform = [ { rotate = { axis = [0, 1, 1], angle = 33 } }, { translate = [0.1, 7, 0] } ]\n", ""), "s.toml", folder, {}, diagnostics);
    SceneSource old_source(before), new_source(after);
    for (SceneSource* source : {&old_source, &new_source}) EXPECT_EQ(source->frame_count(diagnostics), 5u); // as a job asks before it names a frame
    Scene scene = realize(before, {64, 48}, old_source, index, diagnostics);
    const Scene wanted = realize(after, {64, 48}, new_source, index, diagnostics);
    ASSERT_FALSE(diagnostics.has_errors()) << printed();
    const ChunkSet* particles = scene.batches.at(2).chunks.get();
    ASSERT_TRUE(place_again(scene, after, old_source, index, diagnostics)) << printed();
    EXPECT_EQ(scene.batches[2].chunks.get(), particles) << "no particle is read again";
    ASSERT_EQ(scene.batches.size(), wanted.batches.size());
    for (std::size_t b = 0; b < wanted.batches.size(); ++b) {
      ASSERT_EQ(scene.batches[b].instances.size(), wanted.batches[b].instances.size());
      EXPECT_EQ(scene.batches[b].data, b);
      for (std::size_t k = 0; k < wanted.batches[b].instances.size(); ++k) EXPECT_EQ(scene.batches[b].instances[k].world_from_data, wanted.batches[b].instances[k].world_from_data);
    }
    EXPECT_EQ(scene.bounds.min, wanted.bounds.min);
    EXPECT_EQ(scene.bounds.max, wanted.bounds.max);
    ASSERT_EQ(scene.annotations.cells.size(), 1u);
    EXPECT_EQ(scene.annotations.cells[0].corner, wanted.annotations.cells[0].corner);
    EXPECT_EQ(scene.annotations.cells[0].edges, wanted.annotations.cells[0].edges);
  }
}

} // namespace
} // namespace mote
