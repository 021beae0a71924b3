// SPDX-License-Identifier: MIT
// Files that lie: every number of every reader's files replaced by 2^63 and its neighbors, frames with differing counts,
// ids that are there twice. Particles that keep their promises, or a refusal; never more memory than the file could need.
#include "core/data/series.hpp"
#include "tests/data/files.hpp"
#include "tests/data/support.hpp"
#include "tests/data_molecular/samples.hpp"
#include "tests/fuzz/inputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace mote::fuzz {
namespace {

using data::test::failure_of;
using data::test::failure_of_text;
using data::test::open_text;

long resident_kib() { // the most so far
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

class Lies : public testing::TestWithParam<std::string> {
protected:
  static std::vector<Input> inputs() {
    static const auto all = inputs_by_format(2500);
    const auto found = all.find(GetParam());
    return found == all.end() ? std::vector<Input>{} : found->second;
  }
};

TEST_P(Lies, EveryNumberOfATextMayBeHuge) {
  constexpr std::string_view digits = "0123456789";
  for (const Input& input : inputs())
    for (std::size_t at = input.content.find_first_of(digits); at != std::string::npos;) {
      const std::size_t end = std::min(input.content.find_first_not_of(digits, at), input.content.size());
      for (const char* lie : {"9223372036854775808", "9223372036854775807", "18446744073709551615", "4294967296", "2147483648", "-1"}) {
        std::string content = input.content;
        content.replace(at, end - at, lie);
        ASSERT_EQ(data::test::survives(content, input.extension), "") << input.name << ": " << lie << " at " << at;
      }
      at = input.content.find_first_of(digits, end);
    }
  EXPECT_LT(resident_kib(), 600 << 10);
}

TEST_P(Lies, EveryPlaceMayHoldAHugeNumber) {
  for (const Input& input : inputs())
    for (std::size_t at = 0; at + 4 <= input.content.size(); at += 2)
      for (const std::string_view lie : {std::string_view("\0\0\0\0\0\0\0\x80", 8), std::string_view("\x80\0\0\0\0\0\0\0", 8), std::string_view("\xff\xff\xff\xff\xff\xff\xff\x7f", 8),
                                         std::string_view("\x7f\xff\xff\xff", 4), std::string_view("\xff\xff\xff\x7f", 4), std::string_view("\xff\xff\xff\xff", 4)}) {
        if (at + lie.size() > input.content.size()) continue;
        std::string content = input.content;
        content.replace(at, lie.size(), lie);
        ASSERT_EQ(data::test::survives(content, input.extension), "") << input.name << " at " << at;
      }
  EXPECT_LT(resident_kib(), 600 << 10);
}

INSTANTIATE_TEST_SUITE_P(Readers, Lies, testing::ValuesIn(reader_names()), [](const auto& tested) { return word_of(tested.param); });

// Two frames of two and one particle, or three, two: every format whose frames state their own counts.
TEST(DifferingCounts, EachFrameHasItsOwn) {
  using data::test::make_trr, data::test::make_xtc;
  const std::string dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n1 0 0 0\n2 1 0 0\n"
                           "ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n2 0 1 0\n";
  const std::string atoms = "ATOM      1  CA  ALA A   1       1.000   2.000   3.000  1.00  0.00           C  \n"
                            "ATOM      2  CB  ALA A   1       4.000   5.000   6.000  1.00  0.00           C  \n";
  const std::string cif = "data_x\nloop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.pdbx_PDB_model_num\n"
                          "1 C 0 0 0 1\n2 C 1 0 0 1\n1 C 0 1 0 2\n";
  const std::string row = "    1SOL     OW    1   0.000   1.000   2.000\n", box = "   1.0 1.0 1.0\n";
  const std::tuple<const char*, std::string, std::uint64_t, std::uint64_t> files[]{
      {"xyz", "2\n\nO 0 0 0\nO 1 0 0\n1\n\nO 0 1 0\n", 2, 1},
      {"lammpstrj", dump, 2, 1},
      {"pdb", "MODEL        1\n" + atoms + "ENDMDL\nMODEL        2\n" + atoms.substr(0, atoms.size() / 2) + "ENDMDL\nEND\n", 2, 1},
      {"cif", cif, 2, 1},
      {"gro", "a\n2\n" + row + row + box + "b\n1\n" + row + box, 2, 1},
      {"xtc", make_xtc(1, 12) + make_xtc(1, 3), 12, 3},
      {"trr", make_trr(1, 3, false) + make_trr(1, 2, true), 3, 2},
  };
  for (const auto& [extension, content, first, second] : files) {
    const auto source = open_text(content, extension);
    ASSERT_EQ(source->frame_count(), 2u) << extension;
    EXPECT_EQ(source->read(1).count, second) << extension;
    EXPECT_EQ(source->read(0).count, first) << extension;
    EXPECT_EQ(data::test::broken_promise(source->read(1)), "") << extension;
  }
}

// Files of a series may differ, too; rows with an id keep their place, the gone one closes up.
TEST(DifferingCounts, FilesOfASeries) {
  const data::test::Folder folder;
  data::SeriesFiles names;
  names.files.push_back(folder.write("a_1.csv", "id,x,y,z\n5,0,0,0\n9,1,0,0\n7,2,0,0\n"));
  names.files.push_back(folder.write("a_2.csv", "id,x,y,z\n7,2,1,0\n5,0,1,0\n"));
  names.files.push_back(folder.write("a_3.csv", "id,x,y,z\n3,9,0,0\n7,2,1,0\n9,1,1,0\n5,0,1,0\n"));
  const auto series = data::open_series(names);
  const auto x_of = [&](std::uint64_t frame) {
    const data::Frame read = series->read(frame);
    std::vector<double> out;
    for (std::uint64_t i = 0; i < read.count; ++i) out.push_back(read.find("position")->number(i, 0));
    return out;
  };
  EXPECT_THAT(x_of(0), testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(x_of(1), testing::ElementsAre(0, 2));
  EXPECT_THAT(x_of(2), testing::ElementsAre(0, 1, 2, 9));
}

// Where ids tie rows to something (bonds, the next frame), two equal ones are refused; else they are what the file says.
TEST(DuplicateIds, RefusedOrKeptAsTheyAre) {
  const Diagnostic dump = failure_of_text("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n4 0 0 0\n4 1 0 0\n", "dump");
  EXPECT_EQ(dump.code, "D015");
  EXPECT_THAT(dump.text, testing::HasSubstr("4"));
  EXPECT_EQ(failure_of_text("t\n\n2 atoms\n1 atom types\n\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtoms # atomic\n\n4 1 0 0 0\n4 1 1 0 0\n", "data").code, "D015");
  const std::string twin = "ATOM      4  CA  ALA A   1       1.000   2.000   3.000  1.00  0.00           C  \n";
  const std::pair<const char*, std::string> kept[]{
      {"xyz", "2\nProperties=id:I:1:species:S:1:pos:R:3\n4 O 0 0 0\n4 O 1 0 0\n"},
      {"csv", "id,x,y,z\n4,0,0,0\n4,1,0,0\n"},
      {"pdb", twin + twin + "END\n"},
      {"cif", "data_x\nloop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n4 C 0 0 0\n4 C 1 0 0\n"},
      {"vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0 1 0 0\nPOINT_DATA 2\nSCALARS id int 1\nLOOKUP_TABLE default\n4 4\n"},
      {"ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nproperty int id\nend_header\n0 0 0 4\n1 0 0 4\n"},
  };
  for (const auto& [extension, content] : kept) {
    const data::Frame frame = data::test::read_text(content, extension);
    EXPECT_EQ(frame.count, 2u) << extension;
    EXPECT_EQ(data::test::broken_promise(frame), "") << extension;
    ASSERT_NE(frame.find("id"), nullptr) << extension;
    EXPECT_EQ(frame.find("id")->number(1), 4) << extension;
  }
  // In a series such rows cannot be told apart: they stay in the order of the file.
  const data::test::Folder folder;
  data::SeriesFiles names;
  names.files.push_back(folder.write("a.xyz", kept[0].second + "2\nProperties=id:I:1:species:S:1:pos:R:3\n4 O 5 0 0\n4 O 6 0 0\n"));
  EXPECT_EQ(data::open_series(names)->read(1).find("position")->number(0, 0), 5);
}

} // namespace
} // namespace mote::fuzz
