// SPDX-License-Identifier: MIT
#include "core/scene/colormaps.hpp"
#include "tests/scene/realize_fixture.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mote {
namespace {

using testing::HasSubstr;

TEST_F(Realize, CsvWithRadii) {
  write("a.csv", "x,y,z,radius,mass\n0,0,0,0.5,1\n2,0,0,0.25,3\n");
  const Scene s = scene("a.csv");
  ASSERT_TRUE(diagnostics.empty()) << printed();
  EXPECT_EQ(s.particle_count(), 2u);
  EXPECT_EQ(radius(s, 0), 0.5f);
  EXPECT_EQ(radius(s, 1), 0.25f);
  EXPECT_EQ(s.batches[0].color, glm::dvec3(0.8));
  EXPECT_NEAR(s.bounds.min.x, -0.5, 1e-6);
  EXPECT_NEAR(s.bounds.max.x, 2.25, 1e-6);
}

TEST_F(Realize, RadiusRulesInOrder) {
  write("a.csv", "x,y,z,mass\n0,0,0,1\n2,0,0,3\n5,0,0,2\n");
  EXPECT_EQ(radius(scene("a.csv"), 0), 1.0f); // half the median neighbor distance (2, 2, 3)
  EXPECT_EQ(radius(scene("a.csv", "radius = 0.3"), 0), 0.3f);
  EXPECT_EQ(radius(scene("a.csv", "radius = \"mass\""), 1), 3.0f);
  const Scene s = scene("a.csv", "radius = { attribute = \"mass\", map = \"linear\", range = \"auto\", to = [0.2, 0.6] }");
  EXPECT_EQ(radius(s, 0), 0.2f);
  EXPECT_EQ(radius(s, 1), 0.6f);
  EXPECT_EQ(radius(s, 2), 0.4f);
  write("one.csv", "x,y,z\n7,7,7\n");
  EXPECT_EQ(radius(scene("one.csv"), 0), 0.5f);
}

// A path of close points: a radius of half their distance would show nothing. A stray point changes nothing.
TEST_F(Realize, GuessedRadiiShow) {
  std::string path = "x,y,z\n", row = path;
  for (int i = 0; i <= 1000; ++i) path += fmt::format("{},0,0\n", i % 2 ? i - 0.999 : i);
  for (int i = 0; i < 40; ++i) row += fmt::format("{},0,0\n", i);
  write("path.csv", path);
  EXPECT_NEAR(radius(scene("path.csv"), 0), 0.8, 0.01) << "a thousandth of eight tenths of 1000, not half of 0.001";
  write("stray.csv", row + "1e9,0,0\n");
  EXPECT_EQ(radius(scene("stray.csv"), 0), 0.5f);
}

TEST_F(Realize, ElementsGiveRadiusAndColor) {
  write("w.xyz", "3\nwater\nO 0 0 0\nH 0.96 0 0\nH 0 0.96 0\n");
  const Scene s = scene("w.xyz");
  ASSERT_TRUE(diagnostics.empty()) << printed();
  EXPECT_EQ(radius(s, 0), 1.52f); // Bondi
  EXPECT_EQ(radius(s, 1), 1.2f);
  EXPECT_EQ(rgb(s, 0), 0xff0d0du); // Jmol
  EXPECT_EQ(rgb(s, 2), 0xffffffu);
  EXPECT_EQ(rgb(scene("w.xyz", "color = \"element\""), 0), 0xff0d0du);
  EXPECT_TRUE(scene("w.xyz", "color = \"#102030\"").batches[0].chunks->colors.empty());
}

TEST_F(Realize, ColorMapsFollowTheValues) {
  write("a.csv", "x,y,z,vx,vy,vz,kind\n0,0,0,0,0,0,4\n2,0,0,3,4,0,1\n5,0,0,0,0,2.5,14\n9,0,0,nan,0,0,2\n");
  const Scene s = scene("a.csv", "color = { attribute = \"speed\", map = \"gray\" }");
  EXPECT_EQ(rgb(s, 0), 0x000000u);
  EXPECT_EQ(rgb(s, 1), 0xffffffu);
  EXPECT_EQ(rgb(s, 2), 0x808080u);
  EXPECT_EQ(rgb(s, 3), not_a_number_color);
  EXPECT_THAT(printed(), HasSubstr("warning S033: 1 of 4 particles have NaN as 'speed'"));
  EXPECT_EQ(rgb(scene("a.csv", "color = { attribute = \"velocity.y\", map = \"gray_r\", range = [0, 8] }"), 1), 0x7f7f7fu);
  EXPECT_EQ(rgb(scene("a.csv", "color = { attribute = \"x\", map = \"gray\", range = [2, 4] }"), 2), 0xffffffu);
  const Scene kinds = scene("a.csv", "color = { attribute = \"kind\", map = \"tab10\" }");
  EXPECT_EQ(rgb(kinds, 0), rgb(kinds, 2)); // 4 and 14
  EXPECT_NE(rgb(kinds, 0), rgb(kinds, 1));
}

TEST_F(Realize, MissingAttributesAreLocatedAndListed) {
  write("a.csv", "x,y,z,mass\n0,0,0,1\n");
  scene("a.csv", "color = { attribute = \"mas\" }");
  EXPECT_THAT(printed(), HasSubstr("s.toml:5:23: error S021: "));
  EXPECT_THAT(printed(), HasSubstr("has no attribute 'mas'"));
  EXPECT_THAT(printed(), HasSubstr("Did you mean 'mass'?"));
  EXPECT_THAT(printed(), HasSubstr("Attributes: position, mass"));
  scene("a.csv", "radius = \"size\"");
  EXPECT_THAT(printed(), HasSubstr("error S021"));
  scene("a.csv", "color = \"element\"");
  EXPECT_THAT(printed(), HasSubstr("error S023"));
}

TEST_F(Realize, TextAttributesNeedACategoricalMap) {
  write("w.xyz", "2\n\nO 0 0 0\nH 0.96 0 0\n");
  scene("w.xyz", "color = { attribute = \"element\", map = \"viridis\" }");
  EXPECT_THAT(printed(), HasSubstr("error S022"));
  scene("w.xyz", "radius = \"type\"");
  EXPECT_THAT(printed(), HasSubstr("error S022"));
  const Scene s = scene("w.xyz", "color = { attribute = \"element\", map = \"tab10\" }");
  EXPECT_TRUE(diagnostics.empty()) << printed();
  EXPECT_EQ(rgb(s, 0), 0x1f77b4u);
}

TEST_F(Realize, WhatCannotBeDrawnIsCountedAndRowsKeepTheirNumbers) {
  write("a.csv", "x,y,z,radius\n0,0,0,1\nnan,0,0,1\n2,0,0,0\n3,0,0,inf\n4,0,0,1\n");
  const Scene s = scene("a.csv");
  EXPECT_FALSE(diagnostics.has_errors()) << printed();
  EXPECT_THAT(printed(), HasSubstr("warning S030: 1 of 5 particles have no finite position"));
  EXPECT_THAT(printed(), HasSubstr("warning S031: 1 of 5 particles have radius 0"));
  EXPECT_THAT(printed(), HasSubstr("warning S032: 1 of 5 particles have no finite radius"));
  EXPECT_EQ(s.particle_count(), 5u);
  EXPECT_EQ(s.batches[0].chunks->chunks[0].count, 2u);
  EXPECT_EQ(radius(s, 4), 1.0f);
}

TEST_F(Realize, NegativeRadiiAreRefused) {
  write("a.csv", "x,y,z,radius\n0,0,0,1\n2,0,0,-0.5\n3,0,0,-1\n");
  scene("a.csv");
  EXPECT_THAT(printed(), HasSubstr("error S024: the radius of particle 1 is '-0.5', and 1 more are negative"));
}

TEST_F(Realize, NoParticlesAreFine) {
  write("a.xyz", "0\nnothing\n");
  const Scene s = scene("a.xyz");
  EXPECT_FALSE(diagnostics.has_errors()) << printed();
  EXPECT_EQ(s.particle_count(), 0u);
  EXPECT_TRUE(check(s.camera).empty());
}

TEST_F(Realize, MissingAndBrokenFilesAreReported) {
  scene("no_such.xyz");
  EXPECT_THAT(printed(), HasSubstr("s.toml:4:8: error S018: the data file '"));
  write("bad.xyz", "3\ntoo few rows\nO 0 0 0\n");
  scene("bad.xyz");
  EXPECT_TRUE(diagnostics.has_errors());
  EXPECT_THAT(printed(), HasSubstr("bad.xyz"));
}

TEST_F(Realize, SeveralDataSetsCountTheirIdsOn) {
  write("a.csv", "x,y,z\n0,0,0\n1,0,0\nnan,0,0\n");
  write("b.csv", "x,y,z\n10,0,0\n12,0,0\n");
  const Scene s = scene("a.csv", "[[data]]\nfile = \"b.csv\"\ntransform = [ { scale = 2 }, { translate = [0, 5, 0] } ]");
  ASSERT_EQ(s.batches.size(), 2u) << printed();
  EXPECT_EQ(s.batches[1].id_base, 3u);
  EXPECT_EQ(s.particle_count(), 5u);
  EXPECT_NEAR(s.bounds.max.x, 26.0, 1e-5); // (12 + 1) * 2
  EXPECT_NEAR(s.bounds.max.y, 7.0, 1e-5);
}

// Two chains; assembly 1 has both turned twice, assembly 2 only chain B, moved.
const std::string two_chains = R"(REMARK 350 BIOMOLECULE: 1
REMARK 350 APPLY THE FOLLOWING TO CHAINS: A, B
REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000        0.00000
REMARK 350   BIOMT2   1  0.000000  1.000000  0.000000        0.00000
REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000        0.00000
REMARK 350   BIOMT1   2 -0.500000 -0.866025  0.000000        0.00000
REMARK 350   BIOMT2   2  0.866025 -0.500000  0.000000        0.00000
REMARK 350   BIOMT3   2  0.000000  0.000000  1.000000       10.00000
REMARK 350 BIOMOLECULE: 2
REMARK 350 APPLY THE FOLLOWING TO CHAINS: B
REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000      100.00000
REMARK 350   BIOMT2   1  0.000000  1.000000  0.000000        0.00000
REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000        0.00000
ATOM      1  CA  ALA A   1       5.000   0.000   0.000  1.00  0.00           C
ATOM      2  CA  ALA B   1       0.000   7.000   0.000  1.00  0.00           C
END
)";

TEST_F(Realize, AssembliesAreInstances) {
  write("two.pdb", two_chains);
  const Scene first = scene("two.pdb"); // the file's first assembly
  ASSERT_EQ(first.batches.size(), 1u) << printed();
  ASSERT_EQ(first.batches[0].instances.size(), 2u);
  EXPECT_EQ(first.particle_count(), 4u);
  const glm::dmat4& turn = first.batches[0].instances[1].world_from_data;
  EXPECT_TRUE(similarity_scale(turn)) << "six decimals are not made rigid";
  EXPECT_LT(glm::length(glm::dvec3(turn * glm::dvec4(5, 0, 0, 1)) - glm::dvec3(-2.5, 4.3301, 10)), 1e-4);
  const Scene second = scene("two.pdb", "assembly = \"2\"");
  ASSERT_EQ(second.batches.size(), 1u);
  EXPECT_EQ(second.batches[0].chunks->chunks[0].count, 1u);
  EXPECT_EQ(place(second, 1), 0u); // only row 1
  EXPECT_GT(second.bounds.min.x, 90.0);
  EXPECT_EQ(scene("two.pdb", "assembly = \"none\"").particle_count(), 2u);
  EXPECT_EQ(scene("two.pdb", "assembly = \"2\"\ntransform = [ { scale = 2 } ]").bounds.center().x, 200.0);
}

TEST_F(Realize, AssembliesThatAreNotThereAreListed) {
  write("two.pdb", two_chains);
  scene("two.pdb", "assembly = \"3\"");
  EXPECT_THAT(printed(), HasSubstr("s.toml:5:12: error S016: "));
  EXPECT_THAT(printed(), HasSubstr("Assemblies: 1, 2"));
  write("a.csv", "x,y,z\n0,0,0\n");
  scene("a.csv", "assembly = \"1\"");
  EXPECT_THAT(printed(), HasSubstr("has no assemblies"));
}

TEST_F(Realize, GeneratedScenesHaveAPalette) {
  const std::vector<std::string> words{"spheres:1e3:fit"};
  const Scene s = realize(describe(words, {}, diagnostics), {1280, 720}, diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << printed();
  EXPECT_EQ(s.particle_count(), 1000u);
  EXPECT_EQ(rgb(s, 0), 0xe64d40u); // 0.90 0.30 0.25
  EXPECT_EQ(rgb(s, 8), rgb(s, 0));
  EXPECT_EQ(radius(s, 0), 4.0f);
  EXPECT_EQ(s.background, glm::dvec4(1));
}

TEST_F(Realize, CamerasAreCompletedSoThatTheDataIsInView) {
  Bounds bounds;
  bounds.add({1, 2, 3});
  bounds.add({11, 4, 6});
  auto inside = [&](const Camera& c) {
    const View v = make_view(c, {1280, 720}, bounds.diagonal());
    double most = 0.0;
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 p = v.to_view({i & 1 ? 11 : 1, i & 2 ? 4 : 2, i & 4 ? 6 : 3});
      EXPECT_GT(p.z, 0.0);
      const double z = c.projection == Projection::Perspective ? p.z : 1.0;
      most = std::max({most, std::abs(p.x / z * v.focal) / 640, std::abs(p.y / z * v.focal) / 360});
    }
    return most;
  };
  CameraDesc desc;
  EXPECT_EQ(complete_camera(desc, bounds, {1280, 720}).eye, frame(bounds, {1280, 720}).eye);
  desc.fov_y = 60;
  EXPECT_THAT(inside(complete_camera(desc, bounds, {1280, 720})), testing::AllOf(testing::Gt(0.9), testing::Lt(1.0)));
  desc = {};
  desc.up = {0, 1, 0};
  EXPECT_THAT(inside(complete_camera(desc, bounds, {1280, 720})), testing::AllOf(testing::Gt(0.9), testing::Lt(1.0)));
  desc = {};
  desc.projection = Projection::Orthographic;
  EXPECT_THAT(inside(complete_camera(desc, bounds, {1280, 720})), testing::AllOf(testing::Gt(0.9), testing::Lt(1.0)));
  desc = {};
  desc.eye = {6, 3, 50};
  const Camera down = complete_camera(desc, bounds, {1280, 720});
  EXPECT_EQ(down.target, bounds.center());
  EXPECT_TRUE(check(down).empty());
}

TEST_F(Realize, ACameraInTheTargetIsLocated) {
  write("a.csv", "x,y,z\n0,0,0\n2,0,0\n");
  scene("a.csv", "", "[camera]\neye = [1, 0, 0]");
  EXPECT_THAT(printed(), HasSubstr("s.toml:3:7: error S011: the camera cannot see: eye and target are the same point"));
}

} // namespace
} // namespace mote
