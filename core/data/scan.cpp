// SPDX-License-Identifier: MIT
#include "core/data/scan.hpp"

#include "core/data/codes_fields.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::data {
namespace {

constexpr bool is_gap(char c) { return c == '\n' || c == '\0' || is_space(c); }

} // namespace

SourceLoc text_place(const std::string& file, std::string_view all, std::uint64_t at) {
  const std::string_view before = all.substr(0, std::min<std::uint64_t>(at, all.size()));
  const auto line = static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n')) + 1;
  const std::size_t start = before.rfind('\n');
  return {file, line, before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1};
}

SourceLoc Scan::place_of(std::uint64_t at) const {
  if (binary) return {file_, 0, 0, static_cast<std::int64_t>(at)};
  return text_place(file_, all_, at);
}

void Scan::refuse(std::string_view code, std::string text, std::vector<std::string> hints) const {
  fail(Exit::BadInput, code, place(), std::move(text), std::move(hints));
}

std::string_view Scan::word() {
  while (at_ < all_.size() && is_gap(all_[at_])) ++at_;
  word_at_ = at_;
  while (at_ < all_.size() && !is_gap(all_[at_])) ++at_;
  return all_.substr(word_at_, at_ - word_at_);
}

std::string_view Scan::need_word(std::string_view what) {
  const std::string_view found = word();
  if (found.empty()) refuse(code::ends_early, fmt::format("the file ends early: {} is missing", what));
  return found;
}

std::string_view Scan::peek() {
  const std::uint64_t at = at_, word_at = word_at_;
  const std::string_view found = word();
  at_ = at;
  word_at_ = word_at;
  return found;
}

std::string_view Scan::line() {
  const std::size_t end = std::min(all_.find('\n', at_), all_.size());
  word_at_ = at_;
  std::string_view found = all_.substr(at_, end - at_);
  if (found.ends_with('\r')) found.remove_suffix(1);
  at_ = std::min(end + 1, all_.size());
  return found;
}

std::string_view Scan::take(std::uint64_t bytes, std::string_view what) {
  word_at_ = at_;
  if (bytes > left()) need_bytes(bytes, left(), place(), what);
  at_ += bytes;
  return all_.substr(word_at_, bytes);
}

double Scan::real(std::string_view what) {
  const std::string_view found = need_word(what);
  double value = 0;
  if (!parse_real(found, value))
    refuse(code::not_a_value, fmt::format("{} is not a number: {}", what, shown(found)));
  return value;
}

std::int64_t Scan::integer(std::string_view what) {
  const std::string_view found = need_word(what);
  std::int64_t value = 0;
  if (!parse_integer(found, value))
    refuse(code::not_a_value, fmt::format("{} is not an integer: {}", what, shown(found)));
  return value;
}

std::uint64_t Scan::count(std::string_view what) {
  const std::string_view found = need_word(what);
  std::uint64_t value = 0;
  if (!parse_count(found, value))
    refuse(code::heading, fmt::format("{} is not a count: {}", what, shown(found)));
  return value;
}

Column Scan::numbers(std::string name, std::uint64_t rows, std::uint32_t components, bool whole) {
  const std::uint64_t wanted = times(rows, components);
  if (wanted > left() / 2 + 1) { // a digit and a blank each
    word_at_ = at_;
    refuse(code::ends_early, fmt::format("the file ends early: {} needs {} numbers, but {} bytes are left",
                                         shown(name), wanted, left()));
  }
  Column column{std::move(name), components, {}, {}};
  const std::string what = fmt::format("a value of {}", shown(column.name));
  if (whole) {
    std::vector<std::int64_t> values(wanted);
    for (std::int64_t& value : values) value = integer(what);
    column.values = std::move(values);
  } else {
    std::vector<double> values(wanted);
    for (double& value : values) value = real(what);
    column.values = std::move(values);
  }
  return column;
}

} // namespace mote::data
