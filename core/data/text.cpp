// SPDX-License-Identifier: MIT
#include "core/data/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <limits>

namespace mote::data {
namespace {

constexpr char lower_char(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// from_chars says only "out of range": zero when the value is too small, infinite when too large. The
// decimal exponent of the first significant digit decides.
double beyond_range(std::string_view word) {
  const bool negative = word.starts_with('-');
  std::int64_t exponent = 0;
  const std::size_t e = word.find_first_of("eE");
  if (e != std::string_view::npos) {
    std::string_view digits = word.substr(e + 1);
    const bool minus = digits.starts_with('-');
    if (!digits.empty() && (digits[0] == '-' || digits[0] == '+')) digits.remove_prefix(1);
    if (std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec != std::errc{})
      exponent = std::numeric_limits<std::int32_t>::max();
    exponent = minus ? -exponent : exponent;
  }
  const std::string_view mantissa = word.substr(0, e);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t first = std::min(mantissa.find_first_of("123456789"), mantissa.size());
  const auto lead = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  const double magnitude = lead + exponent > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return negative ? -magnitude : magnitude;
}

bool real_from(std::string_view word, double& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return false;
  if (error == std::errc::result_out_of_range) value = beyond_range(word);
  return error == std::errc{} || error == std::errc::result_out_of_range;
}

// The rare spellings: '+1', '1.0D-3'.
bool real_of_fortran(std::string_view word, double& value) {
  std::array<char, 64> copy{};
  if (word.starts_with('+') && word.size() > 1 && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  if (word.size() > copy.size() || word.empty()) return false;
  std::replace_copy_if(
      word.begin(), word.end(), copy.begin(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
  return real_from({copy.data(), word.size()}, value);
}

constexpr std::array<double, 23> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// [-]digits[.digits] with at most 2^53 as mantissa and 22 decimals: one exact division gives the
// nearest double (W. D. Clinger, How to read floating point numbers accurately, 1990). False for
// everything else, which from_chars then reads.
bool short_decimal(std::string_view word, double& value) {
  const char* at = word.data();
  const char* const end = at + word.size();
  const bool negative = at != end && *at == '-';
  at += negative;
  const char* const first = at;
  std::uint64_t mantissa = 0;
  const char* point = nullptr;
  for (; at != end; ++at) {
    const auto digit = static_cast<unsigned char>(*at - '0');
    if (digit < 10) {
      mantissa = mantissa * 10 + digit;
    } else if (*at == '.' && !point) {
      point = at;
    } else {
      return false;
    }
  }
  const std::ptrdiff_t digits = at - first - (point ? 1 : 0);
  if (digits == 0 || digits > 18 || mantissa > (std::uint64_t{1} << 53)) return false;
  const std::ptrdiff_t decimals = point ? at - point - 1 : 0;
  const double magnitude = static_cast<double>(mantissa) / powers_of_ten[static_cast<std::size_t>(decimals)];
  value = negative ? -magnitude : magnitude;
  return true;
}

} // namespace

std::string_view trim(std::string_view text) {
  auto space = [](char c) { return is_space(c) || c == '\n'; };
  while (!text.empty() && space(text.front())) text.remove_prefix(1);
  while (!text.empty() && space(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), lower_char);
  return out;
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower_char(x) == lower_char(y); });
}

std::string shown(std::string_view word) {
  const bool cut = word.size() > 40;
  std::string out = "'";
  for (const char c : word.substr(0, 40)) out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  while (cut && !out.empty() && (static_cast<unsigned char>(out.back()) & 0xc0) == 0x80) out.pop_back();
  return out + (cut ? "...'" : "'");
}

std::optional<Line> Cursor::next() {
  if (at_end()) return std::nullopt;
  const std::size_t end = std::min(all_.find('\n', at_), all_.size());
  std::string_view text = all_.substr(at_, end - at_);
  if (text.ends_with('\r')) text.remove_suffix(1);
  at_ = std::min<std::uint64_t>(end + 1, all_.size());
  return Line{text, line_++};
}

std::optional<Line> Cursor::peek() const { return Cursor(*this).next(); }

std::uint64_t Cursor::skip(std::uint64_t count) {
  std::uint64_t done = 0;
  while (done < count && !at_end()) {
    const void* end = std::memchr(all_.data() + at_, '\n', all_.size() - at_);
    at_ = end ? static_cast<std::uint64_t>(static_cast<const char*>(end) - all_.data()) + 1 : all_.size();
    ++done;
  }
  line_ += done;
  return done;
}

void Cursor::skip_blank() {
  while (const auto line = peek()) {
    if (!trim(line->text).empty()) return;
    (void)next();
  }
}

bool parse_real(std::string_view word, double& value) {
  return short_decimal(word, value) || real_from(word, value) || real_of_fortran(word, value);
}

bool parse_integer(std::string_view word, std::int64_t& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

bool parse_count(std::string_view word, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

bool parse_logical(std::string_view word, bool& value) {
  value = same_word(word, "t") || same_word(word, "true");
  return value || same_word(word, "f") || same_word(word, "false");
}

SourceLoc place_in(const std::string& name, const Line& line, std::string_view part) {
  std::uint64_t column = 1;
  if (part.data() >= line.text.data() && part.data() <= line.text.data() + line.text.size())
    column += static_cast<std::uint64_t>(part.data() - line.text.data());
  return {name, line.number, column};
}

} // namespace mote::data
