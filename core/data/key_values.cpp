// SPDX-License-Identifier: MIT
#include "core/data/key_values.hpp"

#include "core/data/codes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::data {
namespace {

constexpr char closing(char open) {
  switch (open) {
  case '"': return '"';
  case '\'': return '\'';
  case '[': return ']';
  case '{': return '}';
  default: return '\0';
  }
}

class Scanner {
public:
  Scanner(const std::string& file, const Line& line) : file_(file), line_(line) {}

  std::vector<KeyValue> all() {
    std::vector<KeyValue> out;
    for (blanks(); at_ < line_.text.size(); blanks()) {
      const std::size_t begin = at_;
      KeyValue entry{word('='), "true", {}};
      entry.at = line_.text.substr(begin, at_ - begin);
      blanks();
      if (at_ < line_.text.size() && line_.text[at_] == '=') {
        ++at_;
        blanks();
        entry.value = word('\0');
      }
      if (!entry.key.empty()) out.push_back(std::move(entry));
    }
    return out;
  }

private:
  void blanks() {
    while (at_ < line_.text.size() && is_space(line_.text[at_])) ++at_;
  }
  // A quoted or bracketed piece, or everything to the next blank or `stop`.
  std::string word(char stop) {
    std::string out;
    if (at_ >= line_.text.size()) return out;
    if (closing(line_.text[at_])) return enclosed();
    for (; at_ < line_.text.size() && !is_space(line_.text[at_]); ++at_) {
      if (stop && line_.text[at_] == stop) break;
      out += line_.text[at_];
    }
    return out;
  }
  std::string enclosed() {
    const std::size_t begin = at_;
    const char open = line_.text[at_++];
    const char close = closing(open);
    std::string out;
    for (int depth = 1; at_ < line_.text.size(); ++at_) {
      const char c = line_.text[at_];
      if (c == '\\' && at_ + 1 < line_.text.size()) {
        out += line_.text[++at_];
        continue;
      }
      if (c == close && --depth == 0) {
        ++at_;
        return out;
      }
      if (c == open && open != close) ++depth;
      out += c;
    }
    const std::string_view piece = line_.text.substr(begin);
    fail(Exit::BadInput, code::quote, place_in(file_, line_, piece),
         fmt::format("{} is not closed with {}", shown(piece), close));
  }

  const std::string& file_;
  const Line& line_;
  std::size_t at_{};
};

} // namespace

std::vector<KeyValue> parse_key_values(const std::string& file, const Line& line) {
  return Scanner(file, line).all();
}

bool parse_reals(std::string_view value, std::vector<double>& out) {
  std::string plain(value);
  std::replace_if(
      plain.begin(), plain.end(),
      [](char c) { return c == ',' || c == '[' || c == ']' || c == '{' || c == '}'; }, ' ');
  Words words(plain);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    double number = 0;
    if (!parse_real(word, number)) return false;
    out.push_back(number);
  }
  return true;
}

} // namespace mote::data
