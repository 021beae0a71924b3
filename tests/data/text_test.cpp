// SPDX-License-Identifier: MIT
// Words and numbers: exact, independent of the locale, and nothing but whole words.
#include "core/data/codes.hpp"
#include "core/data/text.hpp"
#include "tests/data/support.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <locale>
#include <set>

namespace mote::data {
namespace {

double real(std::string_view word) {
  double value = -12345;
  EXPECT_TRUE(parse_real(word, value)) << word;
  return value;
}

TEST(Text, RealsAreTheNearestDoubles) {
  for (const char* word : {"0", "-0.0", "1", "0.1", "-7.7723770000000005", "123456789.123456789",
                           "9007199254740993", "2.2250738585072014e-308", "1e22", "1e23", ".5", "5.",
                           "0.000000000000000000000001", "179769313486231570000000000e282", "4.9e-324",
                           "33333333333333333333333333.1", "1.7976931348623157e308"})
    EXPECT_EQ(real(word), std::strtod(word, nullptr)) << word;
  EXPECT_TRUE(std::signbit(real("-0")));
  std::uint64_t seed = 1;
  for (int i = 0; i < 20000; ++i) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    const double value = static_cast<double>(static_cast<std::int64_t>(seed)) *
                         std::pow(10.0, static_cast<int>(seed >> 58) - 32);
    for (const std::string& word :
         {fmt::format("{}", value), fmt::format("{:.6f}", value), fmt::format("{:.3e}", value)})
      ASSERT_EQ(real(word), std::strtod(word.c_str(), nullptr)) << word;
  }
}

TEST(Text, RealsOfOtherLanguages) {
  EXPECT_EQ(real("+1.5"), 1.5);
  EXPECT_EQ(real("1.5D-3"), 1.5e-3);
  EXPECT_EQ(real("-2d2"), -200);
  EXPECT_TRUE(std::isnan(real("NaN")));
  EXPECT_EQ(real("-Infinity"), -INFINITY);
  EXPECT_EQ(real("1e999"), INFINITY);
  EXPECT_EQ(real("-1e999"), -INFINITY);
  EXPECT_EQ(real("1e-999"), 0.0);
  EXPECT_EQ(real("0.0000001e-320"), 0.0);
  EXPECT_EQ(real("1e99999999999999999999"), INFINITY);
}

TEST(Text, WhatIsNoNumber) {
  double value = 0;
  std::int64_t integer = 0;
  std::uint64_t count = 0;
  bool truth = false;
  for (const char* word :
       {"", "-", "+", ".", "1,5", "1.5x", "0x10", "1e", "--1", "+-1", "1.2.3", "e5", "****", "1 2", "1_000"})
    EXPECT_FALSE(parse_real(word, value)) << word;
  for (const char* word : {"", "1.0", "9223372036854775808", "1e3", "+-3", "+"})
    EXPECT_FALSE(parse_integer(word, integer)) << word;
  for (const char* word : {"", "-1", "+1", "18446744073709551616", "3.0"})
    EXPECT_FALSE(parse_count(word, count)) << word;
  for (const char* word : {"", "ok", "1", "yes"}) EXPECT_FALSE(parse_logical(word, truth)) << word;
  EXPECT_TRUE(parse_integer("-9223372036854775808", integer));
  EXPECT_TRUE(parse_count("18446744073709551615", count));
}

// A decimal comma and dots between thousands everywhere that asks the locale.
struct German : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Text, TheLocaleDoesNotMatter) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new German));
  const bool german = std::setlocale(LC_NUMERIC, "de_DE.UTF-8") != nullptr; // as well, where it is installed
  const Frame frame = test::read_text("1\nProperties=pos:R:3\n1234.5 1e-3 -0.25\n");
  const Frame table = test::read_text("x,y,z\n1.5,2000.25,3\n");
  const std::string message = test::failure_of_text("123456\n\nO 1 2 3\n").text;
  std::setlocale(LC_NUMERIC, "C");
  std::locale::global(before);
  EXPECT_EQ(frame.find("position")->number(0, 0), 1234.5) << german;
  EXPECT_EQ(table.find("position")->number(0, 1), 2000.25);
  EXPECT_NE(message.find("123456 particles"), std::string::npos) << message;
}

TEST(Text, CursorKnowsLines) {
  Cursor cursor("a\r\n\n b\nlast");
  EXPECT_EQ(cursor.next()->text, "a");
  cursor.skip_blank();
  EXPECT_EQ(cursor.peek()->number, 3u);
  EXPECT_EQ(cursor.skip(9), 2u);
  EXPECT_TRUE(cursor.at_end());
  EXPECT_FALSE(cursor.next());
}

TEST(Text, WordsForMessagesAreShort) {
  EXPECT_EQ(shown("a\x01z"), "'a?z'");
  EXPECT_EQ(shown(std::string(100, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(Codes, EachOneOnce) {
  std::set<std::string_view> seen;
  for (const CodeLine& entry : code_table) {
    EXPECT_TRUE(seen.insert(entry.code).second) << entry.code;
    EXPECT_EQ(entry.code.size(), 4u);
    EXPECT_FALSE(entry.line.empty());
  }
}

} // namespace
} // namespace mote::data
