// SPDX-License-Identifier: MIT
// The pipeline cache's file format.
#include "core/gpu/vk/pipeline_cache.hpp"

#include <gtest/gtest.h>

namespace mote::gpu::vk {
namespace {

const PipelineCacheKey key{"6d657361", 7};
std::vector<std::byte> payload() { return {std::byte{1}, std::byte{2}, std::byte{3}}; }

TEST(PipelineCacheFile, round_trip) {
  const auto back = unpack_pipeline_cache(key, pack_pipeline_cache(key, payload()));
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, payload());
}
TEST(PipelineCacheFile, other_device_or_driver) {
  const auto file = pack_pipeline_cache(key, payload());
  EXPECT_FALSE(unpack_pipeline_cache({"6d657361", 8}, file));
  EXPECT_FALSE(unpack_pipeline_cache({"6d657362", 7}, file));
  EXPECT_NE(pipeline_cache_name(key), pipeline_cache_name({"6d657361", 8}));
}
TEST(PipelineCacheFile, every_damaged_byte_and_every_cut_is_noticed) {
  const auto good = pack_pipeline_cache(key, payload());
  for (std::size_t i = 0; i < good.size(); ++i) {
    auto bad = good;
    bad[i] ^= std::byte{0x10};
    EXPECT_FALSE(unpack_pipeline_cache(key, bad)) << "byte " << i;
    EXPECT_FALSE(unpack_pipeline_cache(key, std::span(good).first(i))) << "cut at " << i;
  }
}

} // namespace
} // namespace mote::gpu::vk
