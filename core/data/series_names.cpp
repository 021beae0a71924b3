// SPDX-License-Identifier: MIT
// Names of series: patterns of files and lists of frames.
#include "core/data/codes.hpp"
#include "core/data/series.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>

namespace mote::data {
namespace {

namespace fs = std::filesystem;

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Does `name` fit `pattern` with '*' and '?'? Linear in practice: only the last star is taken back.
bool fits(std::string_view name, std::string_view pattern) {
  std::size_t n = 0, p = 0, star = std::string_view::npos, mark = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      mark = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++mark;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::string_view digits_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_digit(text[end])) ++end;
  return text.substr(at, end - at);
}

// Runs of digits as numbers of any length, everything else by its bytes; equal numbers by their zeros in front.
bool before(std::string_view a, std::string_view b) {
  std::size_t i = 0, k = 0;
  while (i < a.size() && k < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[k])) {
      if (a[i] != b[k]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[k]);
      ++i;
      ++k;
      continue;
    }
    std::string_view x = digits_at(a, i), y = digits_at(b, k);
    i += x.size();
    k += y.size();
    x.remove_prefix(std::min(x.find_first_not_of('0'), x.size()));
    y.remove_prefix(std::min(y.find_first_not_of('0'), y.size()));
    if (x.size() != y.size()) return x.size() < y.size();
    if (x != y) return x < y;
  }
  return a.size() - i != b.size() - k ? a.size() - i < b.size() - k : a < b;
}

std::string plain_extension(fs::path name) {
  const std::string last = lower(name.extension().string());
  if (last == ".gz" || last == ".xz" || last == ".zst") name = name.stem();
  const std::string extension = lower(name.extension().string());
  return extension.empty() ? extension : extension.substr(1);
}

[[noreturn]] void bad_list(std::string_view text, std::string_view part, const SourceLoc& loc) {
  fail(Exit::Usage, code::frame_list, loc, fmt::format("{} in {} is no list of frames", shown(part), shown(text)),
       {"7, -1, 0:100, 0:100:10, ::5, or several joined by commas; the end is not included, negative numbers count from the end"});
}

// "a:b:step" -> up to three numbers; nothing for other text.
std::optional<std::array<std::optional<std::int64_t>, 3>> slice_of(std::string_view part) {
  std::array<std::optional<std::int64_t>, 3> out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t colon = part.find(':');
    const std::string_view word = trim(part.substr(0, colon));
    std::int64_t value = 0;
    if (!word.empty()) {
      if (!parse_integer(word, value)) return std::nullopt;
      out[k] = value;
    }
    if (colon == std::string_view::npos) return out;
    part.remove_prefix(colon + 1);
  }
  return std::nullopt;
}

// Python's rules for a slice (slice.indices).
void add_slice(const std::array<std::optional<std::int64_t>, 3>& slice, std::uint64_t frames, std::vector<std::uint64_t>& out) {
  const auto count = static_cast<std::int64_t>(frames);
  const std::int64_t step = slice[2].value_or(1);
  const std::int64_t least = step > 0 ? 0 : -1, most = step > 0 ? count : count - 1;
  auto bound = [&](std::optional<std::int64_t> given, std::int64_t otherwise) {
    if (!given) return otherwise;
    return std::clamp(*given < 0 ? *given + count : *given, least, most);
  };
  const std::int64_t begin = bound(slice[0], step > 0 ? least : most), end = bound(slice[1], step > 0 ? most : least);
  for (std::int64_t k = begin; step > 0 ? k < end : k > end;) {
    out.push_back(static_cast<std::uint64_t>(k));
    if (__builtin_add_overflow(k, step, &k)) break;
  }
}

} // namespace

bool is_pattern(const fs::path& name) {
  std::error_code error;
  return name.filename().string().find_first_of("*?") != std::string::npos && !fs::exists(name, error);
}

std::vector<fs::path> expand_pattern(const fs::path& pattern) {
  if (!is_pattern(pattern)) return {pattern};
  const fs::path folder = pattern.parent_path();
  const std::string wanted = pattern.filename().string();
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder.empty() ? fs::path(".") : folder, error), end; !error && it != end; it.increment(error))
    if (std::string name = it->path().filename().string(); fits(name, wanted)) names.push_back(std::move(name));
  if (names.empty())
    fail(Exit::BadInput, code::series_pattern, {pattern.string()}, "no file fits the pattern",
         {"'*' stands for any characters and '?' for one, in the last part of the name only; quote it from the shell"});
  std::sort(names.begin(), names.end(), before);
  std::vector<fs::path> files;
  for (const std::string& name : names) files.push_back(folder / name);
  return files;
}

bool is_trajectory_name(const fs::path& name) {
  const std::string extension = plain_extension(name);
  for (const Format& format : formats()) {
    if (!format.positions_only) continue;
    Words words(format.extensions);
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
      if (word == extension) return true;
  }
  return false;
}

std::uint64_t frame_index(std::int64_t wanted, std::uint64_t count, const SourceLoc& loc) {
  const auto frames = static_cast<std::int64_t>(count);
  if (wanted >= -frames && wanted < frames) return static_cast<std::uint64_t>(wanted < 0 ? wanted + frames : wanted);
  fail(Exit::BadInput, code::no_frame, loc,
       fmt::format("there is no frame {}: there {} {} {} (0 to {}, or -1 to -{} from the end)", wanted, count == 1 ? "is" : "are", count,
                   count == 1 ? "frame" : "frames", count - 1, count));
}

std::vector<std::uint64_t> frame_list(std::string_view text, std::uint64_t count, const SourceLoc& loc) {
  std::vector<std::uint64_t> out;
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    const std::string_view part = trim(rest.substr(0, comma));
    if (std::int64_t index = 0; parse_integer(part, index)) {
      out.push_back(frame_index(index, count, loc));
    } else {
      const auto slice = part.find(':') == std::string_view::npos ? std::nullopt : slice_of(part);
      if (!slice || (*slice)[2] == 0) bad_list(text, part, loc);
      add_slice(*slice, count, out);
    }
    if (comma == std::string_view::npos) return out;
    rest.remove_prefix(comma + 1);
  }
}

} // namespace mote::data
