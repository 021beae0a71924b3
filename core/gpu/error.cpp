// SPDX-License-Identifier: MIT
#include "core/gpu/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace mote::gpu {

std::string to_string(const Error& error) {
  std::string text = fmt::format("{} error {}: {}", to_string(error.kind), error.code, error.message);
  for (const std::string& line : error.context) text += fmt::format("\n  - {}", line);
  return text;
}

std::string named(std::string_view type, std::string_view label) {
  return label.empty() ? fmt::format("[{}]", type) : fmt::format("[{} \"{}\"]", type, label);
}

std::optional<Error> ErrorSink::pop() {
  if (scopes_.empty()) invalid("V-DEV-001", "pop_error_scope is called without an open error scope.");
  std::optional<Error> first = std::move(scopes_.back().first);
  scopes_.pop_back();
  return first;
}

void ErrorSink::report(Error error) {
  for (std::size_t i = scopes_.size(); i-- > 0;) {
    if (scopes_[i].filter != error.kind) continue;
    if (!scopes_[i].first) scopes_[i].first = std::move(error);
    return;
  }
  if (handler_) {
    handler_(error);
    return;
  }
  std::fprintf(stderr, "mote: %s\n", to_string(error).c_str());
  std::abort();
}

} // namespace mote::gpu
