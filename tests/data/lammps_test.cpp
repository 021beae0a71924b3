// SPDX-License-Identifier: MIT
// LAMMPS dumps: every form of columns and boxes, then one fault at a time.
#include "tests/data/files.hpp"
#include "tests/data/support.hpp"

#include <gmock/gmock.h>

namespace mote::data {
namespace {

using test::failure_of_text;
using test::read_text;
using testing::ElementsAre;
using testing::HasSubstr;

std::string dump(std::string_view columns, std::string_view rows, std::string_view count = "2",
                 std::string_view box = "BOX BOUNDS pp ff pm\n-1 3\n0 10\n2 4\n") {
  return fmt::format("ITEM: TIMESTEP\n42\nITEM: NUMBER OF ATOMS\n{}\nITEM: {}ITEM: ATOMS {}\n{}", count, box,
                     columns, rows);
}
const std::vector<double>& reals(const Frame& frame, std::string_view name) {
  return std::get<std::vector<double>>(frame.find(name)->values);
}
std::string property(const Frame& frame, std::string_view key) {
  for (const auto& [name, value] : frame.properties)
    if (name == key) return value;
  return {};
}

TEST(LammpsDump, AnyColumnOrder) {
  const Frame frame =
      read_text(dump("z vy id element x ix mol y iy iz vx vz type q diameter c_peatom",
                     "3 0.2 7 Fe 1 -1 5 2 0 2 0.1 0.3 4 -0.5 3 -7.25\n6 5 3 O 4 0 6 5 0 0 4 6 1 1 1 nan\n"));
  EXPECT_EQ(test::broken_promise(frame), "");
  EXPECT_THAT(reals(frame, "position"), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(reals(frame, "velocity"), ElementsAre(0.1, 0.2, 0.3, 4, 5, 6));
  EXPECT_THAT(std::get<std::vector<std::int64_t>>(frame.find("image")->values),
              ElementsAre(-1, 0, 2, 0, 0, 0));
  EXPECT_THAT(std::get<std::vector<std::int64_t>>(frame.find("id")->values),
              ElementsAre(7, 3)); // as in the file
  EXPECT_EQ(frame.find("molecule")->number(1), 6);
  EXPECT_EQ(frame.find("type")->number(0), 4);
  EXPECT_EQ(std::get<TextColumn>(frame.find("element")->values).at(1), "O"); // type and element are both kept
  EXPECT_THAT(reals(frame, "radius"), ElementsAre(1.5, 0.5));
  EXPECT_THAT(reals(frame, "charge"), ElementsAre(-0.5, 1));
  EXPECT_EQ(frame.find("c_peatom")->number(0), -7.25);
  EXPECT_EQ(frame.step, 42);
  EXPECT_EQ(frame.box->origin, glm::dvec3(-1, 0, 2));
  EXPECT_EQ(frame.box->edges, glm::dmat3({4, 0, 0}, {0, 10, 0}, {0, 0, 2}));
  EXPECT_EQ(frame.box->periodic, glm::bvec3(true, false, false));
  EXPECT_EQ(property(frame, "position_columns"), "x y z");
}

TEST(LammpsDump, OrientationsShapesAndIndexedColumns) {
  const Frame frame = read_text(
      dump("x y z c_q[1] c_q[2] c_q[3] c_q[4] c_shape[1] c_shape[2] c_shape[3] c_mine[2] c_mine[1] f_one[3]",
           "0 0 0 1 2 3 4 2 4 6 20 10 5\n", "1"));
  EXPECT_THAT(reals(frame, "orientation"), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(reals(frame, "shape"), ElementsAre(1, 2, 3)); // half axes
  EXPECT_THAT(reals(frame, "c_mine"), ElementsAre(10, 20));
  EXPECT_THAT(reals(frame, "f_one[3]"), ElementsAre(5));
}

TEST(LammpsDump, PositionFormsInOrderOfPreference) {
  const Frame all = read_text(dump("xu yu zu xs ys zs x y z", "7 8 9 0.5 0.5 0.5 1 2 3\n", "1"));
  EXPECT_THAT(reals(all, "position"), ElementsAre(1, 2, 3));
  EXPECT_THAT(reals(all, "position_scaled"), ElementsAre(0.5, 0.5, 0.5));
  EXPECT_THAT(reals(all, "position_unwrapped"), ElementsAre(7, 8, 9));
  const Frame scaled = read_text(dump("xu yu zu xs ys zs", "7 8 9 0.5 0.5 0.5\n", "1"));
  EXPECT_THAT(reals(scaled, "position"), ElementsAre(1, 5, 3));
  EXPECT_EQ(property(scaled, "position_columns"), "xs ys zs");
  EXPECT_THAT(reals(read_text(dump("xsu ysu zsu xu yu zu", "7 8 9 1 2 3\n", "1")), "position"),
              ElementsAre(1, 2, 3));
  EXPECT_THAT(reals(read_text(dump("xsu ysu zsu", "2 -1 0\n", "1")), "position"), ElementsAre(7, -10, 2));
  const Frame file = open(test::fixture("dump_xyz_with_xs_xu.dump"))->read(0);
  EXPECT_EQ(file.find("position")->number(1, 0), 2.0);
  EXPECT_EQ(file.find("position_unwrapped")->number(2, 0), -3.5);
}

TEST(LammpsDump, TriclinicBoundsAreThoseOfTheCorners) {
  const Frame left = read_text(
      dump("xs ys zs", "1 1 1\n0 0 0\n", "2", "BOX BOUNDS xy xz yz pp pp pp\n-2 14 -3\n0 12 -1\n0 8 2\n"));
  // low x = -2 - min(0, -3, -1, -4) = 2, high x = 14 - max(0, ...) = 14; high y = 12 - 2
  EXPECT_EQ(left.box->origin, glm::dvec3(2, 0, 0));
  EXPECT_EQ(left.box->edges, glm::dmat3({12, 0, 0}, {-3, 10, 0}, {-1, 2, 8}));
  EXPECT_THAT(reals(left, "position"), ElementsAre(2 + 12 - 3 - 1, 12, 8, 2, 0, 0));
  const Frame right = read_text(
      dump("xs ys zs", "1 1 1\n0 0 0\n", "2", "BOX BOUNDS xy xz yz pp pp pp\n-2 14 3\n0 12 1\n0 8 -2\n"));
  EXPECT_EQ(right.box->origin, glm::dvec3(-2, 2, 0)); // high x = 14 - (3 + 1), low y = 0 + 2
  EXPECT_EQ(right.box->edges, glm::dmat3({12, 0, 0}, {3, 10, 0}, {1, -2, 8}));
}

TEST(LammpsDump, TriclinicPackedFile) {
  const auto source = open(test::fixture("tri_box_big.dump.gz"));
  const Frame frame = source->read(0);
  EXPECT_EQ(source->format(), "lammps-dump");
  EXPECT_EQ(frame.count, 27u);
  EXPECT_NEAR(frame.box->edges[0].x, 13.0499978865, 1e-9);
  EXPECT_EQ(frame.find("mass")->number(26), 12.0107);
}

TEST(LammpsDump, GeneralBoxAndOldBox) {
  const Frame general = read_text(
      dump("x y z", "1 1 1\n", "1", "BOX BOUNDS abc origin pp pp ff\n1 2 3 10\n4 5 6 20\n7 8 9 30\n"));
  EXPECT_EQ(general.box->origin, glm::dvec3(10, 20, 30));
  EXPECT_EQ(general.box->edges[1], glm::dvec3(4, 5, 6));
  EXPECT_FALSE(general.box->periodic.z);
  EXPECT_EQ(read_text(dump("x y z", "1 1 1\n", "1", "BOX BOUNDS\n0 1\n0 1\n0 1\n")).box->periodic,
            glm::bvec3(true));
}

TEST(LammpsDump, UnitsAndTimeStandBeforeTheStep) {
  const std::string one = dump("x y z", "1 1 1\n", "1");
  const auto source = test::open_text("ITEM: UNITS\nmetal\nITEM: TIME\n0.5\n" + one + "ITEM: TIME\n0.75\n" +
                                      dump("z y x id", "4 5 6 1\n", "1"));
  EXPECT_EQ(source->read(0).time, 0.5);
  EXPECT_EQ(property(source->read(0), "units"), "metal");
  EXPECT_EQ(source->frame_count(), 2u);
  EXPECT_EQ(source->read(1).time, 0.75);
  EXPECT_THAT(reals(source->read(1), "position"), ElementsAre(6, 5, 4)); // columns may change
}

TEST(LammpsDump, FramesInAnyOrder) {
  const auto source = open(test::fixture("dump_multiframe_5x8.dump"));
  EXPECT_EQ(source->read(4).step, 400);
  EXPECT_EQ(source->read(1).step, 100);
  EXPECT_EQ(source->frame_count(), 5u);
  EXPECT_EQ(source->read(3).find("position")->number(7, 0), 5.0);
}

TEST(LammpsDump, UnknownColumnsWidenToWhatTheyHold) {
  const Frame frame = read_text(dump("x y z mark", "1 1 1 1\n2 2 2 1.5\n3 3 3 red\n", "3"));
  EXPECT_EQ(frame.find("mark")->type(), ColumnType::Text);
  EXPECT_EQ(std::get<TextColumn>(frame.find("mark")->values).at(0), "1");
  EXPECT_EQ(read_text(dump("x y z mark", "1 1 1 1\n2 2 2 1.5\n")).find("mark")->number(1), 1.5);
}

TEST(LammpsDump, ACutLastFrameIsLeftOut) {
  const std::string two = dump("x y z", "1 1 1\n2 2 2\n") + dump("x y z", "1 1 1\n");
  const auto source = test::open_text(two);
  EXPECT_EQ(source->frame_count(), 1u);
  ASSERT_TRUE(source->warnings().has("D022"));
  EXPECT_THAT(to_string(source->warnings()), HasSubstr("frame 1 is cut off"));
}

TEST(LammpsDump, Refusals) {
  EXPECT_EQ(failure_of_text(dump("id x y z", "1 1 1 1\n1 2 2 2\n")).code, "D015");
  EXPECT_EQ(
      failure_of_text(
          dump("id x y z", "1 1 1 1\n9000000000000000000 2 2 2\n-9000000000000000000 0 0 0\n1 0 0 0\n", "4"))
          .code,
      "D015");
  EXPECT_EQ(failure_of_text(dump("id x y z", "1 1 1 1\n2 2 2\n")).code, "D010");
  EXPECT_EQ(failure_of_text(dump("id x y z", "1 1 1 1\n2.5 2 2 2\n")).code, "D012");
  EXPECT_EQ(failure_of_text(dump("x y z", "1 1 1\n2 2 2\n3 3 3\n")).code, "D007");
  EXPECT_EQ(failure_of_text(dump("x y z", "1 1 1\n2 2 2\n", "9223372036854775808")).code, "D006");
  EXPECT_EQ(failure_of_text(dump("x y z", "1 1 1\n2 2 2\n", "two")).code, "D008");
  EXPECT_EQ(
      failure_of_text(dump("x y z", "1 1 1\n2 2 2\n", "2", "BOX BOUNDS pp pp pp\n0 -1\n0 1\n0 1\n")).code,
      "D014");
  EXPECT_EQ(
      failure_of_text(dump("x y z", "1 1 1\n2 2 2\n", "2", "BOX BOUNDS pp pp pp\n0 inf\n0 1\n0 1\n")).code,
      "D014");
  EXPECT_EQ(failure_of_text("ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS x y z\n1 1 1\n").code,
            "D008");
  const Diagnostic d = failure_of_text(dump("id type xs ys vx", "1 1 1 1 1\n", "1"));
  EXPECT_EQ(d.code, "D013");
  EXPECT_THAT(d.hints[0], HasSubstr("id, type, xs, ys, vx"));
  std::string many = "x y z";
  for (int i = 0; i < 1'000'000; ++i) many += " v";
  EXPECT_EQ(failure_of_text(dump(many, "1 1 1\n", "1")).code, "D016");
}

} // namespace
} // namespace mote::data
