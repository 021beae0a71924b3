// SPDX-License-Identifier: MIT
// The words of a CIF file (Hall, Allen, Brown 1991; CIF 1.1): tags, values in quotes or text fields,
// loop_ and data_. reader_mmcif.cpp calls it. It knows no dictionary. Nothing is copied: all texts are
// views into the file.
#pragma once

#include "core/base/diagnostic.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mote::data {

struct CifToken {
  enum class Kind : std::uint8_t { End, Value, Tag, Loop, Data, Save };
  Kind kind{Kind::End};
  bool quoted{};
  std::string_view text{};
  std::uint64_t line{}, column{};
  [[nodiscard]] bool missing() const { return !quoted && (text == "?" || text == "."); }
};

class CifScanner {
public:
  explicit CifScanner(const std::string& file, std::string_view all) : file_(&file), all_(all) {}
  CifToken next(); // D021 for an open quote or text field
  [[nodiscard]] bool at_line_begin() const { return at_ == line_begin_; }
  // The last token ends where the file does, without a blank or line end behind it.
  [[nodiscard]] bool touches_end() const { return at_ >= all_.size() && last_end_ == all_.size(); }
  [[nodiscard]] const std::string& file() const { return *file_; }
  [[nodiscard]] SourceLoc place(const CifToken& token) const { return {*file_, token.line, token.column}; }

private:
  void skip_blanks();
  CifToken text_field();
  CifToken in_quotes(char quote);
  CifToken made(CifToken::Kind kind, std::size_t begin, std::size_t end, bool quoted) const;
  const std::string* file_;
  std::string_view all_;
  std::size_t at_{}, line_begin_{}, last_end_{};
  std::uint64_t line_{1};
};

// A category: _name.item, one row (pairs) or many (a loop). Values in rows, row-major; for a large loop
// only where its values begin.
struct CifTable {
  std::string name{};
  std::vector<std::string_view> items{};
  std::vector<CifToken> values{};
  [[nodiscard]] int item(std::string_view wanted) const; // index, -1 = none; case is ignored
  [[nodiscard]] std::uint64_t rows() const { return items.empty() ? 0 : values.size() / items.size(); }
  [[nodiscard]] const CifToken* value(std::uint64_t row, std::string_view wanted) const; // nullptr = missing
};

// A number, perhaps with its uncertainty behind it: 1.234(5).
[[nodiscard]] bool cif_real(const CifToken& token, double& value);

} // namespace mote::data
