// SPDX-License-Identifier: MIT
// Selections: what they mean row by row, and where they are wrong.
#include "core/scene/expression.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace mote {
namespace {

using testing::HasSubstr;

data::Frame frame() {
  data::Frame f;
  f.count = 4;
  f.columns.push_back({"position", 3, std::vector<double>{0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}, {}});
  f.columns.push_back({"velocity", 3, std::vector<double>{3, 4, 0, 0, 0, 0, 1, 2, 2, NAN, 0, 0}, {}});
  f.columns.push_back({"element", 1, data::TextColumn{{0, 1, 1, 0}, {"O", "H"}}, {}});
  f.columns.push_back({"id", 1, std::vector<std::int64_t>{10, 20, 30, 40}, {}});
  f.columns.push_back({"c_q[1]", 1, std::vector<double>{-1, 0.5, 2, 1e3}, {}});
  return f;
}

std::string rows(const std::string& text) {
  Diagnostics diagnostics;
  std::string out;
  for (const bool b : select_rows(text, frame(), {"s.toml", 7, 11}, diagnostics)) out += b ? '1' : '0';
  return diagnostics.empty() ? out : to_string(diagnostics);
}

struct Meaning {
  const char *text, *rows;
};
class Selection : public testing::TestWithParam<Meaning> {};
TEST_P(Selection, MeansTheseRows) { EXPECT_EQ(rows(GetParam().text), GetParam().rows) << GetParam().text; }
INSTANTIATE_TEST_SUITE_P(All, Selection,
                         testing::Values(Meaning{"element == \"O\" && speed > 2", "1000"}, Meaning{"type == \"O\"", "1001"},
                                         Meaning{"element != 'O'", "0110"}, Meaning{"element in ['H', 'C']", "0110"},
                                         Meaning{"id in [10, 40, 7]", "1001"}, Meaning{"x >= 1 and not (id == 30)", "0101"},
                                         Meaning{"speed == 5 || speed == 3", "1010"}, Meaning{"speed < 1", "0100"}, // NaN is not
                                         Meaning{"velocity.y > 1", "1010"}, Meaning{"c_q[1] > 1", "0011"}, Meaning{"index % 2 == 1", "0101"},
                                         Meaning{"2 + 3 * 2 ^ 2 == 14", "1111"}, Meaning{"-2 ^ 2 == -4", "1111"}, Meaning{"2 ^ -1 == 0.5", "1111"},
                                         Meaning{"7 - 2 - 1 == 4", "1111"}, Meaning{"abs(x - 2) <= 1", "0111"}, Meaning{"max(x, 2) == 2", "1110"},
                                         Meaning{"-5 % 3 == 1", "1111"}, Meaning{"true || false && false", "1111"},
                                         Meaning{"!true || true", "1111"}, Meaning{"1e3 == c_q[1]", "0001"}, Meaning{".5 == c_q[1]", "0100"}));

struct Wrong {
  const char *text, *code, *words;
  std::uint64_t column;
};
class WrongSelection : public testing::TestWithParam<Wrong> {};
TEST_P(WrongSelection, IsLocatedAndExplained) {
  Diagnostics diagnostics;
  EXPECT_TRUE(select_rows(GetParam().text, frame(), {"s.toml", 7, 11}, diagnostics).empty());
  ASSERT_EQ(diagnostics.list().size(), 1u);
  const Diagnostic& d = diagnostics.list()[0];
  EXPECT_EQ(d.code, GetParam().code) << to_string(d);
  EXPECT_THAT(to_string(d), HasSubstr(GetParam().words));
  EXPECT_EQ(d.loc.column, GetParam().column) << to_string(d);
}
INSTANTIATE_TEST_SUITE_P(
    All, WrongSelection,
    testing::Values(Wrong{"", "S027", "it ends where a value is needed", 11}, Wrong{"speed >", "S027", "it ends", 18}, Wrong{"speed > 2 3", "S027", "stands '3'", 21},
                    Wrong{"elemnt == 'O'", "S021", "Did you mean 'element'?", 11}, Wrong{"element = 'O'", "S027", "equality is written ==", 19},
                    Wrong{"element == O", "S021", "no attribute 'O'", 22}, Wrong{"element > 'O'", "S028", "texts have no order", 19},
                    Wrong{"element == 1", "S028", "a text is compared with a number", 19}, Wrong{"speed", "S028", "a truth value is needed", 11},
                    Wrong{"speed && true", "S028", "the left side of && is a number", 17}, Wrong{"(speed > 2", "S027", "')' is needed", 21},
                    Wrong{"element == 'O", "S027", "not closed", 22}, Wrong{"sqt(x) > 1", "S027", "Did you mean 'sqrt'?", 11},
                    Wrong{"min(x) > 1", "S027", "second value", 16}, Wrong{"x > 1 & x < 2", "S027", "written &&", 17}, Wrong{"x > 2e400", "S027", "beyond all numbers", 15},
                    Wrong{"x > 2x", "S027", "something behind it", 15}, Wrong{"id in [1, 'a']", "S028", "a value of the list is a text", 14},
                    Wrong{"x ; 1", "S027", "the character ';'", 13}));

TEST(SelectionDepth, IsBounded) {
  Diagnostics diagnostics;
  EXPECT_TRUE(select_rows(std::string(100000, '('), frame(), {}, diagnostics).empty());
  EXPECT_TRUE(diagnostics.has("S027"));
  diagnostics = {};
  std::string nots(100000, '!');
  nots.append("true");
  EXPECT_TRUE(select_rows(nots, frame(), {}, diagnostics).empty());
  EXPECT_TRUE(diagnostics.has("S027"));
  diagnostics = {};
  std::string nested(50, '(');
  nested.append("true").append(50, ')');
  EXPECT_EQ(select_rows(nested, frame(), {}, diagnostics).size(), 4u) << to_string(diagnostics);
}

} // namespace
} // namespace mote
