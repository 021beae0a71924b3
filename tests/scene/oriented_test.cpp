// SPDX-License-Identifier: MIT
// Columns and tensors to ellipsoids, boxes and superquadrics.
#include "tests/scene/realize_fixture.hpp"

#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <filesystem>

namespace mote {
namespace {

using testing::HasSubstr;

class OrientedData : public Realize {
protected:
  // vec4 k of the record of the particle in this row.
  static glm::vec4 record(const Scene& s, std::uint32_t row, std::size_t k) {
    const ChunkSet& set = *s.batches.at(0).chunks;
    for (std::uint64_t i = 0; i < set.record_count(); ++i)
      if (set.rows[i] == row) return set.records[i * set.vec4s_per_record + k];
    ADD_FAILURE() << "row " << row << " is not drawn";
    return {};
  }
  static std::uint64_t drawn(const Scene& s) {
    std::uint64_t n = 0;
    for (const Chunk& c : s.batches.at(0).chunks->chunks) n += c.count;
    return n;
  }
  static glm::dmat3 axes(const Scene& s, std::uint32_t row) {
    const glm::vec4 q = record(s, row, 1);
    return glm::mat3_cast(glm::dquat(q.w, q.x, q.y, q.z));
  }
};

// A quarter turn about z: the first axis points along y.
TEST_F(OrientedData, QuaternionsOfAStatedOrder) {
  write("a.csv", "x,y,z,a,b,c,q1,q2,q3,q4\n0,0,0,3,2,1,0,0,0.70710678118654752,0.70710678118654752\n5,0,0,1,1,2,0,0,0,1\n");
  const std::string rest = "type = \"ellipsoid\"\naxes = [3, 2, 1]\n";
  write("q.xyz", "2\nProperties=species:S:1:pos:R:3:turn:R:4\nC 0 0 0 0 0 0.70710678118654752 0.70710678118654752\nC 9 0 0 0 0 0 1\n");
  const Scene s = scene("q.xyz", rest + "orientation = { attribute = \"turn\", order = \"xyzw\" }");
  ASSERT_TRUE(diagnostics.empty()) << printed();
  EXPECT_EQ(s.batches.at(0).type, "ellipsoid");
  EXPECT_EQ(glm::vec3(record(s, 0, 2)), glm::vec3(3, 2, 1));
  EXPECT_NEAR(axes(s, 0)[0].y, 1.0, 1e-7);
  EXPECT_NEAR(axes(s, 1)[0].x, 1.0, 1e-7);
  EXPECT_NEAR(s.bounds.max.x, 9.0 + 3.0, 1e-4);
  EXPECT_NEAR(s.bounds.min.y, -3.0, 1e-4) << "the box of the turned one";
  const Scene other = scene("q.xyz", rest + "orientation = { attribute = \"turn\", order = \"wxyz\" }");
  EXPECT_NEAR(axes(other, 0)[0].x, -1.0, 1e-7) << "half a turn about (0, 1, 1)";
  (void)scene("q.xyz", rest + "orientation = \"turn\"");
  EXPECT_THAT(printed(), HasSubstr("S061"));
  EXPECT_THAT(printed(), HasSubstr("does not say in which order 'turn' holds the components"));
}

TEST_F(OrientedData, UnnormalizedQuaternionsAreCountedAndMadeSo) {
  write("q.xyz", "3\nProperties=species:S:1:pos:R:3:turn:R:4\nC 0 0 0 0 0 2 2\nC 9 0 0 0 0 0 1\nC 0 9 0 0 0 0 0\n");
  const Scene s = scene("q.xyz", "type = \"box\"\naxes = [3, 2, 1]\norientation = { attribute = \"turn\", order = \"xyzw\" }");
  EXPECT_THAT(printed(), HasSubstr("warning S062: 1 of 3 particles have a quaternion that is not of length 1; it was made so"));
  EXPECT_THAT(printed(), HasSubstr("1 of 3 particles have a quaternion of no length and are left out"));
  EXPECT_EQ(drawn(s), 2u);
  EXPECT_NEAR(glm::length(record(s, 0, 1)), 1.0f, 1e-6f);
  EXPECT_NEAR(axes(s, 0)[0].y, 1.0, 1e-7);
}

// The first ANISOU of 4opj, its longest axis by power iteration; 50 % of a normal distribution in space lie within 1.5382 deviations.
TEST_F(OrientedData, AnisotropicDisplacementsOfAProtein) {
  const std::string file = MOTE_SOURCE_DIR "/../shared/data/protein/4opj.pdb";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "NOT TESTED: the reference pack is missing";
  const Scene s = scene(file, "type = \"ellipsoid\"\ntensor = \"anisou\"\nassembly = \"none\"");
  EXPECT_FALSE(diagnostics.has_errors()) << printed();
  const glm::dvec3 a(record(s, 0, 2));
  const glm::dmat3 u(1.7770, -0.3221, 0.5535, -0.3221, 0.5569, -0.2064, 0.5535, -0.2064, 1.3158);
  const glm::dmat3 r = axes(s, 0);
  for (int k = 0; k < 3; ++k) EXPECT_LT(glm::length(u * r[k] - r[k] * (a[k] / 1.5381722544550522) * (a[k] / 1.5381722544550522)), 1e-6) << k;
  EXPECT_GE(a.x, a.y);
  EXPECT_GE(a.y, a.z);
  EXPECT_NEAR(a.x, 2.298674, 1e-5);
  const Scene wide = scene(file, "type = \"ellipsoid\"\ntensor = { attribute = \"anisou\", probability = 0.9 }\nassembly = \"none\"");
  EXPECT_NEAR(record(wide, 0, 2).x / a.x, 2.5002777108094093 / 1.5381722544550522, 1e-5);
}

TEST_F(OrientedData, SingularAndNegativeTensorsAreLeftOutAndCounted) {
  write("t.xyz", "5\nProperties=species:S:1:pos:R:3:t:R:6\nC 0 0 0 4 1 9 0 0 0\nC 9 0 0 1 1 0 0 0 0\nC 0 9 0 1 -1 2 0 0 0\nC 0 0 9 nan 1 1 0 0 0\nC 3 3 3 1 1 1 0 0 2\n");
  const std::string tensor = "tensor = { attribute = \"t\", order = \"xx yy zz xy xz yz\", kind = \"axes\" }";
  const Scene s = scene("t.xyz", "type = \"ellipsoid\"\nradius = 1\n" + tensor);
  EXPECT_EQ(drawn(s), 1u);
  EXPECT_THAT(printed(), HasSubstr("1 of 5 particles have a singular tensor"));
  EXPECT_THAT(printed(), HasSubstr("2 of 5 particles have a tensor with a negative eigenvalue"));
  EXPECT_THAT(printed(), HasSubstr("1 of 5 particles have a tensor that is not finite"));
  EXPECT_EQ(glm::vec3(record(s, 0, 2)), glm::vec3(9, 4, 1));
  EXPECT_NEAR(std::abs(axes(s, 0)[0].z), 1.0, 1e-7);
}

// Kindlmann's exponents: linear (1, 0, 0) is a sharp rod along the long axis, planar (1, 1, 0) a coin, (1, 1, 1) a sphere.
TEST_F(OrientedData, TensorsToSuperquadrics) {
  write("t.xyz", "3\nProperties=species:S:1:pos:R:3:t:R:6\nC 0 0 0 9 3 3 0 0 0\nC 9 0 0 9 9 3 0 0 0\nC 0 9 0 2 2 2 0 0 0\n");
  const Scene s = scene("t.xyz", "type = \"superquadric\"\ntensor = { attribute = \"t\", order = \"xx yy zz xy xz yz\", kind = \"axes\" }");
  ASSERT_TRUE(diagnostics.empty()) << printed();
  EXPECT_NEAR(std::abs(axes(s, 0)[2].x), 1.0, 1e-7) << "its z axis is the long one";
  EXPECT_EQ(record(s, 0, 2).z, 9.0f);
  EXPECT_NEAR(record(s, 0, 3).x, std::pow(1.0 - 6.0 / 15.0, 3), 1e-6);
  EXPECT_NEAR(record(s, 0, 3).y, 1.0, 1e-6);
  EXPECT_NEAR(std::abs(axes(s, 1)[2].z), 1.0, 1e-7) << "its z axis is the short one";
  EXPECT_NEAR(record(s, 1, 3).x, std::pow(1.0 - 12.0 / 21.0, 3), 1e-6);
  EXPECT_NEAR(record(s, 1, 3).y, 1.0, 1e-6);
  EXPECT_EQ(glm::vec2(record(s, 2, 3)), glm::vec2(1.0f));
}

TEST_F(OrientedData, WhatIsMissingIsSaidWithWhatThereIs) {
  write("a.csv", "x,y,z,mass\n0,0,0,1\n5,0,0,1\n");
  (void)scene("a.csv", "type = \"ellipsoid\"");
  EXPECT_THAT(printed(), HasSubstr("S021"));
  EXPECT_THAT(printed(), HasSubstr("need half axes, and"));
  EXPECT_THAT(printed(), HasSubstr("mass"));
  (void)scene("a.csv", "type = \"ellipsoid\"\ntensor = \"stress\"");
  EXPECT_THAT(printed(), HasSubstr("has no attribute 'stress'"));
  (void)scene("a.csv", "type = \"ellipsoid\"\ntensor = \"mass\"");
  EXPECT_THAT(printed(), HasSubstr("S060"));
  EXPECT_THAT(printed(), HasSubstr("'mass' of"));
  EXPECT_THAT(printed(), HasSubstr("a symmetric tensor has 6 or 9"));
  (void)scene("a.csv", "type = \"superquadric\"\naxes = [1, 1, 1]\nexponents = [0.5, 3]");
  EXPECT_THAT(printed(), HasSubstr("S005"));
  const Scene cubes = scene("a.csv", "type = \"box\"\nradius = 0.5");
  ASSERT_TRUE(diagnostics.empty()) << printed();
  EXPECT_EQ(glm::vec3(record(cubes, 1, 2)), glm::vec3(0.5f));
}

} // namespace
} // namespace mote
