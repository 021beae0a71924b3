// SPDX-License-Identifier: MIT
// Entry point for libFuzzer: any bytes are either read into frames that hold together or refused.
#include "tests/data/support.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  for (const char* extension : {"", "xyz", "csv"})
    if (!mote::data::test::survives(content, extension).empty()) __builtin_trap();
  return 0;
}
