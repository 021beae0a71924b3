// SPDX-License-Identifier: MIT
// XYZ and extended XYZ: what the columns, the comment and the frames become; then one fault at a time.
#include "tests/data/files.hpp"
#include "tests/data/support.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace mote::data {
namespace {

using test::failure_of_text;
using test::read_text;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string extended =
    "2\n"
    "Lattice=\"4 0 0 1 5 0 0 2 6\" Origin=\"-1 -2 -3\" pbc=\"T F T\" Time=1.5 step=7 energy=-3.25 "
    "note='two words' flag Properties=species:S:1:pos:R:3:velo:R:3:id:I:1:fixed:L:1:tag_name:S:1\n"
    "Na 1 2 3 0.1 0.2 0.3 11 T left\n"
    "Cl +4 5.0D0 -6e-1 .4 5. 6 12 F right\n";

TEST(Xyz, ExtendedGivesEveryColumn) {
  const auto source = test::open_text(extended);
  EXPECT_EQ(source->format(), "xyz");
  const Frame frame = source->read(0);
  EXPECT_EQ(test::broken_promise(frame), "");
  EXPECT_EQ(frame.count, 2u);
  EXPECT_THAT(std::get<std::vector<double>>(frame.find("position")->values),
              ElementsAre(1, 2, 3, 4, 5, -0.6));
  EXPECT_THAT(std::get<std::vector<double>>(frame.find("velocity")->values),
              ElementsAre(0.1, 0.2, 0.3, 0.4, 5, 6));
  EXPECT_THAT(std::get<std::vector<std::int64_t>>(frame.find("id")->values), ElementsAre(11, 12));
  EXPECT_THAT(std::get<std::vector<std::int64_t>>(frame.find("fixed")->values), ElementsAre(1, 0));
  EXPECT_EQ(std::get<TextColumn>(frame.find("element")->values).at(1), "Cl");
  EXPECT_EQ(std::get<TextColumn>(frame.find("tag_name")->values).at(0), "left");
  EXPECT_EQ(source->frame_count(), 1u);
}

TEST(Xyz, ExtendedGivesBoxTimeAndWords) {
  const Frame frame = read_text(extended);
  ASSERT_TRUE(frame.box);
  EXPECT_EQ(frame.box->edges[1], glm::dvec3(1, 5, 0));
  EXPECT_EQ(frame.box->edges[2], glm::dvec3(0, 2, 6));
  EXPECT_EQ(frame.box->origin, glm::dvec3(-1, -2, -3));
  EXPECT_EQ(frame.box->periodic, glm::bvec3(true, false, true));
  EXPECT_EQ(frame.time, 1.5);
  EXPECT_EQ(frame.step, 7);
  using Pair = std::pair<std::string, std::string>;
  EXPECT_THAT(frame.properties,
              ElementsAre(Pair("energy", "-3.25"), Pair("note", "two words"), Pair("flag", "true")));
}

TEST(Xyz, BracketsQuotesAndBackslashes) {
  const Frame frame = read_text(
      "1\nLattice = [[4,0,0],[1,5,0],[0,2,6]] virial=[[1, 2], [3, 4]] note=\"a \\\"b\\\"\" pbc=[T,F,T]\n"
      "O 1 2 3\n");
  EXPECT_EQ(frame.box->edges, glm::dmat3({4, 0, 0}, {1, 5, 0}, {0, 2, 6}));
  EXPECT_FALSE(frame.box->periodic.y);
  using Pair = std::pair<std::string, std::string>;
  EXPECT_THAT(frame.properties, ElementsAre(Pair("virial", "[1, 2], [3, 4]"), Pair("note", "a \"b\"")));
}

TEST(Xyz, PlainIgnoresTheRestOfALine) {
  const Frame frame = read_text("2\nwhat energy=3 is\nO 1 2 3 rest of it\nHw 4 5 6\n");
  EXPECT_FALSE(frame.find("element")); // Hw is no element: the labels are types
  EXPECT_EQ(std::get<TextColumn>(frame.find("type")->values).at(1), "Hw");
  EXPECT_EQ(frame.properties[0].second, "what energy=3 is");
  EXPECT_FALSE(frame.box);
}

TEST(Xyz, PlainLabelsMayBeNumbersOrMissing) {
  EXPECT_EQ(read_text("1\n\n6 1 2 3\n").find("type")->number(0), 6);
  EXPECT_EQ(std::get<TextColumn>(read_text("2\n\n6 1 2 3\nX 1 2 3\n").find("type")->values).at(0), "6");
  const Frame bare = read_text("1\n\n1 2 3\n");
  EXPECT_EQ(bare.columns.size(), 1u);
  EXPECT_EQ(bare.find("position")->number(0, 2), 3);
}

TEST(Xyz, AtomicNumbersBecomeSymbols) {
  const Frame frame = read_text("2\nProperties=pos:R:3:Z:I:1\n0 0 0 26\n1 1 1 8\n");
  EXPECT_EQ(std::get<TextColumn>(frame.find("element")->values).at(0), "Fe");
  EXPECT_EQ(read_text("1\nProperties=pos:R:3:Z:I:1\n0 0 0 260\n").find("atomic_number")->number(0), 260);
}

TEST(Xyz, DiameterIsHalvedAndQuaternionsAreTurned) {
  const Frame frame = read_text("1\nProperties=pos:R:3:diameter:R:1:orientation:R:4\n0 0 0 3 1 2 3 4\n");
  EXPECT_EQ(frame.find("radius")->number(0), 1.5);
  EXPECT_THAT(std::get<std::vector<double>>(frame.find("orientation")->values),
              ElementsAre(4, 1, 2, 3)); // w x y z
  EXPECT_EQ(frame.find("orientation")->unit, "wxyz");
  const Frame both = read_text("1\nProperties=pos:R:3:diameter:R:1:radius:R:1\n0 0 0 3 9\n");
  EXPECT_EQ(both.find("radius")->number(0), 9);
  EXPECT_EQ(both.find("diameter")->number(0), 3);
}

TEST(Xyz, FramesMayDifferAndEndInBlankLines) {
  const auto source =
      test::open_text("1\n\nO 1 2 3\n\n2\nLattice=\"9 8 7\"\nH 4 5 6\nH 7 8 9\n0\nnone\n\n\n");
  EXPECT_EQ(source->read(1).box->edges[1], glm::dvec3(0, 8, 0));
  EXPECT_EQ(source->frame_count(), 3u);
  EXPECT_EQ(source->read(2).count, 0u);
  EXPECT_EQ(source->read(0).find("position")->number(0), 1);
  EXPECT_EQ(open(test::fixture("spaces.xyz"))->frame_count(), 1u);
}

TEST(Xyz, NanPositionsAreKept) {
  const Frame frame = read_text("2\n\nO nan 2 -inf\nO 1 NaN 3\n");
  EXPECT_TRUE(std::isnan(frame.find("position")->number(0, 0)));
  EXPECT_EQ(frame.find("position")->number(0, 2), -INFINITY);
}

TEST(Xyz, LineEndsOfAnySystem) {
  for (const char* text : {"1\r\n\r\nO 1 2 3\r\n", "1\r\rO 1 2 3\r", "1\n\r\nO 1 2 3",
                           "\xef\xbb\xbf"
                           "1\n\nO\t1 \t2  3 \r\n"}) {
    const Frame frame = read_text(text, "xyz");
    EXPECT_EQ(frame.find("position")->number(0, 2), 3) << text;
    EXPECT_EQ(std::get<TextColumn>(frame.find("element")->values).at(0), "O");
  }
}

TEST(Xyz, CountsThatLie) {
  EXPECT_EQ(failure_of_text("3\n\nO 1 2 3\nO 1 2 3\n").code, "D006");
  const Diagnostic more = failure_of_text("1\n\nO 1 2 3\nO 1 2 3\n");
  EXPECT_EQ(more.code, "D007");
  EXPECT_THAT(more.text, HasSubstr("'O 1 2 3' follows the 1 particles"));
  EXPECT_EQ(failure_of_text("9223372036854775808\n\nO 1 2 3\n").code, "D006");
  const Diagnostic beyond = failure_of_text("18446744073709551616\n\nO 1 2 3\n", "xyz");
  EXPECT_EQ(beyond.code, "D008");
  EXPECT_THAT(beyond.text, HasSubstr("'18446744073709551616'"));
  EXPECT_EQ(failure_of_text("-1\n\nO 1 2 3\n", "xyz").code, "D008");
  EXPECT_EQ(failure_of_text("2\n", "xyz").code, "D006");
}

TEST(Xyz, BadValuesNameLineAndColumn) {
  const Diagnostic d = failure_of_text("2\n\nO 1 2 3\nO 1 2,5 3\n");
  EXPECT_EQ(d.code, "D012");
  EXPECT_EQ(to_string(d.loc), "input:4:5");
  EXPECT_THAT(d.text, HasSubstr("'2,5' is not a number ('y')"));
  EXPECT_THAT(d.hints[0], HasSubstr("decimal point"));
  EXPECT_EQ(failure_of_text("1\n\nO 1 2\n").code, "D010");
  EXPECT_EQ(failure_of_text("1\nProperties=pos:R:3\n1 2 3 4\n").code, "D011");
}

TEST(Xyz, BadComments) {
  EXPECT_EQ(failure_of_text("1\nLattice=\"1 0 0 0 1 0 0 0\"\nO 1 2 3\n").code, "D014");
  EXPECT_EQ(failure_of_text("1\nLattice=\"1 0 0 0 1 0 0 0 nan\"\nO 1 2 3\n").code, "D014");
  EXPECT_EQ(failure_of_text("1\nLattice=\"1 2 3\" pbc=\"T maybe F\"\nO 1 2 3\n").code, "D014");
  EXPECT_EQ(failure_of_text("1\nLattice=\"1 2 3\" Origin=\"1 2\"\nO 1 2 3\n").code, "D014");
  const Diagnostic open_quote = failure_of_text("1\nLattice=\"1 2 3\nO 1 2 3\n");
  EXPECT_EQ(open_quote.code, "D021");
  EXPECT_EQ(to_string(open_quote.loc), "input:2:9");
  EXPECT_EQ(failure_of_text("1\nProperties=species:S:1:pos:R:3:many:R:1000000\nO 1 2 3\n").code, "D016");
  EXPECT_EQ(failure_of_text("1\nProperties=species:S\nO 1 2 3\n").code, "D009");
  const Diagnostic no_place = failure_of_text("1\nProperties=species:S:1:velo:R:3\nO 1 2 3\n");
  EXPECT_EQ(no_place.code, "D013");
  EXPECT_THAT(no_place.hints[0], HasSubstr("species, velo(3)"));
}

TEST(Xyz, AMillionColumns) {
  std::string line = "O";
  for (int i = 0; i < 1'000'000; ++i) line += " 1";
  EXPECT_EQ(read_text("1\n\n" + line + "\n").count, 1u); // plain: the rest is ignored
  EXPECT_EQ(failure_of_text("1\nProperties=species:S:1:pos:R:3\n" + line + "\n").code, "D011");
}

TEST(Xyz, ManyRowsReadByAllCoresAreTheSame) {
  std::string text = "50000\nProperties=name:S:1:pos:R:3:id:I:1\n";
  for (int i = 0; i < 50000; ++i) text += fmt::format("n{} {} {}.5 -{}e-3 {}\n", i % 777, i, i, i, i);
  const Frame frame = read_text(text);
  const Column& position = *frame.find("position");
  const auto& names = std::get<TextColumn>(frame.find("name")->values);
  EXPECT_EQ(names.dictionary.size(), 777u);
  for (std::uint64_t i = 0; i < 50000; ++i) {
    ASSERT_EQ(position.number(i, 0), static_cast<double>(i));
    ASSERT_EQ(position.number(i, 1), static_cast<double>(i) + 0.5);
    ASSERT_EQ(names.at(i), fmt::format("n{}", i % 777));
    ASSERT_EQ(frame.find("id")->number(i), static_cast<double>(i));
  }
  text.replace(text.find("45000.5"), 7, "bad.bad"); // of two bad rows the first is named
  text.replace(text.find(" 40015.5"), 8, " wrong");
  const Diagnostic d = failure_of_text(text);
  EXPECT_EQ(d.loc.line, 40018u);
}

} // namespace
} // namespace mote::data
