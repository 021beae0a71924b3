// SPDX-License-Identifier: MIT
// Scalars to colors, radii and opacities: ranges, scales, colors outside, kinds, selections, cells, styles.
#include "core/scene/colormaps.hpp"
#include "tests/scene/realize_fixture.hpp"

#include <cmath>

namespace mote {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Mapped : public Realize {
protected:
  void SetUp() override {
    Realize::SetUp();
    write("a.csv", "x,y,z,v,kind\n0,0,0,-2,c\n1,0,0,1,a\n2,0,0,100,b\n3,0,0,nan,a\n4,0,0,10,c\n");
  }
  std::uint32_t gray(const Scene& s, std::uint32_t row) { return rgb(s, row) & 0xFFu; }
  std::uint32_t alpha(const Scene& s, std::uint32_t row) { return s.batches.at(0).chunks->color_of(place(s, row)) >> 24; }
};

TEST_F(Mapped, RangesOfAllKinds) {
  const Scene all = scene("a.csv", "color = { attribute = \"v\", map = \"gray\" }");
  EXPECT_EQ(gray(all, 0), 0u);
  EXPECT_EQ(gray(all, 2), 255u);
  EXPECT_EQ(rgb(all, 3), not_a_number_color);
  EXPECT_TRUE(diagnostics.has("S033"));
  const Scene symmetric = scene("a.csv", "color = { attribute = \"v\", map = \"gray\", range = \"symmetric\" }");
  EXPECT_EQ(gray(symmetric, 0), 125u); // (-2 + 100) / 200 * 256
  ASSERT_EQ(symmetric.annotations.keys.size(), 1u);
  EXPECT_EQ(symmetric.annotations.keys[0].low, -100.0);
  const Scene percent = scene("a.csv", "color = { attribute = \"v\", map = \"gray\", range = { percentile = [0, 50] } }");
  EXPECT_EQ(percent.annotations.keys.at(0).high, 5.5); // the median of -2 1 10 100
  const Scene logarithmic = scene("a.csv", "color = { attribute = \"v\", map = \"gray\", scale = \"log\" }");
  EXPECT_EQ(gray(logarithmic, 4), 128u); // 10 lies in the middle of 1 to 100
  EXPECT_EQ(gray(logarithmic, 0), 0u);   // below 0: below the range
}

TEST_F(Mapped, ColorsOutside) {
  const Scene s = scene("a.csv", "color = { attribute = \"v\", map = \"gray\", range = [0, 50], below = \"#0000ff\", above = \"#ff0000\", nan = \"#00ff00\" }");
  EXPECT_EQ(rgb(s, 0), 0x0000ffu);
  EXPECT_EQ(rgb(s, 2), 0xff0000u);
  EXPECT_EQ(rgb(s, 3), 0x00ff00u);
  const ColorKey& key = s.annotations.keys.at(0);
  EXPECT_EQ(key.below, 0x0000ffu);
  EXPECT_EQ(key.nan, 0x00ff00u);
  EXPECT_EQ(key.title, "v");
  EXPECT_EQ(key.colors.size(), 256u);
}

TEST_F(Mapped, KindsInTurnOrWithColorsOfTheirOwn) {
  const Scene turn = scene("a.csv", "color = { attribute = \"kind\", map = \"tab10\", title = \"Kind\" }");
  ColorMap tab10;
  ASSERT_TRUE(find_color_map("tab10", tab10));
  EXPECT_EQ(rgb(turn, 0), tab10.entries[0]); // c came first
  EXPECT_EQ(rgb(turn, 1), tab10.entries[1]);
  EXPECT_THAT(turn.annotations.keys.at(0).names, ElementsAre("c", "a", "b"));
  EXPECT_EQ(turn.annotations.keys.at(0).title, "Kind");
  const Scene own = scene("a.csv", "color = { attribute = \"kind\", colors = { a = \"#112233\", c = \"#445566\" } }");
  EXPECT_EQ(rgb(own, 1), 0x112233u);
  EXPECT_EQ(rgb(own, 0), 0x445566u);
}

TEST_F(Mapped, MapsOutOfFiles) {
  write("map.csv", "0 0 0\n255 0 0\n");
  EXPECT_EQ(rgb(scene("a.csv", "color = { attribute = \"v\", map = \"map.csv\", range = [0, 100] }"), 2), 0xff0000u);
  EXPECT_EQ(rgb(scene("a.csv", "color = { attribute = \"v\", map = \"map.csv_r\", range = [0, 100] }"), 2), 0x000000u);
  (void)scene("a.csv", "color = { attribute = \"v\", map = \"./nothing.csv\" }");
  EXPECT_TRUE(diagnostics.has("S029")) << printed();
}

TEST_F(Mapped, RadiiAndOpacities) {
  const Scene s = scene("a.csv", "radius = { attribute = \"v\", range = [1, 100], scale = \"log\", to = [0.1, 0.5] }\nalpha = { attribute = \"x\", to = [0, 1] }");
  EXPECT_FLOAT_EQ(radius(s, 4), 0.3f);
  EXPECT_FLOAT_EQ(radius(s, 0), 0.1f);
  EXPECT_EQ(alpha(s, 4), 255u);
  EXPECT_EQ(alpha(s, 2), 128u);
  EXPECT_EQ(rgb(s, 2), 0xe7e7e7u); // 0.8 linear, encoded
  (void)scene("a.csv", "alpha = \"x\"");
  EXPECT_TRUE(diagnostics.has("S040")) << printed();
  (void)scene("a.csv", "alpha = \"y\"");
  EXPECT_FALSE(diagnostics.has("S040")) << printed();
}

TEST_F(Mapped, SelectedRowsKeepTheirNumbers) {
  const Scene s = scene("a.csv", "select = 'kind == \"a\" || v > 50'\ncolor = { attribute = \"v\", map = \"gray\" }");
  EXPECT_EQ(s.particle_count(), 5u); // ids of all rows
  std::vector<std::uint32_t> rows;
  for (const std::uint32_t row : s.batches.at(0).chunks->rows)
    if (row != no_row) rows.push_back(row);
  std::sort(rows.begin(), rows.end());
  EXPECT_THAT(rows, ElementsAre(1u, 2u, 3u));
  EXPECT_EQ(s.annotations.keys.at(0).low, 1.0); // of what is drawn
  (void)scene("a.csv", "select = 'x > 99'");
  EXPECT_TRUE(diagnostics.has("S035"));
  (void)scene("a.csv", "\nselect = 'w > 99'");
  ASSERT_TRUE(diagnostics.has("S021"));
  EXPECT_THAT(printed(), HasSubstr("s.toml:6:11: error S021"));
}

TEST_F(Mapped, NothingThatCanBeMapped) {
  (void)scene("a.csv", "select = 'x == 3'\ncolor = { attribute = \"v\" }");
  EXPECT_TRUE(diagnostics.has("S036")) << printed();
  EXPECT_FALSE(diagnostics.has_errors());
}

TEST_F(Mapped, LegendsAreOffWhereTheyAreOff) {
  const std::string color = "color = { attribute = \"v\" }";
  EXPECT_TRUE(scene("a.csv", color).annotations.scale_bar);
  EXPECT_TRUE(scene("a.csv", color, "legend = false").annotations.empty());
  EXPECT_TRUE(scene("a.csv", "color = \"#ff0000\"").annotations.empty());
  const Scene bar = scene("a.csv", "color = \"#ff0000\"", "legend = { scale_bar = true, unit = \"mm\", place = \"left\", size = 2 }");
  EXPECT_TRUE(bar.annotations.scale_bar);
  EXPECT_EQ(bar.annotations.length_unit, "mm");
  EXPECT_EQ(bar.annotations.place, LegendPlace::Left);
}

const char* const crystal = "2\nLattice=\"4 0 0 0 5 0 0 0 6\" Properties=species:S:1:pos:R:3\nNa 0 0 0\nCl 5 1 1\n";

TEST_F(Mapped, CellsAreWrappedRepeatedAndDrawn) {
  write("c.xyz", crystal);
  const Scene s = scene("c.xyz", "periodic = \"wrap\"\nreplicas = [2, 1, 3]\ncell = { color = \"#ff0000\", width = 3 }");
  ASSERT_FALSE(diagnostics.has_errors()) << printed();
  EXPECT_EQ(s.batches.at(0).instances.size(), 6u);
  EXPECT_EQ(s.batches.at(0).instances.back().world_from_data[3], glm::dvec4(4, 0, 12, 1));
  EXPECT_NEAR(s.batches[0].chunks->center(place(s, 1)).x, 1.0, 1e-6);
  ASSERT_EQ(s.annotations.cells.size(), 1u);
  EXPECT_EQ(s.annotations.cells[0].edges[2], glm::dvec3(0, 0, 6));
  EXPECT_EQ(s.annotations.cells[0].color, glm::dvec3(1, 0, 0));
  for (const char* lines : {"periodic = \"wrap\"", "replicas = [2, 2, 2]", "cell = true", "periodic = \"unwrap\""}) {
    (void)scene("a.csv", lines);
    EXPECT_TRUE(diagnostics.has("S037")) << lines;
  }
}

TEST_F(Mapped, StylesOfMolecules) {
  write("c.xyz", crystal);
  const Scene s = scene("c.xyz", "style = \"spacefill\"");
  EXPECT_FALSE(diagnostics.has_errors()) << printed();
  EXPECT_FLOAT_EQ(radius(s, 0), 2.27f); // Bondi's sodium
  (void)scene("a.csv", "style = \"spacefill\"");
  EXPECT_TRUE(diagnostics.has("S023")) << printed();
  (void)scene("a.csv", "style = \"licorice\"");
  EXPECT_TRUE(diagnostics.has("S023")) << printed();
}

// Two carbons that are neighbors across a skewed cell: each half bond goes from its atom a quarter of the way at a time.
TEST_F(Mapped, BondsCrossPeriodicCells) {
  write("m.xyz", "2\nLattice=\"10 0 0 3 10 0 0 0 10\" Properties=species:S:1:pos:R:3\nC 0.5 0 5\nC 12.4 9.5 5\n"); // minus a and b: -0.6, -0.5
  for (const char* style : {"licorice", "ball_and_stick"}) {
    const Scene s = scene("m.xyz", (std::string("style = \"") + style + "\"").c_str());
    ASSERT_FALSE(diagnostics.has_errors()) << printed();
    ASSERT_EQ(s.batches.size(), 2u);
    EXPECT_EQ(s.batches[1].type, "cylinder");
    EXPECT_EQ(s.batches[1].id_base, 2u);
    EXPECT_EQ(s.batches[1].row_count, 1u);
    const ChunkSet& sticks = *s.batches[1].chunks;
    ASSERT_EQ(sticks.vec4s_per_record, 3u);
    bool seen = false;
    for (std::uint64_t i = 0; i < sticks.record_count(); ++i) {
      if (sticks.rows[i] == no_row) continue;
      const glm::vec4 h = sticks.records[3 * i + 1];
      EXPECT_NEAR(std::abs(h.x), 1.1 / 4, 1e-6);
      EXPECT_NEAR(std::abs(h.y), 0.5 / 4, 1e-6);
      EXPECT_FLOAT_EQ(h.w, style == std::string("licorice") ? 0.25f : 0.12f);
      seen = seen || glm::length(sticks.center(i) - glm::dvec3(0.5 - 1.1 / 4, -0.5 / 4, 5)) < 1e-5;
    }
    EXPECT_TRUE(seen) << "the half at the first atom";
    EXPECT_FLOAT_EQ(radius(s, 0), style == std::string("licorice") ? 0.25f : 0.25f * 1.7f);
  }
}

TEST_F(Mapped, VectorsBecomeGlyphs) {
  write("v.csv", "x,y,z,velocity.x,velocity.y,velocity.z,size\n0,0,0,3,4,0,1\n5,0,0,0,0,0,2\n9,0,0,nan,0,0,3\n12,0,0,0,0,2,4\n");
  const Scene s = scene("v.csv", "type = \"arrow\"\ndirection = \"velocity\"\nscale = 0.5\nradius = 0.1\nhead_radius = 0.3\nhead_length = 4.0");
  EXPECT_FALSE(diagnostics.has_errors()) << printed();
  EXPECT_TRUE(diagnostics.has("S042")) << printed(); // one has no length, one no number
  const ChunkSet& arrows = *s.batches.at(0).chunks;
  ASSERT_EQ(s.batches[0].type, "arrow");
  std::size_t drawn = 0;
  for (std::uint64_t i = 0; i < arrows.record_count(); ++i) {
    if (arrows.rows[i] == no_row) continue;
    ++drawn;
    EXPECT_TRUE(arrows.rows[i] == 0 || arrows.rows[i] == 3);
    if (arrows.rows[i] != 0) continue;
    EXPECT_LT(glm::length(glm::dvec3(arrows.records[3 * i + 1]) - glm::dvec3(0.75, 1.0, 0)), 1e-6);
    EXPECT_LT(glm::length(arrows.center(i) - glm::dvec3(0.75, 1.0, 0)), 1e-6) << "the tail is at the position";
    EXPECT_LE(arrows.records[3 * i + 2].y, 2.5f) << "a head is no longer than its arrow";
  }
  EXPECT_EQ(drawn, 2u);
  (void)scene("v.csv", "type = \"capsule\"");
  EXPECT_TRUE(diagnostics.has("S021")) << printed();
  EXPECT_THAT(printed(), HasSubstr("velocity"));
  (void)scene("v.csv", "type = \"cone\"\ndirection = \"size\"");
  EXPECT_TRUE(diagnostics.has("S041")) << printed();
  const Scene round = scene("v.csv", "type = \"cylinder\"\nends = \"round\"\ndirection = [0, 0, 1]\nlength = \"size\"\nradius = 0.2");
  EXPECT_FALSE(diagnostics.has_errors()) << printed();
  EXPECT_EQ(round.batches.at(0).type, "capsule");
}

struct Broken {
  const char *lines, *code, *words;
};
class BrokenMapping : public Mapped, public testing::WithParamInterface<Broken> {};
TEST_P(BrokenMapping, IsRefused) {
  (void)scene("a.csv", GetParam().lines);
  EXPECT_TRUE(diagnostics.has(GetParam().code)) << printed();
  EXPECT_THAT(printed(), HasSubstr(GetParam().words));
}
INSTANTIATE_TEST_SUITE_P(
    All, BrokenMapping,
    testing::Values(Broken{"color = { attribute = \"v\", range = { percentil = [0, 1] } }", "S003", "Did you mean 'percentile'?"},
                    Broken{"color = { attribute = \"v\", range = { percentile = [0, 101] } }", "S005", "from 0 to 100"},
                    Broken{"color = { attribute = \"v\", range = [-1, 1], scale = \"log\" }", "S005", "above 0"},
                    Broken{"color = { attribute = \"v\", range = \"symmetric\", scale = \"log\" }", "S005", "around zero"},
                    Broken{"color = { attribute = \"v\", scale = \"cubic\" }", "S006", "takes: linear, log"},
                    Broken{"color = { attribute = \"kind\" }", "S022", "needs numbers"}, Broken{"alpha = 1.5", "S005", "from 0 to 1"},
                    Broken{"alpha = { attribute = \"x\", to = [0, 2] }", "S005", "to[1]"}, Broken{"alpha = \"kind\"", "S022", "numbers are needed"},
                    Broken{"replicas = [0, 1, 1]", "S005", "replicas[0]"}, Broken{"replicas = [1.5, 1, 1]", "S005", "whole numbers"},
                    Broken{"cell = 1", "S004", "true, false, or { color, width }"}, Broken{"style = \"spacefil\"", "S006", "Did you mean 'spacefill'?"},
                    Broken{"periodic = \"fold\"", "S006", "takes: wrap, unwrap"}, Broken{"trajectory = []", "S005", "is empty"},
                    Broken{"select = 3", "S004", "select takes a text"}));

} // namespace
} // namespace mote
