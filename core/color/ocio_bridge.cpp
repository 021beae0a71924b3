// SPDX-License-Identifier: MIT
#include "core/color/ocio_bridge.hpp"

#include <mutex>

namespace mote {

namespace {
thread_local std::vector<std::string> log_lines;

void keep_line(const char* text) {
  std::string line = one_line(text);
  if (!line.empty() && log_lines.size() < 100) log_lines.push_back(std::move(line));
}
} // namespace

void catch_ocio_log() {
  static std::once_flag once;
  std::call_once(once, [] { OCIO::SetLoggingFunction(keep_line); });
}

std::vector<std::string> take_ocio_log() { return std::exchange(log_lines, {}); }

std::string one_line(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const char kept = c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
    if (kept != ' ' || (!out.empty() && out.back() != ' ')) out += kept;
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

} // namespace mote
