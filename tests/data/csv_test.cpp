// SPDX-License-Identifier: MIT
// Tables: delimiters, rows of names, units, missing values; then one fault at a time.
#include "tests/data/support.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace mote::data {
namespace {

using test::failure_of_text;
using test::read_text;
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<double>& reals(const Frame& frame, std::string_view name) {
  return std::get<std::vector<double>>(frame.find(name)->values);
}

TEST(Csv, EveryDelimiterWithAndWithoutNames) {
  for (const std::string d : {",", ";", "\t", " ", ", ", "  "}) {
    auto row = [&](const char* a, const char* b, const char* c) { return a + d + b + d + c + "\n"; };
    const std::string rows = row("1", "2.5", "-3") + row("4", "5", "6e2");
    for (const std::string& text :
         std::vector<std::string>{row("x", "y", "z") + rows, rows, "# about\n\n# x y z\n" + rows}) {
      const auto source = test::open_text(text);
      EXPECT_EQ(source->format(), "csv");
      EXPECT_EQ(source->frame_count(), 1u);
      EXPECT_THAT(reals(source->read(0), "position"), ElementsAre(1, 2.5, -3, 4, 5, 600)) << text;
    }
  }
}

TEST(Csv, FourNumbersAreARadiusToo) {
  const Frame frame = read_text("1 2 3 0.5\n4 5 6 0.25\n");
  EXPECT_THAT(reals(frame, "radius"), ElementsAre(0.5, 0.25));
}

TEST(Csv, MoreNumbersWithoutNamesWarn) {
  const auto source = test::open_text("1 2 3 4 5 6\n4 5 6 7 8 9\n");
  const Frame frame = source->read(0);
  EXPECT_FALSE(frame.find("radius"));
  EXPECT_EQ(frame.find("column_6")->number(1), 9);
  EXPECT_TRUE(source->warnings().has("D024"));
}

TEST(Csv, NamesTypesUnitsQuotesAndMissingValues) {
  const Frame frame = read_text("ID,Name,X (nm),Y (nm),Z (nm),vx,vy,vz,Diameter [nm],note,score\n"
                                "1,\"a, \"\"b\"\"\",1,2,3,.1,.2,.3,4,,7\n"
                                "# a comment\n\n"
                                "2,plain,4,5,,1,1,1,2,\"\",NA\n",
                                "csv");
  EXPECT_EQ(frame.count, 2u);
  EXPECT_EQ(frame.find("position")->unit, "nm");
  EXPECT_TRUE(std::isnan(frame.find("position")->number(1, 2)));
  EXPECT_THAT(reals(frame, "radius"), ElementsAre(2, 1));
  EXPECT_EQ(frame.find("radius")->unit, "nm");
  EXPECT_EQ(frame.find("id")->type(), ColumnType::Int);
  EXPECT_EQ(std::get<TextColumn>(frame.find("Name")->values).at(0), "a, \"b\"");
  EXPECT_EQ(frame.find("score")->type(), ColumnType::Double); // an integer column with a hole
  EXPECT_TRUE(std::isnan(frame.find("score")->number(1)));
}

TEST(Csv, NamesOfOtherPrograms) {
  EXPECT_THAT(reals(read_text("\"Points:0\",\"Points:1\",\"Points:2\",\"Velocity:0\",\"Velocity:1\","
                              "\"Velocity:2\"\n1,2,3,4,5,6\n"),
                    "velocity"),
              ElementsAre(4, 5, 6));
  EXPECT_THAT(reals(read_text("vel_x,vel_y,vel_z,pos_x,pos_y,pos_z\n1,2,3,4,5,6\n"), "position"),
              ElementsAre(4, 5, 6));
  EXPECT_THAT(reals(read_text("x,y,z,quat_x,quat_y,quat_z,quat_w\n0,0,0,1,2,3,4\n"), "orientation"),
              ElementsAre(4, 1, 2, 3));
  EXPECT_EQ(std::get<TextColumn>(read_text("species,x,y,z\nFe,0,0,0\n").find("element")->values).at(0), "Fe");
}

TEST(Csv, ColumnsWidenFarBehindTheFirstRow) {
  std::string text = "x,y,z,a,b\n";
  for (int i = 0; i < 30000; ++i)
    text += fmt::format("{},0,0,{},{}\n", i, i == 20000 ? "0.5" : "1", i == 29999 ? "end" : "1");
  const Frame frame = read_text(text);
  EXPECT_EQ(frame.find("a")->type(), ColumnType::Double);
  EXPECT_EQ(frame.find("a")->number(20000), 0.5);
  EXPECT_EQ(std::get<TextColumn>(frame.find("b")->values).at(29999), "end");
  EXPECT_EQ(frame.find("position")->number(29999), 29999);
}

TEST(Csv, ATrailingDelimiterAddsNothing) {
  EXPECT_EQ(read_text("x,y,z,\n1,2,3,\n4,5,6\n").columns.size(), 1u);
  EXPECT_EQ(read_text("1,2,3,\n4,5,6,\n").find("position")->number(1, 2), 6);
}

TEST(Csv, QuantitiesAreDoublesEvenIfWhole) {
  const Frame frame = read_text("x,y,z,radius,count\n1,2,3,4,5\n");
  EXPECT_EQ(frame.find("radius")->type(), ColumnType::Double);
  EXPECT_EQ(frame.find("count")->type(), ColumnType::Int);
  EXPECT_EQ(failure_of_text("x,y,z,radius\n1,2,3,4\n1,2,3,big\n").code, "D012");
}

TEST(Csv, Refusals) {
  const Diagnostic word = failure_of_text("x,y,z\n1,2,3\n4,five,6\n");
  EXPECT_EQ(word.code, "D012");
  EXPECT_EQ(to_string(word.loc), "input:3:3");
  EXPECT_THAT(word.text, HasSubstr("'five' is not a number ('y')"));
  EXPECT_EQ(failure_of_text("x,y,z\n1,2,3\n4,5\n").code, "D010");
  EXPECT_EQ(failure_of_text("x,y,z\n1,2,3\n4,5,6,7\n").code, "D011");
  EXPECT_EQ(failure_of_text("x,y,z\n1,2,\"3\n").code, "D021");
  const Diagnostic flat = failure_of_text("x,y,mass\n1,2,3\n", "csv");
  EXPECT_EQ(flat.code, "D013");
  EXPECT_EQ(to_string(flat.loc), "input:1");
  EXPECT_THAT(flat.hints[0], HasSubstr("x, y, mass"));
  EXPECT_EQ(failure_of_text("1;2\n3;4\n", "csv").code, "D013");
  EXPECT_EQ(failure_of_text("# only words\n", "csv").code, "D002");
  EXPECT_EQ(test::failure_of([] { (void)read_text("x,y,z\n1,2,3\n", "csv", 1); }).code, "D017");
}

TEST(Csv, AMillionColumns) {
  std::string row = "1";
  for (int i = 0; i < 1'000'000; ++i) row += ",1";
  const Diagnostic d = failure_of_text(row + "\n", "csv");
  EXPECT_EQ(d.code, "D016");
  EXPECT_THAT(d.text, HasSubstr("1000001 columns"));
  std::string names = "x,y,z";
  for (int i = 0; i < 1'000'000; ++i) names += ",a";
  EXPECT_EQ(failure_of_text(names + "\n1,2,3\n", "csv").code, "D016");
}

} // namespace
} // namespace mote::data
