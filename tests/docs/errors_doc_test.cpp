// SPDX-License-Identifier: MIT
// docs/errors.md lists every code with its line, exactly as the code tables say, and no other. With
// MOTE_UPDATE_DOCS=1 the table is written anew; then the test fails, so that nobody updates unseen.
#include "app/codes.hpp"
#include "app/window/codes.hpp"
#include "core/color/codes.hpp"
#include "core/compare/codes.hpp"
#include "core/data/codes.hpp"
#include "core/data/codes_fields.hpp"
#include "core/data/codes_molecular.hpp"
#include "core/gpu/error_codes.hpp"
#include "core/image/codes.hpp"
#include "core/reference/codes.hpp"
#include "core/scene/codes.hpp"
#include "passes/codes.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace {

constexpr const char* path = MOTE_SOURCE_DIR "/docs/errors.md";
constexpr const char* begin_mark = "<!-- codes: made by tests/docs -->\n";
constexpr const char* end_mark = "<!-- end of codes -->";

std::string read(const char* file) { return (std::ostringstream() << std::ifstream(file).rdbuf()).str(); }

struct Row {
  std::string code, line;
};

template <class Table> void add(std::vector<Row>& rows, const Table& table) {
  for (const auto& entry : table) {
    if constexpr (requires { entry.first; })
      rows.push_back({std::string(entry.first), std::string(entry.second)});
    else {
      const auto& [code, line] = entry;
      rows.push_back({std::string(code), std::string(line)});
    }
  }
}

// The graph's codes stand in docs/graph-file.md, which has a test of its own.
std::string table() {
  std::vector<Row> rows;
  add(rows, mote::app::app_codes);
  add(rows, mote::window::window_codes);
  add(rows, mote::color_codes);
  add(rows, mote::data::code_table);
  add(rows, mote::data::field_code_table);
  add(rows, mote::data::molecule_code_table);
  add(rows, mote::passes::pass_codes);
  add(rows, mote::image_codes);
  add(rows, mote::compare_codes::table);
  add(rows, mote::reference_codes::table);
  add(rows, mote::scene_codes);
  add(rows, mote::gpu::error_codes);
  std::string text = "| code | what |\n|---|---|\n";
  for (const Row& row : rows) text += "| " + row.code + " | " + row.line + " |\n";
  return text;
}

TEST(ErrorsDoc, ListsEveryCodeAsTheTablesSay) {
  std::string document = read(path);
  const std::size_t begin = document.find(begin_mark), end = document.find(end_mark);
  ASSERT_NE(begin, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  const std::size_t first = begin + std::string(begin_mark).size();
  const std::string found = document.substr(first, end - first), wanted = table();
  if (found != wanted && std::getenv("MOTE_UPDATE_DOCS")) {
    document.replace(first, end - first, wanted);
    std::ofstream(path) << document;
  }
  EXPECT_EQ(found, wanted) << "run this test with MOTE_UPDATE_DOCS=1 and read the change";
}

} // namespace
