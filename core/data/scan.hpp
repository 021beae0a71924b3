// SPDX-License-Identifier: MIT
// A walk through a file of words, lines and raw blocks, in any mixture: what legacy VTK, OVF, PLY and OFF
// need. Words are cut at white space and line ends; the line number is found only when a message needs it.
// Every step is checked against the end of the file (D006).
#pragma once

#include "core/data/fields.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mote::data {

// The place of byte `at` of the text `all` as line and column.
[[nodiscard]] SourceLoc text_place(const std::string& file, std::string_view all, std::uint64_t at);

class Scan {
public:
  Scan(const std::string& file, std::string_view all) : file_(file), all_(all) {}

  bool binary{}; // places are bytes, not lines and columns

  [[nodiscard]] std::uint64_t offset() const { return at_; }
  [[nodiscard]] std::uint64_t left() const { return all_.size() - at_; }
  [[nodiscard]] std::string_view rest() const { return all_.substr(at_); }
  [[nodiscard]] SourceLoc place() const { return place_of(word_at_); } // of the last word or line
  [[nodiscard]] SourceLoc place_of(std::uint64_t at) const;
  void go_to(std::uint64_t at) { at_ = word_at_ = at; }

  std::string_view word();                           // empty at the end of the file
  std::string_view need_word(std::string_view what); // D006 at the end
  [[nodiscard]] std::string_view peek();             // word() without moving
  std::string_view line();                           // the rest of this line, without \r; moves behind \n
  std::string_view take(std::uint64_t bytes, std::string_view what);
  double real(std::string_view what);          // D012
  std::int64_t integer(std::string_view what); // D012
  std::uint64_t count(std::string_view what);  // D008

  // `rows` x `components` numbers as words. A real type gives Double, an integer type Int.
  Column numbers(std::string name, std::uint64_t rows, std::uint32_t components, bool whole);

  [[noreturn]] void refuse(std::string_view code, std::string text,
                           std::vector<std::string> hints = {}) const;

private:
  const std::string& file_;
  std::string_view all_;
  std::uint64_t at_{}, word_at_{};
};

} // namespace mote::data
