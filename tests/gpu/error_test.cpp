// SPDX-License-Identifier: MIT
// Error scopes, context lines, the table of codes.
#include "core/gpu/error_codes.hpp"
#include "tests/gpu/rules.hpp"

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace mote::gpu {
namespace {

using testing::HasSubstr;

Error sample(ErrorFilter kind, std::string code) { return {kind, std::move(code), "A sentence.", {}}; }

TEST(ErrorSink, innermost_scope_of_the_kind_keeps_the_first) {
  ErrorSink sink;
  std::vector<std::string> uncaptured;
  sink.set_handler([&](const Error& e) { uncaptured.push_back(e.code); });
  sink.push(ErrorFilter::Validation);
  sink.push(ErrorFilter::OutOfMemory);
  sink.report(sample(ErrorFilter::Validation, "a"));
  sink.report(sample(ErrorFilter::Validation, "b"));
  sink.report(sample(ErrorFilter::OutOfMemory, "c"));
  sink.report(sample(ErrorFilter::Internal, "d"));
  EXPECT_EQ(sink.pop()->code, "c");
  EXPECT_EQ(sink.pop()->code, "a");
  EXPECT_THAT(uncaptured, testing::ElementsAre("d"));
  expect_broken("V-DEV-001", "without an open error scope", [&] { sink.pop(); });
}

TEST(ErrorSink, nothing_reported_pops_empty) {
  ErrorSink sink;
  sink.push(ErrorFilter::Validation);
  EXPECT_FALSE(sink.pop());
}

TEST(ErrorSinkDeathTest, default_handler_prints_and_aborts) {
  EXPECT_DEATH(ErrorSink().report(sample(ErrorFilter::Validation, "V-BUF-001")), "Validation error V-BUF-001: A sentence.");
}

TEST(Errors, context_lines_are_appended_from_the_inside_out) {
  try {
    in_context([] { return "calling outer"; }, [] { in_context([] { return "validating inner"; }, [] { invalid("V-X-001", "Value {} is wrong.", 3); }); });
    FAIL();
  } catch (const Fault& fault) {
    EXPECT_EQ(to_string(fault.error()), "Validation error V-X-001: Value 3 is wrong.\n  - While validating inner.\n  - While calling outer.");
  }
}

std::set<std::string> codes_in_sources() {
  std::set<std::string> codes;
  const std::regex code("\"(V-[A-Z]+-[0-9]{3})\"");
  for (const auto& file : std::filesystem::recursive_directory_iterator(std::string(MOTE_SOURCE_DIR) + "/core/gpu")) {
    if (!file.is_regular_file() || file.path().filename() == "error_codes.hpp") continue;
    std::ifstream in(file.path());
    std::stringstream text;
    text << in.rdbuf();
    const std::string all = text.str();
    for (std::sregex_iterator i(all.begin(), all.end(), code), end; i != end; ++i) codes.insert((*i)[1]);
  }
  return codes;
}

TEST(ErrorCodes, the_table_is_exactly_what_the_sources_use) {
  std::set<std::string> table;
  for (const ErrorCode& c : error_codes) {
    EXPECT_TRUE(table.insert(std::string(c.code)).second) << c.code << " twice";
    EXPECT_FALSE(c.meaning.empty());
  }
  EXPECT_EQ(table, codes_in_sources());
}

} // namespace
} // namespace mote::gpu
