// SPDX-License-Identifier: MIT
// How the layer reports. Inside, a broken rule throws Fault; the public call catches it, adds "While
// calling ..." and hands it to the device's ErrorSink, which gives it to the innermost scope of its
// kind or to the uncaptured handler. No exception leaves a public call.
//
// A Fault without a code is secondary: an object was used that an earlier, reported call failed to
// make. Such a call fails silently, so that one broken shader gives one message and not a page.
#pragma once

#include "core/gpu/gpu.hpp"

#include <fmt/format.h>

#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mote::gpu {

class Fault : public std::exception {
public:
  explicit Fault(Error error) : error_(std::move(error)) {}
  [[nodiscard]] const char* what() const noexcept override { return error_.message.c_str(); }
  [[nodiscard]] Error& error() { return error_; }
  [[nodiscard]] const Error& error() const { return error_; }
  [[nodiscard]] bool secondary() const { return error_.code.empty(); }

private:
  Error error_;
};

template <class... Args>
[[noreturn]] void invalid(std::string_view code, fmt::format_string<Args...> text, Args&&... args) {
  throw Fault({ErrorFilter::Validation, std::string(code), fmt::format(text, std::forward<Args>(args)...), {}});
}
template <class... Args>
[[noreturn]] void out_of_memory(std::string_view code, fmt::format_string<Args...> text, Args&&... args) {
  throw Fault({ErrorFilter::OutOfMemory, std::string(code), fmt::format(text, std::forward<Args>(args)...), {}});
}
template <class... Args>
[[noreturn]] void internal_error(std::string_view code, fmt::format_string<Args...> text, Args&&... args) {
  throw Fault({ErrorFilter::Internal, std::string(code), fmt::format(text, std::forward<Args>(args)...), {}});
}
[[noreturn]] inline void secondary_fault() { throw Fault(Error{}); }

// [Buffer "positions"]; without a label [Buffer].
std::string named(std::string_view type, std::string_view label);

// Runs `body`; a Fault that passes through gets the line "While <note()>." appended.
template <class Note, class Body> decltype(auto) in_context(Note&& note, Body&& body) {
  try {
    return body();
  } catch (Fault& fault) {
    fault.error().context.push_back(fmt::format("While {}.", note()));
    throw;
  }
}

// One per device; single-threaded as the device is.
class ErrorSink {
public:
  void push(ErrorFilter filter) { scopes_.push_back({filter, std::nullopt}); }
  std::optional<Error> pop(); // Fault V-DEV-001 when no scope is open
  void set_handler(std::function<void(const Error&)> handler) { handler_ = std::move(handler); }
  void report(Error error);   // the first error of a scope is kept, later ones are dropped

private:
  struct Scope {
    ErrorFilter filter{};
    std::optional<Error> first{};
  };
  std::vector<Scope> scopes_;
  std::function<void(const Error&)> handler_;
};

} // namespace mote::gpu
