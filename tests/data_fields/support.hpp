// SPDX-License-Identifier: MIT
// What the tests of the field, mesh and raw readers share: reading from memory, the outcome of a reading,
// the small files and the pack of real ones.
#pragma once

#include "core/data/bytes.hpp"
#include "core/data/registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace mote::data::testing {

inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream out;
  out << in.rdbuf();
  return out.str();
}

inline std::filesystem::path small_file(std::string_view name) {
  return std::filesystem::path(MOTE_FIELD_FILES) / name;
}
inline std::filesystem::path pack_file(std::string_view name) {
  return std::filesystem::path(MOTE_SOURCE_DIR) / ".." / "shared" / "data" / name;
}

inline std::string extension_of_name(const std::string& name) { return name.substr(name.rfind('.') + 1); }

// Reads `content` as if it were a file of this name.
inline Frame read_memory(const std::string& name, std::string_view content, Diagnostics* warnings = nullptr) {
  const auto source = open_bytes(Bytes::from_memory(name, content), extension_of_name(name));
  Frame frame = source->read(0);
  if (warnings) *warnings = source->warnings();
  return frame;
}

struct Outcome {
  std::string code{}, text{}; // text: the printed diagnostic
  Exit exit{Exit::Done};
};

// What happens when `content` is read; code "" = it was read.
inline Outcome outcome_of(const std::string& name, std::string_view content) {
  try {
    (void)read_memory(name, content);
  } catch (const Failure& failure) {
    return {failure.diagnostic().code, failure.what(), failure.exit()};
  }
  return {};
}

inline void expect_refused(const std::string& name, std::string_view content, std::string_view code,
                           std::string_view words) {
  const Outcome outcome = outcome_of(name, content);
  EXPECT_EQ(outcome.code, code) << outcome.text;
  EXPECT_THAT(outcome.text, ::testing::HasSubstr(words));
  EXPECT_EQ(outcome.exit, Exit::BadInput);
}

// `text` with the first `from` replaced; the test fails if it is not there.
inline std::string changed(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline std::vector<double> numbers_of(const Frame& frame, std::string_view name) {
  const Column* column = frame.find(name);
  std::vector<double> out;
  if (!column) ADD_FAILURE() << "no column " << name;
  for (std::uint64_t r = 0; column && r < column->rows(); ++r)
    for (std::uint32_t k = 0; k < column->components; ++k) out.push_back(column->number(r, k));
  return out;
}

} // namespace mote::data::testing
