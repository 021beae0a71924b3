// SPDX-License-Identifier: MIT
// The broken files of chemfiles' collection: each is refused with its code and a sentence that names
// the fault, and so is every bad frame in files that have several.
#include "core/data/source.hpp"
#include "tests/data/files.hpp"
#include "tests/data/support.hpp"

#include <gmock/gmock.h>

namespace mote::data {
namespace {

using testing::HasSubstr;

struct BadFrame {
  const char* file;
  std::uint64_t frame;
  const char* code;
  const char* words;
  std::uint64_t line;
};

// clang-format off
const BadFrame bad_frames[] = {
    {"lammps/atom-duplicated-id.lammpstrj", 0, "D015", "id '2' is taken already by the atom of line 10", 11},
    {"lammps/atom-item-name.lammpstrj", 0, "D008", "section 'ITEM: DUMMY' is unknown", 9},
    {"lammps/atom-no-item.lammpstrj", 0, "D008", "'DUMMY' stands where a section", 9},
    {"lammps/atom-not-enough-lines.lammpstrj", 0, "D006", "promises 3 atoms, but the file ends after 2", 12},
    {"lammps/atom-too-many-fields.lammpstrj", 0, "D011", "goes on with 'X' after its 5 values", 10},
    {"lammps/box-item-name.lammpstrj", 0, "D008", "section 'ITEM: DUMMY' is unknown", 5},
    {"lammps/box-not-item.lammpstrj", 0, "D008", "'DUMMY' stands where a section", 5},
    {"lammps/box-not-numbers.lammpstrj", 0, "D014", "'DUMMY' in the box bounds is not a finite number", 6},
    {"lammps/box-not-numbers.lammpstrj", 1, "D014", "'DUMMY'", 18},
    {"lammps/box-not-numbers.lammpstrj", 2, "D014", "'DUMMY'", 30},
    {"lammps/box-wrong-size.lammpstrj", 0, "D014", "has 2 numbers, but this box needs 3", 6},
    {"lammps/box-wrong-size.lammpstrj", 1, "D014", "has 2 numbers, but this box needs 3", 18},
    {"lammps/box-wrong-size.lammpstrj", 2, "D014", "has 2 numbers, but this box needs 3", 30},
    {"lammps/items-after-atoms.lammpstrj", 0, "D007", "'ITEM: TIME' stands behind the atoms", 16},
    {"lammps/timestep-item-name.lammpstrj", 0, "D008", "section 'ITEM: DUMMY' is unknown", 1},
    {"lammps/timestep-no-item.lammpstrj", 0, "D008", "'DUMMY' stands where a section", 1},
    {"xyz/extended-bad-properties.xyz", 0, "D012", "'H' is not a number", 3},
    {"xyz/extended-bad-properties.xyz", 1, "D009", "the number of columns of 'bad' is ''", 5},
    {"xyz/extended-bad-properties.xyz", 2, "D009", "the type of 'bad' is 'F'", 8},
    {"xyz/extended-bad-properties.xyz", 3, "D009", "the number of columns of 'bad' is 'ff'", 11},
    {"xyz/extended-bad-properties.xyz", 4, "D009", "the number of columns of 'bad' is '0'", 14},
    {"xyz/extended.xyz", 0, "D010", "has 4 values, but 5 are needed: 'bad' is missing", 3},
    {"xyz/extended.xyz", 1, "D012", "'ff' is not a number", 6},
    {"xyz/extended.xyz", 2, "D010", "'bad' is missing", 9},
    {"xyz/extended.xyz", 3, "D012", "'ze' is not an integer", 12},
    {"xyz/extended.xyz", 4, "D010", "'bad[3]' is missing", 15},
    {"xyz/extended.xyz", 5, "D012", "'ff' is not a number ('bad[3]')", 18},
    {"xyz/extended.xyz", 6, "D010", "'bad' is missing", 21},
    {"xyz/extended.xyz", 7, "D012", "'ok' is not a truth value", 24},
    {"xyz/extended.xyz", 8, "D010", "'bad' is missing", 27},
    {"xyz/helium.xyz", 0, "D006", "promises 8 particles, but the file ends after 4", 7},
};
// clang-format on

TEST(BadFiles, EveryBadFrameIsRefusedWithCodePlaceAndWords) {
  for (const BadFrame& bad : bad_frames) {
    SCOPED_TRACE(std::string(bad.file) + " frame " + std::to_string(bad.frame));
    const auto file = test::fixture("bad") / bad.file;
    const auto source = open(file);
    const Diagnostic d = test::failure_of([&] { (void)source->read(bad.frame); });
    EXPECT_EQ(d.code, bad.code);
    EXPECT_THAT(d.text, HasSubstr(bad.words));
    EXPECT_EQ(d.loc.line, bad.line);
    EXPECT_EQ(d.loc.file, file.string());
  }
}

TEST(BadFiles, TheListNamesEveryFile) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::fixture("bad"))) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const std::string name = std::filesystem::relative(entry.path(), test::fixture("bad")).generic_string();
    EXPECT_TRUE(std::any_of(std::begin(bad_frames), std::end(bad_frames), [&](const BadFrame& bad) {
      return name == bad.file;
    })) << name;
  }
  EXPECT_EQ(files, 15u);
}

TEST(BadFiles, FramesCanBeCountedBeforeTheyAreRead) {
  EXPECT_EQ(open(test::fixture("bad/xyz/extended.xyz"))->frame_count(), 9u);
  EXPECT_EQ(open(test::fixture("bad/lammps/box-wrong-size.lammpstrj"))->frame_count(), 3u);
}

TEST(BadFiles, MissingFolderUnknownAndEmpty) {
  const test::Folder folder;
  folder.write("water.xyz", "1\n\nO 0 0 0\n");
  Diagnostic d = test::failure_of([&] { (void)open(folder / "watre.xyz"); });
  EXPECT_EQ(d.code, "D001");
  ASSERT_EQ(d.hints.size(), 1u);
  EXPECT_EQ(d.hints[0], "Did you mean 'water.xyz'?");
  d = test::failure_of([&] { (void)open(folder / ""); });
  EXPECT_EQ(d.code, "D001");
  EXPECT_THAT(d.text, HasSubstr("a folder"));
  d = test::failure_of([&] { (void)open(folder.write("nothing.xyz", "")); });
  EXPECT_EQ(d.code, "D002");
  d = test::failure_of([&] { (void)open(folder.write("blank.xyz", "\n \r\n\t\n")); });
  EXPECT_EQ(d.code, "D002");
  d = test::failure_of(
      [&] { (void)open(folder.write("letter.txt", "Dear reader,\nthis is no table.\n"))->read(0); });
  EXPECT_EQ(d.code, "D013"); // a table by its name only
  d = test::failure_of([&] { (void)open(folder.write("letter", "Dear reader!\nNo table.\n")); });
  EXPECT_EQ(d.code, "D005");
  EXPECT_THAT(d.text, HasSubstr("'Dear reader!'"));
  EXPECT_THAT(d.hints[0], HasSubstr("lammps-dump, xyz, npy"));
}

TEST(BadFiles, NoSuchFrame) {
  const auto source = open(test::fixture("trajectory.xyz"));
  const Diagnostic d = test::failure_of([&] { (void)source->read(2); });
  EXPECT_EQ(d.code, "D017");
  EXPECT_THAT(d.text, HasSubstr("2 frames (0 to 1)"));
}

} // namespace
} // namespace mote::data
