// SPDX-License-Identifier: MIT
// Lines, words and numbers of text formats. A Cursor walks over lines and knows their numbers, a
// Words cuts one line at white space, the number functions are std::from_chars with what particle
// files add to it. Nothing here depends on the locale, allocates per line or throws.
#pragma once

#include "core/base/diagnostic.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mote::data {

constexpr bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
[[nodiscard]] std::string_view trim(std::string_view text);
[[nodiscard]] std::string lower(std::string_view text);
// ASCII case is ignored.
[[nodiscard]] bool same_word(std::string_view a, std::string_view b);
// A word for a message: in quotes, cut at 40 bytes, control bytes as '?'.
[[nodiscard]] std::string shown(std::string_view word);

// One line without its end (\n or \r\n) and where it stands.
struct Line {
  std::string_view text{};
  std::uint64_t number{}; // from 1
};

// A place between two lines of a text.
class Cursor {
public:
  Cursor() = default;
  Cursor(std::string_view all, std::uint64_t offset = 0, std::uint64_t line = 1)
      : all_(all), at_(offset), line_(line) {}
  [[nodiscard]] bool at_end() const { return at_ >= all_.size(); }
  [[nodiscard]] std::uint64_t offset() const { return at_; }
  [[nodiscard]] std::uint64_t line() const { return line_; }
  [[nodiscard]] std::string_view rest() const { return all_.substr(at_); }
  [[nodiscard]] std::string_view all() const { return all_; }
  std::optional<Line> next();                     // nothing at the end
  [[nodiscard]] std::optional<Line> peek() const; // next() without moving
  // Moves over `count` lines and returns how many there were (fewer at the end of the text).
  std::uint64_t skip(std::uint64_t count);
  void skip_blank(); // to the next line that holds more than white space

private:
  std::string_view all_{};
  std::uint64_t at_{};
  std::uint64_t line_{1};
};

// The words of one line.
class Words {
public:
  explicit Words(std::string_view line) : rest_(line) {}
  std::string_view next() { // empty when there is none left
    std::size_t begin = 0;
    while (begin < rest_.size() && is_space(rest_[begin])) ++begin;
    std::size_t end = begin;
    while (end < rest_.size() && !is_space(rest_[end])) ++end;
    const std::string_view word = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return word;
  }

private:
  std::string_view rest_;
};

// Whole words only: trailing characters make them fail. Reals: a leading '+', Fortran's D exponents,
// nan and inf in any case; what is too small becomes 0, what is too large becomes infinite.
[[nodiscard]] bool parse_real(std::string_view word, double& value);
[[nodiscard]] bool parse_integer(std::string_view word, std::int64_t& value); // a leading '+' is allowed
[[nodiscard]] bool parse_count(std::string_view word, std::uint64_t& value);  // digits only, below 2^64
[[nodiscard]] bool parse_logical(std::string_view word, bool& value);         // T F true false, any case

// The place of `part`, a piece of the line `line`, in the file `name`.
[[nodiscard]] SourceLoc place_in(const std::string& name, const Line& line, std::string_view part);

} // namespace mote::data
