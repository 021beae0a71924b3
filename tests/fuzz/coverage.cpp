// SPDX-License-Identifier: MIT
#include "tests/fuzz/coverage.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace {

constexpr std::size_t places = 1 << 16;
std::array<std::uint8_t, places> taken{}, known{};
thread_local std::uintptr_t before = 0;

// One bit for each step of counts.
std::uint8_t step_of(std::uint8_t count) {
  if (count < 4) return static_cast<std::uint8_t>((1u << count) >> 1);
  return static_cast<std::uint8_t>(count < 8 ? 8 : count < 16 ? 16 : count < 32 ? 32 : count < 128 ? 64 : 128);
}

} // namespace

// Called by the compiler at every block of core/data.
extern "C" __attribute__((no_sanitize("address", "undefined"))) void __sanitizer_cov_trace_pc() {
  const auto here = reinterpret_cast<std::uintptr_t>(__builtin_return_address(0));
  const std::uintptr_t mixed = here * 0x9e3779b97f4a7c15u >> 32;
  std::uint8_t& count = taken[(mixed ^ before) % places];
  count = static_cast<std::uint8_t>(count == 255 ? 255 : count + 1);
  before = mixed >> 1;
}

namespace mote::fuzz {

void clear_coverage() {
  taken.fill(0);
  before = 0;
}

bool covered_anything_new() {
  bool is_new = false;
  for (std::size_t i = 0; i < places; ++i) {
    if (!taken[i]) continue;
    const std::uint8_t step = step_of(taken[i]);
    is_new |= (known[i] & step) == 0;
    known[i] = static_cast<std::uint8_t>(known[i] | step);
  }
  return is_new;
}

} // namespace mote::fuzz
