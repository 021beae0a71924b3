// SPDX-License-Identifier: MIT
// How the compute expansion cuts a frame: pure, no device.
#include "passes/particles/tiles/tile_plan.hpp"

#include "core/scene/chunks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace mote;
using namespace mote::passes;

namespace {

TileChunk chunk_at(float z, glm::uvec2 lo, glm::uvec2 hi, glm::uvec2 most, std::uint32_t number) {
  return {.origin = {0, 0, z}, .z_min = z, .rect_lo = pack_corner(lo, most.x), .rect_hi = pack_corner(hi, most.y), .chunk = number};
}

std::vector<TileChunk> random_chunks(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<TileChunk> chunks;
  for (std::uint32_t i = 0; i < count; ++i) {
    const glm::uvec2 lo(random() % 200, random() % 100), hi = lo + glm::uvec2(random() % 40, random() % 35);
    chunks.push_back(chunk_at(10.0f + static_cast<float>(random() % 100000) * 0.01f, lo, hi, {1 + random() % 300, 1 + random() % 300}, i));
  }
  return chunks;
}

// The kernels' own counting (cull.comp): a step's cursor moves by what each chunk reserves.
void expect_rounds_hold(const TilePlan& plan, const TileStep& step, const std::vector<TileChunk>& chunks) {
  std::uint64_t cursor = 0;
  std::vector<std::uint64_t> held(step.rounds), listed(step.rounds);
  for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
    const std::uint64_t round = cursor / plan.capacity;
    ASSERT_LT(round, step.rounds);
    held[round] += reserved_entries(chunks[i]);
    ++listed[round];
    cursor += reserved_entries(chunks[i]);
  }
  ASSERT_LE(cursor, 0x7FFFFFFFu) << "the kernels count in 32 bits";
  for (std::uint32_t r = 0; r < step.rounds; ++r) {
    EXPECT_LE(held[r], plan.most_entries);
    EXPECT_LE(listed[r], plan.list_capacity);
  }
}

void expect_covers_once(const TilePlan& plan, std::size_t count, bool others) {
  std::uint32_t next = 0;
  for (const TileStep& step : plan.steps) {
    if (step.others != others) continue;
    EXPECT_EQ(step.first, next);
    EXPECT_GT(step.count, 0u);
    next += step.count;
  }
  EXPECT_EQ(next, count);
}

TEST(TilePlan, StepsCoverEveryChunkOnceInEachMode) {
  for (const std::size_t count : {0u, 1u, 2u, 15u, 2047u, 2048u, 2049u, 5000u, 40000u}) {
    const std::vector<TileChunk> chunks = random_chunks(count, 3);
    for (const std::uint32_t capacity : {1u << 12, 1u << 16, 1u << 21}) {
      const TilePlan plan = plan_tiles(chunks, 1920, 1080, capacity);
      expect_covers_once(plan, count, false);
      expect_covers_once(plan, count, true);
      for (const TileStep& step : plan.steps) expect_rounds_hold(plan, step, chunks);
    }
  }
}

// As many chunks in a round as there can be: each reserves the least.
TEST(TilePlan, RoundsOfTheSmallestChunks) {
  const std::vector<TileChunk> chunks(20000, chunk_at(1.0f, {3, 3}, {3, 3}, {1, 1}, 0));
  for (const std::uint32_t capacity : {1u << 12, 1u << 16}) {
    const TilePlan plan = plan_tiles(chunks, 640, 360, capacity);
    for (const TileStep& step : plan.steps) expect_rounds_hold(plan, step, chunks);
  }
}

TEST(TilePlan, AFewChunksAreSeenBeforeTheOthersAndManyInParts) {
  const TilePlan few = plan_tiles(random_chunks(2048, 1), 640, 360, 1u << 21);
  EXPECT_EQ(few.steps.size(), 2u);
  EXPECT_FALSE(few.steps[0].others);
  EXPECT_TRUE(few.steps[1].others);
  EXPECT_GT(plan_tiles(random_chunks(20000, 1), 640, 360, 1u << 21).steps.size(), 5u) << "the nearest sixteenth goes first";
}

// Asked for, and held by one round: the others are one step, whose entries join those of the first. Else rounds as ever, and never with splats.
TEST(TilePlan, GatheredWhereOneRoundHoldsAll) {
  std::vector<TileChunk> chunks = random_chunks(5000, 1);
  std::uint64_t reserved = 0;
  for (const TileChunk& chunk : chunks) reserved += reserved_entries(chunk);
  const auto enough = static_cast<std::uint32_t>(reserved);
  const TilePlan plan = plan_tiles(chunks, 640, 360, enough, true);
  EXPECT_TRUE(plan.gathered);
  EXPECT_EQ(plan.steps, (std::vector<TileStep>{{0, 5000, false, 1}, {0, 5000, true, 1}}));
  EXPECT_GE(plan.list_capacity, 5000u);
  EXPECT_GE(plan.most_entries, enough);
  EXPECT_EQ(plan_tiles(chunks, 640, 360, enough - 1, true).steps, plan_tiles(chunks, 640, 360, enough - 1).steps);
  EXPECT_FALSE(plan_tiles(chunks, 640, 360, enough - 1, true).gathered);
  EXPECT_FALSE(plan_tiles(chunks, 640, 360, enough).gathered) << "not asked for";
  chunks[7].side = 1;
  EXPECT_FALSE(plan_tiles(chunks, 640, 360, enough, true).gathered);
}

// 2^34 entries (what 2^26 chunks of small particles reserve) in 2^12 chunks of large ones: steps are cut before 32 bits end.
TEST(TilePlan, ReservationsBeyond32BitsAreCutIntoSteps) {
  std::vector<TileChunk> chunks(1u << 12, chunk_at(1.0f, {0, 0}, {255, 255}, {1000, 1000}, 0));
  ASSERT_EQ(reserved_entries(chunks[0]) * chunks.size(), 1ull << 34);
  const TilePlan plan = plan_tiles(chunks, 2048, 2048, 1u << 21);
  expect_covers_once(plan, chunks.size(), false);
  expect_covers_once(plan, chunks.size(), true);
  for (const TileStep& step : plan.steps) expect_rounds_hold(plan, step, chunks);
  EXPECT_GE(plan.steps.size(), 32u);
  // One chunk over the widest picture there can be.
  chunks = {chunk_at(1.0f, {0, 0}, {4095, 4095}, {1000, 1000}, 0)};
  const TilePlan widest = plan_tiles(chunks, 32768, 32768, 1u << 21);
  for (const TileStep& step : widest.steps) expect_rounds_hold(widest, step, chunks);
  EXPECT_EQ(widest.most_entries, widest.capacity + (1u << 30));
}

TEST(TilePlan, ReservationsAreBoundedByTheRectangleAndAtLeastFour) {
  EXPECT_EQ(reserved_entries(chunk_at(1, {2, 3}, {2, 3}, {2, 2}, 0)), 4u * chunk_capacity);
  EXPECT_EQ(reserved_entries(chunk_at(1, {2, 3}, {11, 12}, {3, 2}, 0)), 6u * chunk_capacity);
  EXPECT_EQ(reserved_entries(chunk_at(1, {2, 3}, {11, 12}, {30, 2}, 0)), 20u * chunk_capacity);
  EXPECT_EQ(reserved_entries(chunk_at(1, {0, 0}, {299, 1}, {255, 2}, 0)), 600u * chunk_capacity) << "255 means all of them";
}

TEST(TilePlan, CellsOfAllLevels) {
  const TilePlan plan = plan_tiles({}, 641, 361, 1u << 21);
  EXPECT_EQ(plan.tiles_x, 81u);
  EXPECT_EQ(plan.tiles_y, 46u);
  EXPECT_EQ(plan.level1, 81u * 46u);
  EXPECT_EQ(plan.level2 - plan.level1, 21u * 12u);
  EXPECT_EQ(plan.level3 - plan.level2, 6u * 3u);
  EXPECT_EQ(plan.cells - plan.level3, 2u * 1u);
}

TEST(TilePlan, TheSortIsStableAndFrontToBack) {
  std::vector<TileChunk> chunks = random_chunks(30000, 9), scratch;
  const std::vector<TileChunk> before = chunks;
  sort_by_depth(chunks, scratch);
  ASSERT_EQ(chunks.size(), before.size());
  std::vector<std::uint8_t> seen(chunks.size());
  float farthest = 0.0f; // of all that came so far
  std::size_t late = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    ASSERT_FALSE(seen[chunks[i].chunk]++) << "each chunk once";
    EXPECT_EQ(chunks[i].z_min, before[chunks[i].chunk].z_min);
    // Within one of 32 steps (of the floats' bits: at most a factor of 2 in depth) the order is the old one.
    const bool swapped = i > 0 && chunks[i].chunk < chunks[i - 1].chunk;
    EXPECT_TRUE(!swapped || chunks[i].z_min >= chunks[i - 1].z_min) << "not stable at " << i;
    late += chunks[i].z_min < 0.5f * farthest;
    farthest = std::max(farthest, chunks[i].z_min);
  }
  EXPECT_EQ(late, 0u) << "much nearer than one that came before";
  // Already in order, or all alike: nothing moves.
  std::vector<TileChunk> alike(100, chunk_at(3.0f, {0, 0}, {1, 1}, {1, 1}, 0));
  for (std::uint32_t i = 0; i < alike.size(); ++i) alike[i].chunk = i;
  sort_by_depth(alike, scratch);
  for (std::uint32_t i = 0; i < alike.size(); ++i) EXPECT_EQ(alike[i].chunk, i);
}

TEST(TilePlan, SplatsAreForPicturesOfThem) {
  std::vector<TileChunk> chunks = random_chunks(100, 3);
  for (std::size_t i = 0; i < 90; ++i) chunks[i].side = 2;
  choose_splats(chunks);
  EXPECT_EQ(chunks[0].side, 2u);
  EXPECT_EQ(plan_tiles(chunks, 1600, 800, 1u << 20).splats, 90u);
  EXPECT_EQ(reserved_entries(chunks[0]), 0u);
  chunks[0].side = 0;
  choose_splats(chunks);
  EXPECT_TRUE(std::all_of(chunks.begin(), chunks.end(), [](const TileChunk& c) { return c.side == 0; }));
}

} // namespace
