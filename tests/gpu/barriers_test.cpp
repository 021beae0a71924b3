// SPDX-License-Identifier: MIT
// The planner by table: what is needed, what is not, and the exact barrier of the common cases.
#include "core/gpu/barriers.hpp"

#include <gtest/gtest.h>

namespace mote::gpu {
namespace {

class Planner {
public:
  explicit Planner(Feature features = Feature::None) : features_(features) {}
  BarrierPlan buffer(BufferState& state, Use use) {
    ScopeList list;
    list.begin(++serial_);
    EXPECT_FALSE(list.add(state, use));
    list.end();
    return plan(list);
  }
  BarrierPlan texture(TextureState& state, const SubresourceRange& range, Use use, bool discard = false) {
    ScopeList list;
    list.begin(++serial_);
    EXPECT_FALSE(list.add(state, range, use, discard));
    list.end();
    return plan(list);
  }
  BarrierPlan plan(const ScopeList& list) const {
    BarrierPlan result;
    plan_barriers(list, features_, result);
    return result;
  }
  std::uint64_t next() { return ++serial_; }

private:
  Feature features_;
  std::uint64_t serial_{};
};

struct BufferCase {
  Use first, second;
  bool barrier;
};

TEST(Barriers, buffer_pairs) {
  using enum Use;
  const BufferCase cases[] = {
      {CopyDst, Vertex, true},   {CopyDst, CopyDst, true},       {StorageWrite, StorageWrite, true}, {StorageWrite, Indirect, true},
      {Vertex, CopyDst, true},   {StorageRead, StorageWrite, true}, {Vertex, Index, false},          {Uniform, StorageRead, false},
      {CopySrc, CopySrc, false}, {CopySrc, StorageRead, false},  {StorageWrite, CopySrc, true},
  };
  for (const BufferCase& c : cases) {
    Planner planner;
    BufferState state;
    EXPECT_EQ(planner.buffer(state, c.first).scopes[0].memory.dst.stages, 0u) << "first use: " << to_string(c.first);
    EXPECT_EQ(planner.buffer(state, c.second).scopes[0].memory.dst.stages != 0, c.barrier) << to_string(c.first) << " -> " << to_string(c.second);
  }
}

TEST(Barriers, second_kind_of_read_after_a_write_needs_its_own_barrier) {
  Planner planner;
  BufferState state;
  planner.buffer(state, Use::CopyDst);
  planner.buffer(state, Use::Vertex);
  const MemoryBarrier b = planner.buffer(state, Use::Uniform).scopes[0].memory;
  EXPECT_NE(b.src.stages & VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0u);
  EXPECT_EQ(b.src.access, VK_ACCESS_2_TRANSFER_WRITE_BIT);
  EXPECT_EQ(b.dst.access, VK_ACCESS_2_UNIFORM_READ_BIT);
  EXPECT_EQ(planner.buffer(state, Use::Vertex).scopes[0].memory.dst.stages, 0u) << "already synchronized";
}

TEST(Barriers, attachment_written_twice_is_ordered) {
  Planner planner;
  TextureState t;
  planner.texture(t, {0, 1, 0, 1}, Use::ColorAttachment, true);
  const BarrierPlan again = planner.texture(t, {0, 1, 0, 1}, Use::ColorAttachment);
  ASSERT_EQ(again.images.size(), 1u);
  EXPECT_EQ(again.images[0].old_layout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  EXPECT_EQ(again.images[0].src.access, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
  EXPECT_EQ(again.images[0].dst.stages, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT);
}

TEST(Barriers, cleared_attachment_forgets_its_contents_but_waits_for_readers) {
  Planner planner;
  TextureState t;
  planner.texture(t, {0, 1, 0, 1}, Use::ColorAttachment, true);
  planner.texture(t, {0, 1, 0, 1}, Use::Sampled);
  const BarrierPlan clear = planner.texture(t, {0, 1, 0, 1}, Use::ColorAttachment, true);
  ASSERT_EQ(clear.images.size(), 1u);
  EXPECT_EQ(clear.images[0].old_layout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_NE(clear.images[0].src.stages & VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, 0u);
}

TEST(Barriers, sampling_again_is_free_and_depth_may_be_tested_and_sampled_at_once) {
  Planner planner;
  TextureState t;
  t.depth = true;
  planner.texture(t, {0, 1, 0, 1}, Use::DepthWrite, true);
  ScopeList both;
  both.begin(planner.next());
  EXPECT_FALSE(both.add(t, {0, 1, 0, 1}, Use::DepthRead));
  EXPECT_FALSE(both.add(t, {0, 1, 0, 1}, Use::Sampled));
  both.end();
  const BarrierPlan plan = planner.plan(both);
  ASSERT_EQ(plan.images.size(), 1u);
  EXPECT_EQ(plan.images[0].new_layout, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL);
  EXPECT_TRUE(planner.texture(t, {0, 1, 0, 1}, Use::Sampled).images.empty());
  EXPECT_TRUE(planner.texture(t, {0, 1, 0, 1}, Use::DepthRead).images.empty());
}

TEST(Barriers, geometry_stage_is_named_only_with_the_feature) {
  for (const bool geometry : {false, true}) {
    Planner planner(geometry ? Feature::GeometryShader : Feature::None);
    BufferState state;
    planner.buffer(state, Use::CopyDst);
    const MemoryBarrier b = planner.buffer(state, Use::StorageRead).scopes[0].memory;
    EXPECT_EQ((b.dst.stages & VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT) != 0, geometry);
  }
}

TEST(Barriers, one_mip_level_at_a_time) {
  Planner planner;
  TextureState t;
  t.mips = 3;
  planner.texture(t, {0, 3, 0, 1}, Use::CopyDst, true);
  const BarrierPlan one = planner.texture(t, {1, 1, 0, 1}, Use::StorageWrite);
  ASSERT_EQ(one.images.size(), 1u);
  EXPECT_EQ(one.images[0].range, (SubresourceRange{1, 1, 0, 1}));
  EXPECT_EQ(t.parts.size(), 3u);
  const BarrierPlan all = planner.texture(t, {0, 3, 0, 1}, Use::Sampled);
  EXPECT_EQ(all.images.size(), 3u);
  EXPECT_EQ(all.images[1].old_layout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(all.images[2].old_layout, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
}

TEST(Barriers, states_that_become_equal_are_one_again) {
  Planner planner;
  TextureState t;
  t.layers = 4;
  planner.texture(t, {0, 1, 1, 2}, Use::CopyDst);
  EXPECT_EQ(t.parts.size(), 4u);
  planner.texture(t, {0, 1, 0, 4}, Use::CopyDst);
  EXPECT_TRUE(t.parts.empty());
}

TEST(Barriers, host_reads_are_noticed) {
  Planner planner;
  BufferState plain, mapped;
  mapped.host_reads = true;
  EXPECT_FALSE(planner.buffer(plain, Use::CopyDst).host_reads);
  EXPECT_TRUE(planner.buffer(mapped, Use::CopyDst).host_reads);
}

} // namespace
} // namespace mote::gpu
