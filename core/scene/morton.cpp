// SPDX-License-Identifier: MIT
#include "core/scene/morton.hpp"

#include "core/base/parallel.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace mote {
namespace {

constexpr std::uint64_t grain = 32768;        // points worth a thread of their own
constexpr std::uint32_t refine_above = 64;    // points in one cell that are worth a finer grid
constexpr std::uint32_t digit_bits = 10;      // of the radix sort: 1024 buckets stay in the first cache level
constexpr std::uint32_t buckets = 1u << digit_bits;

// One key: Morton code in the upper half, index in the lower half.
using Entry = std::uint64_t;

struct Box {
  glm::dvec3 min{std::numeric_limits<double>::max()}, max{std::numeric_limits<double>::lowest()};
  void add(const glm::dvec3& p) { min = glm::min(min, p); max = glm::max(max, p); }
};

// abc -> a00b00c..., for 10 bits
std::uint32_t spread(std::uint32_t x) {
  x = (x | (x << 16)) & 0x030000FFu;
  x = (x | (x << 8)) & 0x0300F00Fu;
  x = (x | (x << 4)) & 0x030C30C3u;
  return (x | (x << 2)) & 0x09249249u;
}

struct Grid {
  glm::dvec3 origin, scale;
  explicit Grid(const Box& box) : origin(box.min) {
    const glm::dvec3 size = box.max - box.min;
    const double edge = std::max({size.x, size.y, size.z}); // cubic cells
    scale = glm::dvec3(edge > 0.0 ? 1024.0 / edge : 0.0);
  }
  [[nodiscard]] std::uint32_t code(const glm::dvec3& p) const {
    const glm::dvec3 cell = glm::min((p - origin) * scale, glm::dvec3(1023.0));
    return spread(static_cast<std::uint32_t>(cell.x)) << 2 | spread(static_cast<std::uint32_t>(cell.y)) << 1 |
           spread(static_cast<std::uint32_t>(cell.z));
  }
};

Box bounds_of(std::span<const glm::dvec3> points, std::span<const std::uint32_t> order) {
  Box box;
  for (std::uint32_t i : order) box.add(points[i]);
  return box;
}

// Stable, least significant digit first; each thread owns a part of the input and, after the counts are known,
// its own places in the output.
void radix_sort(std::vector<Entry>& entries, std::vector<Entry>& scratch, std::uint32_t parts) {
  std::vector<std::array<std::uint64_t, buckets>> places(parts);
  for (std::uint32_t shift = 32; shift < 62; shift += digit_bits) {
    auto digit = [shift](Entry e) { return static_cast<std::uint32_t>(e >> shift) & (buckets - 1); };
    parallel_parts(entries.size(), parts, [&](std::uint32_t part, std::uint64_t begin, std::uint64_t end) {
      std::array<std::uint64_t, buckets> count{};
      for (std::uint64_t i = begin; i < end; ++i) ++count[digit(entries[i])];
      places[part] = count;
    });
    std::uint64_t next = 0;
    for (std::uint32_t b = 0; b < buckets; ++b)
      for (std::uint32_t part = 0; part < parts; ++part) {
        const std::uint64_t count = places[part][b];
        places[part][b] = next;
        next += count;
      }
    parallel_parts(entries.size(), parts, [&](std::uint32_t part, std::uint64_t begin, std::uint64_t end) {
      std::array<std::uint64_t, buckets> at = places[part];
      for (std::uint64_t i = begin; i < end; ++i) scratch[at[digit(entries[i])]++] = entries[i];
    });
    entries.swap(scratch);
  }
}

// Sorts one run of indices by a grid over its own box; true when the grid tells at least two of them apart.
bool sort_run(std::span<const glm::dvec3> points, std::span<std::uint32_t> run, std::vector<Entry>& sorted) {
  const Box box = bounds_of(points, run);
  if (box.min == box.max) return false;
  const Grid grid(box);
  if (!std::isfinite(grid.scale.x)) return false; // a box so small that 1024 / edge overflows
  sorted.clear();
  for (std::uint32_t i : run) sorted.push_back(Entry{grid.code(points[i])} << 32 | i);
  if (run.size() < 4096) {
    std::stable_sort(sorted.begin(), sorted.end(), [](Entry a, Entry b) { return a >> 32 < b >> 32; });
  } else {
    std::vector<Entry> scratch(sorted.size());
    radix_sort(sorted, scratch, thread_count(sorted.size(), grain));
  }
  for (std::size_t k = 0; k < run.size(); ++k) run[k] = static_cast<std::uint32_t>(sorted[k]);
  return true;
}

// Calls fn(first, last) for every maximal run of equal codes that is longer than refine_above.
template <class Fn> void crowded_cells(std::span<const Entry> entries, const Fn& fn) {
  std::size_t first = 0;
  for (std::size_t i = 1; i <= entries.size(); ++i) {
    if (i < entries.size() && entries[i] >> 32 == entries[first] >> 32) continue;
    if (i - first > refine_above) fn(first, i);
    first = i;
  }
}

} // namespace

std::vector<std::uint32_t> morton_order(std::span<const glm::dvec3> points) {
  const std::uint64_t n = points.size();
  const std::uint32_t parts = thread_count(n, grain);
  std::vector<Box> boxes(parts);
  parallel_parts(n, parts, [&](std::uint32_t part, std::uint64_t begin, std::uint64_t end) {
    Box box;
    for (std::uint64_t i = begin; i < end; ++i) box.add(points[i]);
    boxes[part] = box;
  });
  Box box;
  for (const Box& b : boxes)
    if (b.min.x <= b.max.x) { box.add(b.min); box.add(b.max); }
  std::vector<std::uint32_t> order(n);
  if (n == 0) return order;

  const Grid grid(box);
  std::vector<Entry> entries(n), scratch(n);
  parallel_parts(n, parts, [&](std::uint32_t, std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t i = begin; i < end; ++i) entries[i] = Entry{grid.code(points[i])} << 32 | i;
  });
  radix_sort(entries, scratch, parts);
  parallel_parts(n, parts, [&](std::uint32_t, std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t i = begin; i < end; ++i) order[i] = static_cast<std::uint32_t>(entries[i]);
  });

  // Cells that hold many points get a grid of their own, and so on down. Each level is at least 512 times finer,
  // so a double's digits are used up after a few levels; equal points end it at once.
  std::vector<std::span<std::uint32_t>> open;
  auto push = [&open](std::span<std::uint32_t> within) {
    return [&open, within](std::size_t first, std::size_t last) { open.push_back(within.subspan(first, last - first)); };
  };
  crowded_cells(entries, push(order));
  while (!open.empty()) {
    const std::span<std::uint32_t> run = open.back();
    open.pop_back();
    if (sort_run(points, run, scratch)) crowded_cells(std::span<const Entry>(scratch.data(), run.size()), push(run));
  }
  return order;
}

} // namespace mote
