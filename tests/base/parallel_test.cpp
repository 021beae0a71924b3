// SPDX-License-Identifier: MIT
// Every index once, whatever the number of threads; the lowest failure is the one that is reported.
#include "core/base/parallel.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <numeric>
#include <stdexcept>

namespace mote {
namespace {

TEST(Parallel, EveryBlockOnce) {
  for (const unsigned threads : {0u, 1u, 3u, 64u})
    for (const std::size_t blocks : {0u, 1u, 2u, 1000u}) {
      std::vector<std::atomic<int>> seen(blocks);
      for_each_block(blocks, [&](std::size_t i) { ++seen[i]; }, threads);
      for (const auto& count : seen) ASSERT_EQ(count, 1);
    }
}

TEST(Parallel, TheLowestFailureIsThrown) {
  for (int run = 0; run < 20; ++run) {
    try {
      for_each_block(100, [](std::size_t i) {
        if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
      }, 4);
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "7");
    }
  }
}

TEST(Parallel, PartsAreConsecutiveAndNearlyEqual) {
  for (const std::uint64_t count : {0u, 1u, 7u, 1000u}) {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges(3);
    parallel_parts(count, 3, [&](std::uint32_t part, std::uint64_t begin, std::uint64_t end) { ranges[part] = {begin, end}; });
    EXPECT_EQ(ranges[0].first, 0u);
    EXPECT_EQ(ranges[2].second, count);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(ranges[i].first, i > 0 ? ranges[i - 1].second : 0u);
      EXPECT_LE(ranges[i].second - ranges[i].first, count / 3 + 1);
      EXPECT_GE(ranges[i].second - ranges[i].first, count / 3);
    }
  }
}

TEST(Parallel, ShortRangesStayOnOneThread) {
  EXPECT_EQ(thread_count(10, 100), 1u);
  EXPECT_EQ(thread_count(0, 100), 1u);
  EXPECT_EQ(thread_count(std::uint64_t{1} << 40, 1), worker_count());
  EXPECT_GE(worker_count(), 1u);
}

} // namespace
} // namespace mote
