// SPDX-License-Identifier: MIT
#include "core/data/cif.hpp"

#include "core/data/codes_molecular.hpp"
#include "core/data/text.hpp"

#include <algorithm>

namespace mote::data {
namespace {

bool blank(char c) { return static_cast<unsigned char>(c) <= ' '; }

bool begins_with(std::string_view text, std::string_view word) {
  return text.size() >= word.size() && same_word(text.substr(0, word.size()), word);
}

// What a word without quotes is; most are values and begin with another letter.
CifToken::Kind kind_of_word(std::string_view word) {
  switch (word[0]) {
  case '_': return CifToken::Kind::Tag;
  case 'l':
  case 'L': return same_word(word, "loop_") ? CifToken::Kind::Loop : CifToken::Kind::Value;
  case 'd':
  case 'D': return begins_with(word, "data_") ? CifToken::Kind::Data : CifToken::Kind::Value;
  case 's':
  case 'S': return begins_with(word, "save_") ? CifToken::Kind::Save : CifToken::Kind::Value;
  default: return CifToken::Kind::Value;
  }
}

} // namespace

void CifScanner::skip_blanks() {
  while (at_ < all_.size()) {
    const char c = all_[at_];
    if (c == '\n') {
      ++line_;
      line_begin_ = ++at_;
    } else if (blank(c)) {
      ++at_;
    } else if (c == '#') {
      at_ = std::min(all_.find('\n', at_), all_.size());
    } else {
      return;
    }
  }
}

CifToken CifScanner::made(CifToken::Kind kind, std::size_t begin, std::size_t end, bool quoted) const {
  return {kind, quoted, all_.substr(begin, end - begin), line_, begin - line_begin_ + 1};
}

CifToken CifScanner::next() {
  skip_blanks();
  if (at_ >= all_.size()) return made(CifToken::Kind::End, all_.size(), all_.size(), false);
  const char c = all_[at_];
  if (c == ';' && at_line_begin()) return text_field();
  if (c == '\'' || c == '"') return in_quotes(c);
  const std::size_t begin = at_;
  while (at_ < all_.size() && !blank(all_[at_])) ++at_;
  last_end_ = at_;
  CifToken token = made(CifToken::Kind::Value, begin, at_, false);
  token.kind = kind_of_word(token.text);
  return token;
}

// From a semicolon at the begin of a line to the next one there.
CifToken CifScanner::text_field() {
  const std::size_t begin = at_ + 1;
  const std::size_t end = all_.find("\n;", at_);
  const CifToken first = made(CifToken::Kind::Value, begin, begin, true);
  if (end == std::string_view::npos)
    fail(Exit::BadInput, code::quote, place(first),
         "the text field that begins here is not closed by ';' at the begin of a line");
  CifToken token{CifToken::Kind::Value, true, all_.substr(begin, end - begin), first.line, first.column};
  line_ += static_cast<std::uint64_t>(std::count(all_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                 all_.begin() + static_cast<std::ptrdiff_t>(end) + 1, '\n'));
  line_begin_ = end + 1;
  at_ = last_end_ = end + 2;
  return token;
}

// A quote ends a value only before a blank: 'O5'' is O5'.
CifToken CifScanner::in_quotes(char quote) {
  const std::size_t begin = at_ + 1;
  const std::size_t line_end = std::min(all_.find('\n', at_), all_.size());
  std::size_t end = all_.find(quote, begin);
  while (end < line_end && end + 1 < line_end && !blank(all_[end + 1])) end = all_.find(quote, end + 1);
  const CifToken token = made(CifToken::Kind::Value, begin, std::min(end, line_end), true);
  if (end >= line_end)
    fail(Exit::BadInput, code::quote, place(token), "the quote that begins here is not closed in its line");
  at_ = last_end_ = end + 1;
  return token;
}

int CifTable::item(std::string_view wanted) const {
  for (std::size_t k = 0; k < items.size(); ++k)
    if (same_word(items[k], wanted)) return static_cast<int>(k);
  return -1;
}

const CifToken* CifTable::value(std::uint64_t row, std::string_view wanted) const {
  const int at = item(wanted);
  if (at < 0 || row >= rows()) return nullptr;
  const CifToken& token = values[row * items.size() + static_cast<std::size_t>(at)];
  return token.missing() ? nullptr : &token;
}

bool cif_real(const CifToken& token, double& value) {
  std::string_view word = token.text;
  if (word.ends_with(')')) word = word.substr(0, word.find('('));
  return parse_real(word, value);
}

} // namespace mote::data
