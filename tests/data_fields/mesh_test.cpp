// SPDX-License-Identifier: MIT
// Vertices of meshes: OBJ, OFF, STL, PLY, with normals and colors where there are any.
#include "tests/data_fields/support.hpp"

#include <bit>
#include <cmath>

namespace mote::data::testing {
namespace {

using ::testing::ElementsAre;

TEST(Obj, NormalsByFaces) {
  const Frame frame = read_memory("a.obj", "# CC0-1.0\no thing\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nvn 0 0 "
                                           "1\nvn 1 0 0\nvt 0 0\nf 1//1 2/1/2 -2//-2\n");
  EXPECT_EQ(frame.count, 4u);
  EXPECT_THAT(numbers_of(frame, "normal"), ElementsAre(0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0));
}

TEST(Obj, OneNormalForEachVertexOrNone) {
  EXPECT_THAT(numbers_of(read_memory("a.obj", "v 0 0 0\nvn 0 1 0\n"), "normal"), ElementsAre(0, 1, 0));
  EXPECT_EQ(read_memory("a.obj", "v 0 0 0\nv 1 1 1\nvn 0 1 0\n").find("normal"), nullptr);
}

TEST(Obj, ColorsBehindTheCoordinates) {
  EXPECT_THAT(numbers_of(read_memory("a.obj", "v 1 2 3 0.1 0.2 0.3\n"), "color"), ElementsAre(0.1, 0.2, 0.3));
  EXPECT_EQ(read_memory("a.obj", "v 1 2 3 1.0\n").find("color"), nullptr); // a weight
}

TEST(Obj, BadFilesAreRefused) {
  expect_refused("a.obj", "v 0 0 0\nv 1 2\n", "D010", "a.obj:2:1");
  expect_refused("a.obj", "v 0 0 0\nv 1 2 zero\n", "D012", "a.obj:2:7");
  expect_refused("a.obj", "v 0 0 0\nvertex 1 2 3\n", "D008", "'vertex'");
  expect_refused("a.obj", "v 0 0 0\nvn 0 0 1\nf 1//1 2//1 1//1\n", "D066", "vertex '2', but there are 1");
  expect_refused("a.obj", "v 0 0 0\nvn 0 0 1\nf 1//1 1//0 1//1\n", "D066", "normal '0'");
  expect_refused("a.obj", "o nothing\ng here\n", "D013", "no vertices");
}

TEST(Off, KindsOfVertices) {
  EXPECT_THAT(numbers_of(read_memory("a.off", "OFF # CC0-1.0\n# mesh\n1 0 0\n1 2 3\n"), "position"),
              ElementsAre(1, 2, 3));
  EXPECT_EQ(read_memory("a.off", "OFF 1 0 0\n1 2 3\n").count, 1u);
  const Frame frame = read_memory("a.off", "CNOFF\n1 1 0\n1 2 3 0 0 1 255 128 0\n3 0 0 0\n");
  EXPECT_THAT(numbers_of(frame, "normal"), ElementsAre(0, 0, 1));
  EXPECT_THAT(numbers_of(frame, "color"), ElementsAre(255, 128, 0));
}

TEST(Off, BadFilesAreRefused) {
  expect_refused("a.off", "OFF\n2 0 0\n1.00 2.00 3.00\n", "D006", "vertex 2 of 2 is missing");
  expect_refused("a.off", "OFF\n99999999999 0 0\n1 2 3\n", "D006", "99999999999 vertices");
  expect_refused("a.off", "OFF\n1 1 0\n1 2 3\n3 0 0 1\n", "D066", "vertex '1', but there are 1");
  expect_refused("a.off", "OFF\n1 1 0\n1 2 3\n3 0 0\n", "D010", "2 corners of 3");
  expect_refused("a.off", "COFF\n1 0 0\n1 2 3\n", "D010", "3 numbers instead of 6");
  expect_refused("a.off", "4OFF\n1 0 0\n1 2 3 1\n", "D065", "'4OFF'");
  expect_refused("a.off", "OFF BINARY\n", "D065", "binary OFF");
  expect_refused("a.off", "OFF\n1 x 0\n1 2 3\n", "D008", "faces is not a count: 'x'");
}

const std::string stl = "solid CC0-1.0\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 "
                        "1 0\nendloop\nendfacet\n"
                        "facet normal 1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 0 0 "
                        "1\nendloop\nendfacet\nendsolid CC0-1.0\n";

std::string binary_stl(std::uint32_t facets) {
  std::string out = "solid, but binary" + std::string(63, ' ');
  const auto put = [&](std::uint32_t bits) {
    for (int i = 0; i < 4; ++i) out += static_cast<char>(bits >> (8 * i));
  };
  put(facets);
  for (const float v : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f})
    put(std::bit_cast<std::uint32_t>(v));
  return out + std::string(2, '\0');
}

TEST(Stl, CornersAreJoinedAndNormalsAveraged) {
  const Frame frame = read_memory("a.stl", stl);
  EXPECT_THAT(numbers_of(frame, "position"), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1));
  const std::vector<double> n = numbers_of(frame, "normal");
  EXPECT_NEAR(n[0], std::sqrt(0.5), 1e-15);
  EXPECT_EQ(n[5], 1.0);
  for (std::size_t size = 1; size + 20 < stl.size(); ++size)
    EXPECT_NE(outcome_of("a.stl", stl.substr(0, size)).code, "") << size;
}

TEST(Stl, Binary) {
  const std::string whole = binary_stl(1);
  EXPECT_THAT(numbers_of(read_memory("a.stl", whole), "position"), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  for (std::size_t size = 1; size < whole.size(); ++size)
    EXPECT_NE(outcome_of("a.stl", whole.substr(0, size)).code, "") << size;
  expect_refused("a.stl", binary_stl(4000000000u), "D006", "facets");
}

TEST(Stl, BadFilesAreRefused) {
  expect_refused("a.stl", changed(stl, "outer loop", "outer lop"), "D008",
                 "'loop' is missing; here stands 'lop'");
  expect_refused("a.stl", changed(stl, "vertex 1 0 0", "vertex 1 0 nought"), "D012", "a.stl:5:12");
}

const std::string ply = "ply\nformat ascii 1.0\ncomment CC0-1.0\nelement vertex 2\nproperty float "
                        "x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
                        "property float nz\nproperty uchar red\nproperty uchar green\nproperty uchar "
                        "blue\nend_header\n0 0 0 0 0 1 255 0 9\n1 2 3 1 0 0 0 1 2\n";

TEST(Ply, NormalsAndColors) {
  const Frame frame = read_memory("a.ply", ply);
  EXPECT_THAT(numbers_of(frame, "normal"), ElementsAre(0, 0, 1, 1, 0, 0));
  EXPECT_THAT(numbers_of(frame, "color"), ElementsAre(255, 0, 9, 0, 1, 2));
  EXPECT_EQ(frame.columns.size(), 3u);
}

TEST(Ply, BadFilesAreRefused) {
  expect_refused("a.ply", changed(ply, "vertex 2", "vertex 3"), "D006", "3 vertices are announced");
  expect_refused("a.ply", changed(ply, "vertex 2", "vertex 99999999999"), "D006", "99999999999 vertices");
  const std::string binary =
      changed(ply.substr(0, ply.find("0 0 0 0")), "ascii", "binary_little_endian") + "some bytes";
  expect_refused("a.ply", changed(binary, "vertex 2", "vertex 683212743470724134"), "D006",
                 "vertices"); // x 27 wraps
  expect_refused("a.ply", changed(ply, "float x", "floot x"), "D065", "Did you mean 'float'");
  expect_refused("a.ply", changed(ply, "float x", "float y"), "D062", "'y' is there twice");
  expect_refused("a.ply", changed(ply, "float x", "float a"), "D013", "position");
  expect_refused("a.ply", changed(ply, "element vertex", "element vertices"), "D062", "'vertex'");
  expect_refused("a.ply", changed(ply, "ascii", "asci"), "D065", "binary_little_endian");
  expect_refused("a.ply", changed(ply, "property float x", "property list uchar int x"), "D065", "lists");
  expect_refused("a.ply", changed(ply, "0 1 2\n", "0 1 2.5\n"), "D012", "'2.5'");
}

} // namespace
} // namespace mote::data::testing
