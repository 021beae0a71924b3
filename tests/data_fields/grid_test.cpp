// SPDX-License-Identifier: MIT
// Grids whose points are not in the file: image data, rectilinear and structured ones, OVF meshes. Sizes
// that lie are refused before memory is touched.
#include "tests/data_fields/support.hpp"

namespace mote::data::testing {
namespace {

using ::testing::ElementsAre;

const std::string image = R"(<VTKFile type="ImageData" byte_order="LittleEndian">
<ImageData WholeExtent="0 1 0 2 0 0" Origin="10 20 30" Spacing="0.5 2 1">
<Piece Extent="0 1 0 2 0 0"><PointData><DataArray type="Float32" Name="t" format="ascii">1 2 3 4 5 6</DataArray></PointData></Piece>
</ImageData></VTKFile>
)";

TEST(ImageData, PointsAreGeneratedXFastest) {
  const Frame frame = read_memory("a.vti", image);
  ASSERT_EQ(frame.count, 6u);
  EXPECT_THAT(numbers_of(frame, "position"),
              ElementsAre(10, 20, 30, 10.5, 20, 30, 10, 22, 30, 10.5, 22, 30, 10, 24, 30, 10.5, 24, 30));
  EXPECT_THAT(numbers_of(frame, "t"), ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(ImageData, ExtentThatDoesNotBeginAtZeroAndDirection) {
  std::string text = changed(image, "Piece Extent=\"0 1 0 2 0 0\"", "Piece Extent=\"2 3 0 2 0 0\"");
  EXPECT_EQ(numbers_of(read_memory("a.vti", text), "position")[0], 11.0);
  text = changed(text, "Spacing=", "Direction=\"0 -1 0 1 0 0 0 0 1\" Spacing=");
  const std::vector<double> p = numbers_of(read_memory("a.vti", text), "position"); // x goes to y, y to -x
  EXPECT_THAT(std::vector<double>(p.begin() + 6, p.begin() + 9), ElementsAre(8, 21, 30));
}

TEST(ImageData, CellDataGiveCenters) {
  std::string text = changed(image, "<PointData>", "<CellData>");
  text = changed(text, "</PointData>", "</CellData>");
  text = changed(text, "1 2 3 4 5 6", "1 2");
  Diagnostics warnings;
  const Frame frame = read_memory("a.vti", text, &warnings);
  EXPECT_THAT(numbers_of(frame, "position"), ElementsAre(10.25, 21, 30, 10.25, 23, 30));
  EXPECT_TRUE(warnings.has("D072"));
}

TEST(ImageData, SizesThatLieAreRefused) {
  expect_refused("a.vti", changed(image, "1 2 3 4 5 6", "1 2 3 4 5"), "D006", "6 numbers");
  expect_refused("a.vti", changed(image, "1 2 3 4 5 6", "1 2 3 4 5 6 7"), "D064", "more than 6 numbers");
  expect_refused("a.vti",
                 changed(image, "Piece Extent=\"0 1 0 2 0 0\"",
                         "Piece Extent=\"0 4000000000 0 4000000000 0 4000000000\""),
                 "D006", "numbers");
  const std::string empty =
      R"(<VTKFile type="ImageData"><ImageData><Piece Extent="0 99999 0 99999 0 99999"/></ImageData></VTKFile>)";
  expect_refused("a.vti", empty, "D004", "100000 x 100000 x 100000 points need");
  expect_refused("a.vti", changed(image, "Piece Extent=\"0 1 0 2 0 0\"", "Piece Extent=\"1 0 0 2 0 0\""),
                 "D062", "impossible");
  expect_refused("a.vti", changed(image, "Piece Extent=\"0 1 0 2 0 0\"", "Piece Extent=\"0 1 0 2 0\""),
                 "D062", "5 numbers instead of 6");
}

const std::string rectilinear = R"(<VTKFile type="RectilinearGrid">
<RectilinearGrid><Piece Extent="0 1 0 1 0 0"><PointData/><Coordinates>
<DataArray type="Float64" format="ascii">0 5</DataArray><DataArray type="Float64" format="ascii">1 2</DataArray>
<DataArray type="Float64" format="ascii">7</DataArray></Coordinates></Piece></RectilinearGrid></VTKFile>)";

TEST(RectilinearGrid, CoordinatesOfTheAxes) {
  EXPECT_THAT(numbers_of(read_memory("a.vtr", rectilinear), "position"),
              ElementsAre(0, 1, 7, 5, 1, 7, 0, 2, 7, 5, 2, 7));
  expect_refused("a.vtr",
                 changed(rectilinear, "<DataArray type=\"Float64\" format=\"ascii\">7</DataArray>", ""),
                 "D062", "2 arrays instead of 3");
  expect_refused("a.vtr", changed(rectilinear, ">0 5<", ">0<"), "D006", "2 numbers");
}

TEST(StructuredGrid, PointsAndCellCenters) {
  const std::string grid =
      R"(<VTKFile type="StructuredGrid"><StructuredGrid><Piece Extent="0 1 0 1 0 0"><CellData>
<DataArray type="Int32" Name="k" format="ascii">9</DataArray></CellData><Points>
<DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 2 0 0 0 2 0 2 2 4</DataArray></Points></Piece></StructuredGrid></VTKFile>)";
  const Frame frame = read_memory("a.vts", grid);
  EXPECT_THAT(numbers_of(frame, "position"), ElementsAre(1, 1, 1));
  EXPECT_THAT(numbers_of(frame, "k"), ElementsAre(9));
  const Frame points = read_memory(
      "a.vts", changed(changed(changed(grid, "<CellData>", "<PointData>"), "</CellData>", "</PointData>"),
                       ">9<", ">9 8 7 6<"));
  EXPECT_EQ(points.count, 4u);
}

const std::string legacy = "# vtk DataFile Version 3.0\nCC0-1.0\nASCII\nDATASET "
                           "STRUCTURED_POINTS\nDIMENSIONS 2 2 1\nORIGIN 1 2 3\nSPACING 2 3 4\n"
                           "POINT_DATA 4\nSCALARS s float\nLOOKUP_TABLE default\n1 2 3 4\nNORMALS n float\n0 "
                           "0 1 0 0 1 0 0 1 0 0 1\n";

TEST(LegacyVtk, StructuredPointsAndAttributes) {
  const Frame frame = read_memory("a.vtk", legacy);
  EXPECT_THAT(numbers_of(frame, "position"), ElementsAre(1, 2, 3, 3, 2, 3, 1, 5, 3, 3, 5, 3));
  EXPECT_THAT(numbers_of(frame, "s"), ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(frame.find("normal")->components, 3u);
}

TEST(LegacyVtk, RectilinearGridAndCellCenters) {
  const std::string text =
      "# vtk DataFile Version 2.0\n\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 2 2 1\nX_COORDINATES 2 "
      "float\n0 4\nY_COORDINATES 2 float\n0 2\nZ_COORDINATES 1 float\n1\n";
  EXPECT_EQ(read_memory("a.vtk", text).count, 4u);
  const Frame frame =
      read_memory("a.vtk", text + "CELL_DATA 1\nSCALARS p float 1\nLOOKUP_TABLE default\n6\n");
  EXPECT_THAT(numbers_of(frame, "position"), ElementsAre(2, 1, 1));
}

TEST(LegacyVtk, BadFilesAreRefused) {
  expect_refused("a.vtk", changed(legacy, "ASCII", "ASCCI"), "D008", "'ASCCI'");
  expect_refused("a.vtk", changed(legacy, "STRUCTURED_POINTS", "TENSOR_GRID"), "D065", "structured_points");
  expect_refused("a.vtk", changed(legacy, "SCALARS", "SCALERS"), "D008", "Did you mean 'SCALARS'");
  expect_refused("a.vtk", changed(legacy, "s float", "s flot"), "D065", "Did you mean 'float'");
  expect_refused("a.vtk", changed(legacy, "1 2 3 4", "1 2 x 4"), "D012", "a.vtk:11:5");
  expect_refused("a.vtk", changed(legacy, "POINT_DATA 4", "POINT_DATA 5"), "D064",
                 "POINT_DATA has 5 rows, but there are 4 points");
  expect_refused("a.vtk", changed(legacy, "DIMENSIONS 2 2 1", "DIMENSIONS 2 -2 1"), "D008", "'-2'");
  expect_refused("a.vtk",
                 "# vtk DataFile Version 3.0\n\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 99999999 "
                 "99999999 99999999\n",
                 "D004", "points need");
  expect_refused(
      "a.vtk", // 2^64 points: the product must not wrap
      "# vtk DataFile Version 3.0\n\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 4194304 2097152 2097152\n",
      "D004", "points need");
  expect_refused(
      "a.vtk",
      "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 18446744073709551615 float\n1 2 3\n",
      "D006", "ends early");
  expect_refused("a.vtk",
                 "# vtk DataFile Version 3.0\n\nBINARY\nDATASET POLYDATA\nPOINTS 4000000000 float\nabc",
                 "D006", "48000000000 bytes, but 3 are left");
}

TEST(LegacyVtk, TextsAndLookupTablesAreSteppedOver) {
  const std::string binary_head =
      "# vtk DataFile Version 4.2\n\nBINARY\nDATASET POLYDATA\nPOINTS 2 unsigned_char\n" +
      std::string("\1\2\3\4\5\6\n", 7);
  const std::string text = binary_head + "POINT_DATA 2\nSCALARS s unsigned_char\nLOOKUP_TABLE mine\n" +
                           std::string("\7\x08\n", 3) + "LOOKUP_TABLE mine 1\n" +
                           std::string("\1\1\1\1\n", 5) + "FIELD FieldData 2\nlabel 1 2 string\n" +
                           std::string("\xc2") + "ab" + std::string("\xc1") + "c\nb 1 2 bit\n\x80\n";
  Diagnostics warnings;
  const Frame frame = read_memory("a.vtk", text, &warnings);
  EXPECT_THAT(numbers_of(frame, "position"), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(numbers_of(frame, "s"), ElementsAre(7, 8));
  EXPECT_THAT(numbers_of(frame, "b"), ElementsAre(1, 0));
  EXPECT_TRUE(warnings.has("D072"));
}

const std::string ovf = "# OOMMF OVF 2.0\n# Segment count: 1\n# Begin: Segment\n# Begin: Header\n# Title: "
                        "CC0-1.0\n# meshtype: rectangular\n# meshunit: nm\n"
                        "# xbase: 1\n# ybase: 2\n# zbase: 3\n# xnodes: 2\n# ynodes: 1\n# znodes: 1\n# "
                        "xstepsize: 10\n# ystepsize: 10\n# zstepsize: 10\n"
                        "# xmin: 0\n# valuedim: 3\n# valuelabels: m_x m_y m_z\n# valueunits: T T T\n# End: "
                        "Header\n# Begin: Data Text\n1 2 3\n4 5 6\n# End: Data Text\n# End: Segment\n";

TEST(Ovf, Text) {
  const Frame frame = read_memory("a.ovf", ovf);
  EXPECT_THAT(numbers_of(frame, "position"), ElementsAre(1, 2, 3, 11, 2, 3));
  EXPECT_THAT(numbers_of(frame, "m"), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(frame.find("m")->unit, "T");
}

TEST(Ovf, OtherDimensionsAndIrregularMeshes) {
  std::string text = changed(ovf, "valuedim: 3", "valuedim: 2");
  text = changed(changed(text, "m_x m_y m_z", "energy depth"), "T T T", "J m");
  const Frame frame = read_memory("a.ovf", changed(text, "1 2 3\n4 5 6", "1 2\n3 4"));
  EXPECT_THAT(numbers_of(frame, "depth"), ElementsAre(2, 4));
  EXPECT_EQ(frame.find("depth")->unit, "m");
  text = changed(changed(ovf, "rectangular", "irregular"), "# xmin: 0", "# pointcount: 1");
  const Frame irregular = read_memory("a.ovf", changed(text, "1 2 3\n4 5 6", "1 2 3 4 5 6"));
  EXPECT_THAT(numbers_of(irregular, "position"), ElementsAre(1, 2, 3));
  EXPECT_THAT(numbers_of(irregular, "m"), ElementsAre(4, 5, 6));
}

std::string ovf_binary(bool wide, bool big, double check) {
  const auto put = [&](double value) {
    std::string out(wide ? 8 : 4, '\0');
    const std::uint64_t bits =
        wide ? std::bit_cast<std::uint64_t>(value) : std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (std::size_t i = 0; i < out.size(); ++i)
      out[big ? out.size() - 1 - i : i] = static_cast<char>(bits >> (8 * i));
    return out;
  };
  std::string data = put(check);
  for (const double v : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) data += put(v);
  const std::string kind = wide ? "Binary 8" : "Binary 4";
  std::string text =
      changed(changed(ovf, "Begin: Data Text", "Begin: Data " + kind), "End: Data Text", "End: Data " + kind);
  text = changed(text, "1 2 3\n4 5 6\n", data + "\n");
  return big ? changed(text, "# OOMMF OVF 2.0", "# OOMMF: rectangular mesh v1.0") : text;
}

TEST(Ovf, BinaryOfBothVersionsAndItsCheckValue) {
  for (const bool wide : {false, true})
    for (const bool big : {false, true}) {
      const double check = wide ? 123456789012345.0 : 1234567.0;
      EXPECT_THAT(numbers_of(read_memory("a.omf", ovf_binary(wide, big, check)), "m"),
                  ElementsAre(1, 2, 3, 4, 5, 6));
      expect_refused("a.omf", ovf_binary(wide, big, check + 1), "D008", "check value");
      const std::string whole = ovf_binary(wide, big, check);
      for (std::size_t size = 1; size + 1 < whole.size(); ++size)
        EXPECT_NE(outcome_of("a.omf", whole.substr(0, size)).code, "") << size;
    }
}

TEST(Ovf, BadFilesAreRefused) {
  expect_refused("a.ovf", changed(ovf, "OVF 2.0", "OVF 3.0"), "D065", "ovf 3.0");
  expect_refused("a.ovf", changed(ovf, "# xnodes: 2\n", ""), "D062", "'xnodes'");
  expect_refused("a.ovf", changed(ovf, "xnodes: 2", "xnodes: two"), "D008", "a.ovf:11:1");
  expect_refused("a.ovf", changed(ovf, "xnodes: 2", "xnodes: 3"), "D012", "'#'");
  expect_refused("a.ovf", changed(ovf, "xnodes: 2", "xnodes: 1"), "D007", "'4 5 6'");
  expect_refused("a.ovf", changed(ovf, "xnodes: 2", "xnodes: 4000000000000"), "D004",
                 "4000000000000 x 1 x 1");
  expect_refused("a.ovf", changed(ovf, "Begin: Data Text", "Begin: Data Binary 16"), "D065",
                 "'data binary 16'");
  for (std::size_t size = 1; size + 1 < ovf.size(); ++size)
    EXPECT_NE(outcome_of("a.ovf", ovf.substr(0, size)).code, "") << size;
}

} // namespace
} // namespace mote::data::testing
