// SPDX-License-Identifier: MIT
// The words of a selection: numbers, texts, names, signs, each with its place. Private to expression.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mote::expression {

enum class WordKind : unsigned char { Number, Text, Name, Sign, End, Wrong };
struct Word {
  WordKind kind{WordKind::End};
  std::string text{}; // of a Text: without quotes; Wrong: what is wrong with it
  double number{};
  std::size_t at{};   // byte in the expression
};

// The last word is End, or Wrong where reading stopped. "and", "or", "not" come as signs.
std::vector<Word> words_of(std::string_view text);

} // namespace mote::expression
