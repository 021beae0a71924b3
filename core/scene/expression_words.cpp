// SPDX-License-Identifier: MIT
#include "core/scene/expression_words.hpp"

#include <array>
#include <charconv>

namespace mote::expression {
namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80; }

// Two-letter signs first.
constexpr std::array<std::string_view, 22> signs{"==", "!=", "<=", ">=", "&&", "||", "<", ">", "!", "(", ")",
                                                 "[",  "]",  ",",  "+",  "-",  "*",  "/", "%", "^", "=", "&"};

Word number_at(std::string_view text, std::size_t& at) {
  Word word{WordKind::Number, {}, 0.0, at};
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), word.number);
  if (error == std::errc::result_out_of_range) return {WordKind::Wrong, "a number beyond all numbers", 0.0, at};
  at = static_cast<std::size_t>(end - text.data());
  if (at < text.size() && (is_letter(text[at]) || text[at] == '.')) return {WordKind::Wrong, "a number with something behind it", 0.0, word.at};
  word.text = std::string(text.substr(word.at, at - word.at));
  return word;
}

Word text_at(std::string_view text, std::size_t& at) {
  const std::size_t begin = at;
  const std::size_t end = text.find(text[at], at + 1);
  if (end == std::string_view::npos) return {WordKind::Wrong, "a text whose quote is not closed", 0.0, begin};
  at = end + 1;
  return {WordKind::Text, std::string(text.substr(begin + 1, end - begin - 1)), 0.0, begin};
}

// Names hold dots (velocity.x) and, as column names do, [1].
Word name_at(std::string_view text, std::size_t& at) {
  const std::size_t begin = at;
  while (at < text.size() && (is_letter(text[at]) || is_digit(text[at]) || text[at] == '.')) ++at;
  if (at + 2 < text.size() && text[at] == '[' && is_digit(text[at + 1]))
    if (const std::size_t end = text.find_first_not_of("0123456789", at + 1); end != std::string_view::npos && text[end] == ']') at = end + 1;
  std::string name(text.substr(begin, at - begin));
  if (name == "and") return {WordKind::Sign, "&&", 0.0, begin};
  if (name == "or") return {WordKind::Sign, "||", 0.0, begin};
  if (name == "not") return {WordKind::Sign, "!", 0.0, begin};
  return {WordKind::Name, std::move(name), 0.0, begin};
}

Word sign_at(std::string_view text, std::size_t& at) {
  for (const std::string_view sign : signs)
    if (text.substr(at).starts_with(sign)) {
      Word word{WordKind::Sign, std::string(sign), 0.0, at};
      at += sign.size();
      if (sign == "=") return {WordKind::Wrong, "'=': equality is written ==", 0.0, word.at};
      if (sign == "&") return {WordKind::Wrong, "'&': both at once is written &&", 0.0, word.at};
      return word;
    }
  return {WordKind::Wrong, std::string("the character '") + text[at] + "'", 0.0, at};
}

} // namespace

std::vector<Word> words_of(std::string_view text) {
  std::vector<Word> words;
  for (std::size_t at = 0;;) {
    while (at < text.size() && (text[at] == ' ' || text[at] == '\t' || text[at] == '\n' || text[at] == '\r')) ++at;
    if (at >= text.size()) {
      words.push_back({WordKind::End, {}, 0.0, text.size()});
      return words;
    }
    const char c = text[at];
    if (is_digit(c) || (c == '.' && at + 1 < text.size() && is_digit(text[at + 1]))) words.push_back(number_at(text, at));
    else if (c == '"' || c == '\'') words.push_back(text_at(text, at));
    else if (is_letter(c)) words.push_back(name_at(text, at));
    else words.push_back(sign_at(text, at));
    if (words.back().kind == WordKind::Wrong) return words;
  }
}

} // namespace mote::expression
