// SPDX-License-Identifier: MIT
// Fixtures and values of columns for the tests of molecular formats.
#pragma once

#include "tests/data/files.hpp"
#include "tests/data/support.hpp"

#include <string>
#include <string_view>

namespace mote::data::test {

inline std::string molecule_file(std::string_view name) {
  return content_of(std::filesystem::path(MOTE_SOURCE_DIR) / "tests/data_molecular/files" / name);
}
inline std::string text_at(const Frame& frame, std::string_view column, std::uint64_t row) {
  const Column* found = frame.find(column);
  const auto* text = found ? std::get_if<TextColumn>(&found->values) : nullptr;
  return text ? text->at(row) : "no such text";
}
inline glm::dvec3 vector_at(const Frame& frame, std::string_view column, std::uint64_t row) {
  const Column* found = frame.find(column);
  return found ? glm::dvec3(found->number(row, 0), found->number(row, 1), found->number(row, 2))
               : glm::dvec3(NAN);
}
// `text` with the first `from` replaced by `to`; an unchanged text is a mistake of the test.
inline std::string changed(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

} // namespace mote::data::test
