// SPDX-License-Identifier: MIT
// Which uses go together in one scope.
#include "core/gpu/usage.hpp"

#include <gtest/gtest.h>

namespace mote::gpu {
namespace {

using enum Use;

struct Pair {
  Use a, b;
  bool together;
};
constexpr Pair buffer_pairs[] = {
    {Vertex, Index, true},         {Uniform, StorageRead, true},   {StorageWrite, StorageWrite, true}, {StorageRead, StorageWrite, false},
    {Uniform, StorageWrite, false}, {Indirect, StorageWrite, false}, {CopySrc, CopyDst, false},        {CopyDst, CopyDst, true},
    {Vertex, StorageWrite, false}, {Indirect, StorageRead, true},  {StorageRead, CopySrc, true},
};
constexpr Pair texture_pairs[] = {
    {Sampled, Sampled, true},    {Sampled, ColorAttachment, false}, {Sampled, StorageWrite, false}, {Sampled, StorageRead, false},
    {Sampled, DepthRead, true},  {Sampled, DepthWrite, false},      {DepthRead, DepthWrite, false}, {Present, CopySrc, false},
    {StorageRead, StorageRead, true}, {StorageRead, CopySrc, false}, {Sampled, CopySrc, false}, {ColorAttachment, StorageRead, false},
};

TEST(Usage, buffer_pairs) {
  std::uint64_t serial = 0;
  for (const Pair& pair : buffer_pairs) {
    for (const bool swapped : {false, true}) {
      BufferState state;
      ScopeList list;
      list.begin(++serial);
      EXPECT_FALSE(list.add(state, swapped ? pair.b : pair.a));
      EXPECT_EQ(!list.add(state, swapped ? pair.a : pair.b), pair.together) << to_string(pair.a) << " + " << to_string(pair.b);
    }
  }
}

TEST(Usage, texture_pairs) {
  std::uint64_t serial = 0;
  for (const Pair& pair : texture_pairs) {
    TextureState state;
    ScopeList list;
    list.begin(++serial);
    EXPECT_FALSE(list.add(state, {}, pair.a));
    EXPECT_EQ(!list.add(state, {}, pair.b), pair.together) << to_string(pair.a) << " + " << to_string(pair.b);
  }
}

TEST(Usage, different_subresources_do_not_conflict) {
  TextureState state;
  state.mips = 2;
  state.layers = 2;
  ScopeList list;
  list.begin(1);
  EXPECT_FALSE(list.add(state, {0, 1, 0, 2}, Sampled));
  EXPECT_FALSE(list.add(state, {1, 1, 0, 1}, StorageWrite));
  const auto conflict = list.add(state, {0, 2, 1, 1}, StorageWrite);
  ASSERT_TRUE(conflict);
  EXPECT_EQ(conflict->before, Sampled);
  EXPECT_EQ(conflict->added, StorageWrite);
}

TEST(Usage, scopes_are_separate_and_entries_merge) {
  BufferState state;
  ScopeList list;
  list.begin(1);
  EXPECT_FALSE(list.add(state, Vertex));
  EXPECT_FALSE(list.add(state, Index));
  EXPECT_EQ(list.end(), 0u);
  list.begin(2);
  EXPECT_FALSE(list.add(state, StorageWrite));
  EXPECT_EQ(list.end(), 1u);
  ASSERT_EQ(list.buffers().size(), 2u);
  EXPECT_EQ(list.buffers()[0].use, Vertex | Index);
}

TEST(Usage, scopes_recorded_in_turns_still_find_their_entries) {
  BufferState state;
  ScopeList older, newer;
  older.begin(1);
  newer.begin(2);
  EXPECT_FALSE(older.add(state, Vertex));
  EXPECT_FALSE(newer.add(state, StorageWrite));
  EXPECT_FALSE(older.add(state, Index));
  EXPECT_TRUE(older.add(state, StorageWrite)) << "the older scope must still know its own uses";
  EXPECT_TRUE(newer.add(state, Uniform));
  EXPECT_EQ(older.buffers().size(), 1u);
  EXPECT_EQ(newer.buffers().size(), 1u);
}

TEST(Usage, prints_as_words) {
  EXPECT_EQ(to_string(Sampled | DepthRead), "Sampled|DepthRead");
  EXPECT_EQ(to_string(Use::None), "None");
}

} // namespace
} // namespace mote::gpu
