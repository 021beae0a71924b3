// SPDX-License-Identifier: MIT
// What the tests of core/data share: text as a file, the failure of a call, and the promises that every
// frame keeps. No GoogleTest here, so that the fuzzer can use it.
#pragma once

#include "core/data/bytes.hpp"
#include "core/data/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace mote::data::test {

inline std::unique_ptr<Source> open_text(std::string_view content, std::string_view extension = {}) {
  return open_bytes(Bytes::from_memory("input", content), extension);
}
inline Frame read_text(std::string_view content, std::string_view extension = {}, std::uint64_t frame = 0) {
  return open_text(content, extension)->read(frame);
}

// The diagnostic of the Failure that `call` throws; code "none" when it throws none.
inline Diagnostic failure_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Failure& failure) {
    return failure.exit() == Exit::BadInput ? failure.diagnostic()
                                            : Diagnostic{Severity::Error, "wrong exit"};
  }
  return {Severity::Error, "none"};
}
inline Diagnostic failure_of_text(std::string_view content, std::string_view extension = {},
                                  std::uint64_t frame = 0) {
  return failure_of([&] { (void)read_text(content, extension, frame); });
}

// What is wrong with a frame; empty if it keeps all promises of dataset.hpp.
inline std::string broken_promise(const Frame& frame) {
  const Column* position = frame.find("position");
  if (!position) return "no position";
  if (position->components != 3 || position->type() != ColumnType::Double) return "position is not double(3)";
  for (const Column& column : frame.columns) {
    if (column.rows() != frame.count)
      return fmt::format("{} has {} rows of {}", column.name, column.rows(), frame.count);
    if (std::count_if(frame.columns.begin(), frame.columns.end(),
                      [&](const Column& c) { return c.name == column.name; }) > 1)
      return fmt::format("{} is there twice", column.name);
    const auto* text = std::get_if<TextColumn>(&column.values);
    if (!text) continue;
    if (column.components != 1) return fmt::format("text {} has several components", column.name);
    for (const std::uint32_t code : text->codes)
      if (code >= text->dictionary.size())
        return fmt::format("{} has a code beyond its dictionary", column.name);
  }
  return {};
}

// Reads everything that `content` holds (at most 8 frames). Empty if every frame keeps its promises or
// a Failure was thrown; `frames` receives how many were read.
inline std::string survives(std::string_view content, std::string_view extension,
                            std::uint64_t* frames = nullptr) {
  if (frames) *frames = 0;
  try {
    const auto source = open_text(content, extension);
    if (const std::string flaw = broken_promise(source->read(0)); !flaw.empty()) return flaw;
    const std::uint64_t count = source->frame_count();
    if (count == 0) return "no frames";
    for (std::uint64_t k = 0; k < std::min<std::uint64_t>(count, 8); ++k) {
      if (const std::string flaw = broken_promise(source->read(k)); !flaw.empty()) return flaw;
      if (frames) ++*frames;
    }
  } catch (const Failure& failure) {
    if (failure.exit() != Exit::BadInput) return "a failure that is not bad input";
    if (failure.diagnostic().code.empty() || failure.diagnostic().text.empty())
      return "a failure without code or words";
  }
  return {};
}

} // namespace mote::data::test
