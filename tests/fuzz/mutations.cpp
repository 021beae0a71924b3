// SPDX-License-Identifier: MIT
#include "tests/fuzz/mutations.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace mote::fuzz {
namespace {

constexpr std::array<std::string_view, 22> odd_words{"0", "-1", "1e999", "-1e-999", "nan", "inf", "9223372036854775808", "18446744073709551615", "4294967296",
                                                     "2147483648", "1e18", "", " ", "\n", "\r\n", "\t", "\"", "0x10", "1,5", "\xff\xfe", "999999999", "T"};
constexpr std::array<std::uint64_t, 14> odd_numbers{0, 1, 2, 3, 0x7f, 0x80, 0xff, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff, 0x7fffffffffffffff, 0x8000000000000000, 0xffffffffffffffff};

std::size_t below(std::size_t end, Random& random) { return end ? static_cast<std::size_t>(random() % end) : 0; }
template <class List> const auto& any_of(const List& list, Random& random) { return list[below(list.size(), random)]; }

// The digits, signs and points around a place.
std::pair<std::size_t, std::size_t> number_around(const std::string& s, std::size_t at) {
  const auto part = [&](std::size_t k) { return std::strchr("0123456789+-.eE", s[k]) != nullptr && s[k] != '\0'; };
  while (at < s.size() && !part(at)) ++at;
  std::size_t begin = at, end = at;
  while (begin > 0 && part(begin - 1)) --begin;
  while (end < s.size() && part(end)) ++end;
  return {begin, end};
}

void put_number(std::string& s, Random& random) {
  const std::size_t width = std::size_t{1} << below(4, random);
  if (s.size() < width) return;
  std::uint64_t value = any_of(odd_numbers, random) + (random() % 4 == 0 ? random() % 17 : 0);
  if (random() % 2 == 0)
    value = __builtin_bswap64(value) >> (64 - 8 * width);
  std::memcpy(s.data() + below(s.size() - width + 1, random), &value, width);
}

void change_once(std::string& s, std::string_view other, Random& random) {
  if (s.empty()) {
    s = other;
    return;
  }
  const std::size_t at = below(s.size(), random), length = std::min(s.size() - at, std::size_t{1} << below(9, random));
  switch (random() % 10) {
  case 0: s[at] = static_cast<char>(s[at] ^ (1 << below(8, random))); break;
  case 1: s[at] = static_cast<char>(random()); break;
  case 2: s.erase(at, length); break;
  case 3: s.insert(at, s.substr(below(s.size(), random), length)); break;
  case 4: s.resize(at); break;
  case 5: put_number(s, random); break;
  case 6: {
    const auto [begin, end] = number_around(s, at);
    s.replace(begin, end - begin, any_of(odd_words, random));
    break;
  }
  case 7: s.insert(at, any_of(odd_words, random)); break;
  case 8:
    if (!other.empty()) s.insert(at, other.substr(below(other.size(), random), length));
    break;
  default:
    if (!other.empty()) s = s.substr(0, at) + std::string(other.substr(below(other.size(), random)));
    break;
  }
}

} // namespace

std::string mutated(std::string_view content, std::string_view other, Random& random, std::size_t most) {
  std::string out(content);
  for (std::size_t n = 1 + below(8, random); n > 0; --n) change_once(out, other, random);
  if (out.size() > most) out.resize(most);
  return out;
}

} // namespace mote::fuzz
