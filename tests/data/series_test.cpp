// SPDX-License-Identifier: MIT
// Series of files, topology and trajectory, frames by index: each file of a series is written here.
#include "core/data/frame_rows.hpp"
#include "core/data/series.hpp"
#include "tests/data/files.hpp"
#include "tests/data/support.hpp"

#include <gmock/gmock.h>

namespace mote::data {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string xyz(double x) { return fmt::format("1\n\nO {} 0 0\n", x); }
double first_x(Source& source, std::uint64_t frame) { return source.read(frame).find("position")->number(0); }
Diagnostic failure_of_files(const SeriesFiles& files) {
  return test::failure_of([&] { (void)open_series(files)->read(0); });
}
Exit exit_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Failure& failure) {
    return failure.exit();
  }
  return Exit::Done;
}

TEST(Series, PatternsAreInTheOrderOfTheirNumbers) {
  const test::Folder folder;
  for (const int k : {10, 2, 1, 100}) folder.write(fmt::format("run3_{}.xyz", k), xyz(k));
  folder.write("run3_007.xyz", xyz(7));
  folder.write("other_5.xyz", xyz(5));
  const auto source = open_series({{folder / "run3_*.xyz"}, {}});
  ASSERT_EQ(source->frame_count(), 5u);
  std::vector<double> found;
  for (std::uint64_t k = 0; k < 5; ++k) found.push_back(first_x(*source, k));
  EXPECT_THAT(found, ElementsAre(1, 2, 7, 10, 100));
  EXPECT_EQ(first_x(*source, 3), 10); // any order
  EXPECT_EQ(expand_pattern(folder / "run3_?.xyz").size(), 2u);
}

TEST(Series, FilesOfSeveralFramesAreCounted) {
  const test::Folder folder;
  folder.write("a.xyz", xyz(0) + xyz(1));
  folder.write("b.xyz", xyz(2) + xyz(3) + xyz(4));
  const auto source = open_series({{folder / "a.xyz", folder / "b.xyz"}, {}});
  EXPECT_EQ(first_x(*source, 4), 4);
  EXPECT_EQ(first_x(*source, 1), 1);
  EXPECT_EQ(source->frame_count(), 5u);
  const Diagnostic d = test::failure_of([&] { (void)source->read(5); });
  EXPECT_EQ(d.code, "D017");
}

TEST(Series, ANameWithAStarThatExistsIsAFile) {
  const test::Folder folder;
  folder.write("a*.xyz", xyz(1));
  folder.write("ab.xyz", xyz(2));
  EXPECT_THAT(expand_pattern(folder / "a*.xyz"), ElementsAre(folder / "a*.xyz"));
}

TEST(Series, APatternThatNothingFits) {
  const test::Folder folder;
  const Diagnostic d = failure_of_files({{folder / "no_*.vtk"}, {}});
  EXPECT_EQ(d.code, "D025");
  EXPECT_THAT(d.text, HasSubstr("no file fits"));
}

TEST(Series, AParticleKeepsItsRowAndColumnsMayChangePlaces) {
  const std::string head = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\n";
  const auto with = [&](int step, int count) { return fmt::format(fmt::runtime(head), step, count); };
  const test::Folder folder;
  folder.write("a.dump", with(0, 3) + "ITEM: ATOMS id x y z\n7 1 0 0\n3 2 0 0\n5 3 0 0\n" + //
                             with(1, 3) + "ITEM: ATOMS x z y id\n3.5 0 0 5\n1.5 0 0 7\n2.5 0 0 3\n" +
                             with(2, 4) + "ITEM: ATOMS id x y z\n9 9 0 0\n5 3 0 0\n1 8 0 0\n7 1 0 0\n");
  const auto source = open_series({{folder / "a.dump"}, {}});
  const Frame second = source->read(1);
  EXPECT_THAT(ids_of(second), ElementsAre(7, 3, 5)); // the order of frame 0, which is that of the file
  EXPECT_EQ(second.find("position")->number(0), 1.5);
  EXPECT_EQ(second.find("position")->number(2), 3.5);
  EXPECT_THAT(ids_of(source->read(2)), ElementsAre(7, 5, 1, 9)); // new ones behind, by id
  EXPECT_THAT(ids_of(source->read(0)), ElementsAre(7, 3, 5));
}

TEST(Series, BondsFollowTheirRows) {
  Frame frame;
  frame.count = 4;
  frame.columns.push_back({"position", 3, std::vector<double>{0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}});
  frame.columns.push_back({"name", 1, TextColumn{{0, 1, 0, 1}, {"a", "b"}}});
  frame.bonds.rows = {{0, 1}, {1, 3}, {2, 3}};
  frame.bonds.types = {5, 6, 7};
  const std::vector<std::uint32_t> rows{3, 1, 0};
  take_rows(frame, rows);
  EXPECT_EQ(frame.count, 3u);
  EXPECT_EQ(test::broken_promise(frame), "");
  EXPECT_EQ(frame.find("position")->number(0), 3);
  EXPECT_EQ(std::get<TextColumn>(frame.find("name")->values).at(2), "a");
  EXPECT_THAT(frame.bonds.rows, ElementsAre(std::array{1u, 2u}, std::array{0u, 1u}));
  EXPECT_THAT(frame.bonds.types, ElementsAre(5, 6));
}

TEST(Pairs, TopologyMovedByATrajectory) {
  MOTE_NEED_PACK();
  const auto both = open_series({{test::pack() / "md/md.gro"}, {test::pack() / "md/md.xtc"}});
  const auto alone = open(test::pack() / "md/md.xtc");
  ASSERT_EQ(both->frame_count(), 51u);
  EXPECT_EQ(both->format(), "gro + xtc");
  const Frame frame = both->read(50);
  EXPECT_EQ(test::broken_promise(frame), "");
  EXPECT_TRUE(frame.find("element"));
  EXPECT_FALSE(frame.find("velocity")); // of the topology's own moment
  EXPECT_EQ(std::get<std::vector<double>>(frame.find("position")->values),
            std::get<std::vector<double>>(alone->read(50).find("position")->values));
  EXPECT_EQ(frame.time, alone->read(50).time);
}

TEST(Pairs, DifferentCountsAreRefused) {
  MOTE_NEED_PACK();
  const Diagnostic d = failure_of_files({{test::pack() / "md/ubiquitin.gro"}, {test::pack() / "md/md.xtc"}});
  EXPECT_EQ(d.code, "D026");
  EXPECT_THAT(d.text, HasSubstr("the topology has 1405 particles, frame 0 of the trajectory 17411"));
}

TEST(Pairs, NamesOfTrajectories) {
  EXPECT_TRUE(is_trajectory_name("a/b.XTC"));
  EXPECT_TRUE(is_trajectory_name("b.nc.gz"));
  EXPECT_FALSE(is_trajectory_name("b.gro"));
  EXPECT_FALSE(is_trajectory_name("xtc"));
}

TEST(Frames, ByIndexAndSlice) {
  EXPECT_EQ(frame_index(-1, 10, {}), 9u);
  EXPECT_EQ(frame_index(3, 10, {}), 3u);
  EXPECT_THAT(frame_list("2:5", 10, {}), ElementsAre(2, 3, 4));
  EXPECT_THAT(frame_list("::4", 10, {}), ElementsAre(0, 4, 8));
  EXPECT_THAT(frame_list("-2:", 10, {}), ElementsAre(8, 9));
  EXPECT_THAT(frame_list("3::-2", 10, {}), ElementsAre(3, 1));
  EXPECT_THAT(frame_list("::-5", 10, {}), ElementsAre(9, 4));
  EXPECT_THAT(frame_list("7,0:2,-1", 10, {}), ElementsAre(7, 0, 1, 9));
  EXPECT_THAT(frame_list("5:2", 10, {}), IsEmpty());
  EXPECT_THAT(frame_list("0:9223372036854775807:9223372036854775807", 10, {}), ElementsAre(0));
}

TEST(Frames, WhatIsNoList) {
  for (const char* words : {"", "a", "1:2:3:4", "1:2:0", "1,,2", "1.5", "::x"})
    EXPECT_EQ(exit_of([&] { (void)frame_list(words, 10, {"--frames"}); }), Exit::Usage) << words;
  const Diagnostic d = test::failure_of([] { (void)frame_list("12", 10, {"--frames"}); });
  EXPECT_EQ(d.code, "D017");
  EXPECT_THAT(d.text, HasSubstr("0 to 9"));
  EXPECT_EQ(test::failure_of([] { (void)frame_index(-11, 10, {}); }).code, "D017");
}

} // namespace
} // namespace mote::data
