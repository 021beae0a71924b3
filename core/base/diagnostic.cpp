// SPDX-License-Identifier: MIT
#include "core/base/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <tuple>

namespace mote {

std::string_view to_string(Severity severity) {
  switch (severity) {
  case Severity::Note: return "note";
  case Severity::Warning: return "warning";
  case Severity::Error: return "error";
  }
  return "error";
}

std::string to_string(const SourceLoc& loc) {
  if (loc.byte >= 0) return fmt::format("{}:@{}", loc.file, loc.byte);
  if (loc.line == 0) return loc.file;
  if (loc.column == 0) return fmt::format("{}:{}", loc.file, loc.line);
  return fmt::format("{}:{}:{}", loc.file, loc.line, loc.column);
}

std::string to_string(const Diagnostic& d) {
  const std::string place = to_string(d.loc);
  std::string out = place.empty() ? "mote: " : place + ": ";
  out += fmt::format("{} {}: {}", to_string(d.severity), d.code, d.text);
  for (const std::string& hint : d.hints)
    if (!hint.empty()) out += "\n    " + hint;
  return out;
}

void Diagnostics::error(std::string_view code, SourceLoc loc, std::string text, std::vector<std::string> hints) {
  add({Severity::Error, std::string(code), std::move(loc), std::move(text), std::move(hints)});
}
void Diagnostics::warning(std::string_view code, SourceLoc loc, std::string text, std::vector<std::string> hints) {
  add({Severity::Warning, std::string(code), std::move(loc), std::move(text), std::move(hints)});
}
void Diagnostics::note(std::string_view code, SourceLoc loc, std::string text, std::vector<std::string> hints) {
  add({Severity::Note, std::string(code), std::move(loc), std::move(text), std::move(hints)});
}
void Diagnostics::append(const Diagnostics& other) {
  list_.insert(list_.end(), other.list_.begin(), other.list_.end());
}

bool Diagnostics::has_errors() const {
  return std::any_of(list_.begin(), list_.end(), [](const Diagnostic& d) { return d.severity == Severity::Error; });
}
bool Diagnostics::has(std::string_view code) const {
  return std::any_of(list_.begin(), list_.end(), [&](const Diagnostic& d) { return d.code == code; });
}
void Diagnostics::sort_by_place() {
  std::stable_sort(list_.begin(), list_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.loc.file, a.loc.line, a.loc.column, a.loc.byte) <
           std::tie(b.loc.file, b.loc.line, b.loc.column, b.loc.byte);
  });
}
std::string to_string(const Diagnostics& diagnostics) {
  std::string out;
  for (const Diagnostic& d : diagnostics.list()) out += to_string(d) + "\n";
  return out;
}

Failure::Failure(Exit exit, Diagnostic diagnostic)
    : exit_(exit), diagnostic_(std::move(diagnostic)), printed_(to_string(diagnostic_)) {}

void fail(Exit exit, std::string_view code, SourceLoc loc, std::string text, std::vector<std::string> hints) {
  throw Failure(exit, {Severity::Error, std::string(code), std::move(loc), std::move(text), std::move(hints)});
}

namespace {
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t swap = diagonal + (lower(a[i]) == lower(b[j]) ? 0u : 1u);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, swap});
    }
  }
  return row.back();
}
} // namespace

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
  const std::size_t limit = std::max<std::size_t>(1, word.size() / 3);
  std::size_t best = limit + 1;
  const std::string* found = nullptr;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best) {
      best = distance;
      found = &candidate;
    }
  }
  return found ? fmt::format("Did you mean '{}'?", *found) : std::string{};
}

std::string list_of(std::span<const std::string> words) {
  if (words.empty()) return "(none)";
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

} // namespace mote
