// SPDX-License-Identifier: MIT
#include "passes/particles/radix_sort.hpp"

#include "core/base/parallel.hpp"

#include <array>

namespace mote::passes {
namespace {

constexpr unsigned digit_bits = 11;
constexpr std::size_t digits = std::size_t{1} << digit_bits;
constexpr std::uint64_t grain = 1u << 16; // items that are worth a thread

using Histogram = std::array<std::uint32_t, digits>;

std::size_t digit(const KeyValue& item, unsigned shift) { return static_cast<std::size_t>(item.key >> shift) & (digits - 1); }

// Where each part writes its items of each digit: digits first, then parts, so that the sort is stable.
void to_offsets(std::vector<Histogram>& counts) {
  std::uint32_t sum = 0;
  for (std::size_t d = 0; d < digits; ++d)
    for (Histogram& part : counts) {
      const std::uint32_t count = part[d];
      part[d] = sum;
      sum += count;
    }
}

void pass(const std::vector<KeyValue>& from, std::vector<KeyValue>& to, unsigned shift, std::uint32_t parts) {
  std::vector<Histogram> counts(parts);
  parallel_parts(from.size(), parts, [&](std::uint32_t part, std::uint64_t begin, std::uint64_t end) {
    counts[part].fill(0);
    for (std::uint64_t i = begin; i < end; ++i) ++counts[part][digit(from[i], shift)];
  });
  to_offsets(counts);
  parallel_parts(from.size(), parts, [&](std::uint32_t part, std::uint64_t begin, std::uint64_t end) {
    Histogram& place = counts[part];
    for (std::uint64_t i = begin; i < end; ++i) to[place[digit(from[i], shift)]++] = from[i];
  });
}

} // namespace

void radix_sort(std::vector<KeyValue>& items) {
  if (items.size() < 2) return;
  std::uint64_t differing = 0;
  for (const KeyValue& item : items) differing |= item.key ^ items.front().key;
  const std::uint32_t parts = thread_count(items.size(), grain);
  std::vector<KeyValue> other(items.size());
  for (unsigned shift = 0; shift < 64; shift += digit_bits) {
    if ((differing >> shift & (digits - 1)) == 0) continue;
    pass(items, other, shift, parts);
    items.swap(other);
  }
}

} // namespace mote::passes
