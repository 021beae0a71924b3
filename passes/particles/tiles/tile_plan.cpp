// SPDX-License-Identifier: MIT
#include "passes/particles/tiles/tile_plan.hpp"

#include "core/scene/chunks.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace mote::passes {
namespace {

constexpr std::uint32_t small_scene = 2048;             // chunks: below it the others are one step
constexpr std::uint64_t least_room = 16, most_room = 128; // entries of a tile's own places: 33 MiB at 1920x1080 at most
constexpr std::uint64_t most_reserved = 1u << 30;       // of a step: the kernels count in 32 bits
constexpr std::array<std::uint32_t, 4> shares{16, 8, 4, 2}; // the nearest 1/16 of the chunks, then up to 1/8, 1/4, 1/2, all

std::uint32_t cells_of(std::uint32_t tiles, std::uint32_t shift) { return (tiles + (1u << shift) - 1u) >> shift; }

// Appends the chunks [first, end) as steps none of which reserves more than the kernels can count; `reserved_by`: entries of each chunk.
void add_steps(TilePlan& plan, std::span<const std::uint64_t> reserved_by, std::uint32_t first, std::uint32_t end, bool others) {
  std::uint64_t reserved = 0;
  std::uint32_t begin = first;
  auto close = [&](std::uint32_t last) {
    if (begin < last) plan.steps.push_back({begin, last - begin, others, static_cast<std::uint32_t>(reserved / plan.capacity + 1)});
    begin = last;
    reserved = 0;
  };
  for (std::uint32_t i = first; i < end; ++i) {
    const std::uint64_t own = reserved_by[i];
    if (reserved + own > most_reserved) close(i);
    reserved += own;
  }
  close(end);
}

} // namespace

std::uint64_t reserved_entries(const TileChunk& chunk) {
  if (chunk.side != 0) return 0;
  const glm::uvec2 span = corner(chunk.rect_hi) - corner(chunk.rect_lo) + 1u;
  const std::uint32_t x = chunk.rect_lo >> 24, y = chunk.rect_hi >> 24;
  return std::uint64_t{chunk_capacity} * std::max((x == 255 ? span.x : std::min(x, span.x)) * (y == 255 ? span.y : std::min(y, span.y)), 4u);
}

std::uint32_t TilePlan::most_rounds() const {
  std::uint32_t most = 0;
  for (const TileStep& step : steps) most = std::max(most, step.rounds);
  return most;
}

void sort_by_depth(std::vector<TileChunk>& chunks, std::vector<TileChunk>& scratch) {
  if (chunks.empty()) return;
  // Positive floats order as their bits do.
  auto key = [](const TileChunk& chunk) { return std::bit_cast<std::uint32_t>(std::max(chunk.z_min, 0.0f)); };
  std::uint32_t least = ~0u, most = 0;
  for (const TileChunk& chunk : chunks) {
    least = std::min(least, key(chunk));
    most = std::max(most, key(chunk));
  }
  constexpr int bucket_bits = 5; // coarse: within a bucket chunks stay neighbors, which caches like
  const int shift = std::max(0, static_cast<int>(std::bit_width(most - least)) - bucket_bits);
  std::vector<std::uint32_t> starts((1u << bucket_bits) + 2u);
  for (const TileChunk& chunk : chunks) ++starts[((key(chunk) - least) >> shift) + 1];
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
  scratch.resize(chunks.size());
  for (const TileChunk& chunk : chunks) scratch[starts[(key(chunk) - least) >> shift]++] = chunk;
  chunks.swap(scratch);
}

void choose_splats(std::span<TileChunk> chunks) {
  const auto splats = static_cast<std::size_t>(std::count_if(chunks.begin(), chunks.end(), [](const TileChunk& c) { return c.side != 0; }));
  if (splats == 0 || 10 * splats >= 9 * chunks.size()) return;
  for (TileChunk& chunk : chunks) chunk.side = 0;
}

TilePlan plan_tiles(std::span<const TileChunk> chunks, std::uint32_t width, std::uint32_t height, std::uint32_t most_capacity, bool gather) {
  TilePlan plan;
  plan.tiles_x = (width + tile_size - 1) / tile_size;
  plan.tiles_y = (height + tile_size - 1) / tile_size;
  plan.level1 = plan.tiles_x * plan.tiles_y;
  plan.level2 = plan.level1 + cells_of(plan.tiles_x, 2) * cells_of(plan.tiles_y, 2);
  plan.level3 = plan.level2 + cells_of(plan.tiles_x, 4) * cells_of(plan.tiles_y, 4);
  plan.cells = plan.level3 + cells_of(plan.tiles_x, 6) * cells_of(plan.tiles_y, 6);

  std::uint64_t reserved = 0, largest = 0;
  std::vector<std::uint64_t> reserved_by;
  reserved_by.reserve(chunks.size());
  plan.depth_first = plan.depth_last = chunks.empty() ? 1.0f : chunks.front().z_min;
  for (const TileChunk& chunk : chunks) {
    plan.depth_first = std::min(plan.depth_first, chunk.z_min);
    plan.depth_last = std::max(plan.depth_last, chunk.z_min);
    plan.splats += chunk.side != 0;
    reserved_by.push_back(reserved_entries(chunk));
    reserved += reserved_by.back();
    largest = std::max(largest, reserved_by.back());
  }
  plan.capacity = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(reserved, 4 * chunk_capacity, most_capacity));
  plan.most_entries = plan.capacity + static_cast<std::uint32_t>(largest);
  plan.list_capacity = plan.capacity / (4 * chunk_capacity) + 1;
  const std::uint64_t average = plan.capacity / plan.level1 + 1;
  plan.tile_room = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(std::bit_ceil(2 * average), least_room, most_room));

  const auto count = static_cast<std::uint32_t>(chunks.size());
  plan.gathered = gather && count != 0 && plan.splats == 0 && reserved <= most_capacity;
  if (plan.gathered) {
    plan.steps = {{0, count, false, 1}, {0, count, true, 1}};
    return plan;
  }
  add_steps(plan, reserved_by, 0, count, false);
  std::uint32_t first = 0;
  if (count > small_scene)
    for (const std::uint32_t share : shares) {
      add_steps(plan, reserved_by, first, count / share, true);
      first = count / share;
    }
  add_steps(plan, reserved_by, first, count, true);
  return plan;
}

} // namespace mote::passes
