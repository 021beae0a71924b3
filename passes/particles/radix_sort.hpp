// SPDX-License-Identifier: MIT
// A stable radix sort of (64-bit key, 32-bit value) pairs on all cores: the order of transparent
// particles. Called by particles/order.cpp when something moved; pure, no device. Digits that all keys
// share cost one look and no pass, so keys of one scene (doubles of similar size) take about half of the
// passes.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace mote::passes {

struct KeyValue {
  std::uint64_t key{};
  std::uint32_t value{};
};

// Ascending by key; equal keys keep their order, whatever the number of threads.
void radix_sort(std::vector<KeyValue>& items);

// An unsigned number that orders as the double does: -inf first, then +inf, NaN of either sign last.
inline std::uint64_t sortable(double value) {
  if (value != value) return ~std::uint64_t{0};
  const auto bits = std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value); // -0 equals 0
  return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
}

} // namespace mote::passes
