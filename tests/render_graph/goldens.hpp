// SPDX-License-Identifier: MIT
// Comparing text with a file beside the tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace mote::rg::test {

extern bool update_goldens;

inline std::filesystem::path here() { return std::filesystem::path(MOTE_SOURCE_DIR) / "tests/render_graph"; }

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void expect_golden(const std::filesystem::path& path, const std::string& text) {
  if (update_goldens) {
    std::ofstream(path, std::ios::binary) << text;
    return;
  }
  ASSERT_TRUE(std::filesystem::exists(path)) << path << " is missing; the test program writes it with --update";
  EXPECT_EQ(read_text(path), text) << "differs from " << path;
}

} // namespace mote::rg::test
