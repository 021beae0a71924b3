// SPDX-License-Identifier: MIT
// The table of failure cases: printed, written in docs/stability.md, and each case that says it is tested here is.
#include "cases.hpp"

#include <fmt/format.h>

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

namespace mote::test {
namespace {

std::string state_text(const FailureCase& c) {
  if (c.state == State::Here) return "naive fails, mote holds";
  return c.state == State::Covered ? fmt::format("mote holds: {}", c.where) : fmt::format("pending: {}", c.where);
}

std::string table() {
  std::string out = "| case | what | state |\n|---|---|---|\n";
  for (std::size_t i = 0; i < failure_cases.size(); ++i) out += fmt::format("| FC-{:02} | {} | {} |\n", i + 1, failure_cases[i].title, state_text(failure_cases[i]));
  return out;
}

// "FC01", "FC02", ... that some test of this program is named after.
std::set<std::string> tested() {
  std::set<std::string> out;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s)
    for (int t = 0; t < all.GetTestSuite(s)->total_test_count(); ++t) {
      const std::string name = all.GetTestSuite(s)->GetTestInfo(t)->name();
      for (std::size_t at = name.find("FC"); at != std::string::npos; at = name.find("FC", at + 1)) out.insert(name.substr(at, 4));
    }
  return out;
}

TEST(StabilityTable, CasesTestedHereHaveATestOfTheirName) {
  const std::set<std::string> names = tested();
  for (std::size_t i = 0; i < failure_cases.size(); ++i) {
    const std::string name = fmt::format("FC{:02}", i + 1);
    EXPECT_EQ(names.contains(name), failure_cases[i].state == State::Here) << name;
    EXPECT_EQ(failure_cases[i].where.empty(), failure_cases[i].state == State::Here) << name;
  }
}

TEST(StabilityTable, FilesNamedAreThere) {
  for (const FailureCase& c : failure_cases) {
    const std::size_t at = c.where.find("tests/");
    if (at == std::string_view::npos) continue;
    EXPECT_TRUE(std::ifstream(std::string(MOTE_SOURCE_DIR "/") + std::string(c.where.substr(at))).good()) << c.where;
  }
}

// With MOTE_UPDATE_DOCS=1 the table is written anew; then the test fails, so that nobody updates unseen.
TEST(StabilityTable, IsTheOneInTheDocs) {
  constexpr const char* path = MOTE_SOURCE_DIR "/docs/stability.md";
  const std::string begin_mark = "<!-- cases: made by tests/stability -->\n", end_mark = "<!-- end of cases -->";
  std::string document = (std::ostringstream() << std::ifstream(path).rdbuf()).str();
  const std::size_t begin = document.find(begin_mark), end = document.find(end_mark);
  ASSERT_NE(begin, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  const std::size_t first = begin + begin_mark.size();
  const std::string found = document.substr(first, end - first), wanted = table();
  if (found != wanted && std::getenv("MOTE_UPDATE_DOCS")) std::ofstream(path) << document.replace(first, end - first, wanted);
  EXPECT_EQ(found, wanted) << "run this test with MOTE_UPDATE_DOCS=1 and read the change";
  fmt::print("{}", wanted);
}

} // namespace
} // namespace mote::test
