// SPDX-License-Identifier: MIT
// Random scopes, planned and then judged by an oracle that knows nothing of the planner.
#include "tests/gpu/barrier_oracle.hpp"

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <map>
#include <random>

namespace mote::gpu {
namespace {

class World {
public:
  World(std::uint32_t seed, bool geometry) : random_(seed), features_(geometry ? Feature::GeometryShader : Feature::None) {
    for (std::uint64_t i = 0; i < 3; ++i) {
      BufferState& buffer = buffers_.emplace_back();
      buffer.native = 100 + i;
      buffer_oracles_.emplace_back(false, false, geometry);
    }
    for (std::uint64_t i = 0; i < 3; ++i) {
      TextureState& texture = textures_.emplace_back();
      texture.native = i;
      texture.depth = i == 2;
      texture.mips = pick(1, 3);
      texture.layers = pick(1, 3);
      texture_oracles_.emplace_back(texture.mips * texture.layers, SubresourceOracle(true, texture.depth, geometry));
    }
  }

  // One recording of a few scopes; the empty string, or what is wrong.
  std::string step() {
    ScopeList list;
    const std::uint32_t count = pick(1, 4);
    for (std::uint32_t i = 0; i < count; ++i) {
      list.begin(++serial_);
      for (std::uint32_t k = pick(1, 5); k-- > 0;) add_random(list);
      list.end();
    }
    BarrierPlan plan;
    plan_barriers(list, features_, plan);
    for (std::size_t i = 0; i < list.scopes().size(); ++i) {
      std::string complaint = apply(plan, plan.scopes[i]);
      if (complaint.empty()) complaint = use(list, list.scopes()[i]);
      if (!complaint.empty()) return complaint;
    }
    return {};
  }

private:
  std::uint32_t pick(std::uint32_t low, std::uint32_t high) { return std::uniform_int_distribution(low, high)(random_); }

  void add_random(ScopeList& list) {
    static constexpr std::array buffer_uses{Use::Index,   Use::Vertex,  Use::Uniform,     Use::Indirect,
                                            Use::CopySrc, Use::CopyDst, Use::StorageRead, Use::StorageWrite};
    static constexpr std::array color_uses{Use::CopySrc, Use::CopyDst, Use::StorageRead, Use::StorageWrite, Use::Sampled, Use::ColorAttachment};
    static constexpr std::array depth_uses{Use::CopySrc, Use::CopyDst, Use::Sampled, Use::DepthRead, Use::DepthWrite};
    if (pick(0, 1) == 0) {
      // A conflicting addition changes nothing, as in a pass that reports it.
      static_cast<void>(list.add(buffers_[pick(0, 2)], buffer_uses[pick(0, buffer_uses.size() - 1)]));
      return;
    }
    TextureState& t = textures_[pick(0, 2)];
    const Use use = t.depth ? depth_uses[pick(0, depth_uses.size() - 1)] : color_uses[pick(0, color_uses.size() - 1)];
    SubresourceRange range{pick(0, t.mips - 1), 1, pick(0, t.layers - 1), 1};
    range.mips = pick(1, t.mips - range.base_mip);
    range.layers = pick(1, t.layers - range.base_layer);
    if (pick(0, 2) == 0) range = {0, t.mips, 0, t.layers};
    const bool discard = any(use & write_uses) && pick(0, 3) == 0;
    static_cast<void>(list.add(t, range, use, discard));
  }

  std::string apply(const BarrierPlan& plan, const ScopeBarriers& barriers) {
    if (barriers.memory.dst.stages != 0) {
      for (auto& oracle : buffer_oracles_) {
        auto complaint = oracle.barrier(barriers.memory.src, barriers.memory.dst, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_UNDEFINED);
        if (!complaint.empty()) return "buffer: " + complaint;
      }
    }
    std::map<std::array<std::uint64_t, 3>, int> seen; // two barriers on one subresource at once are unordered
    for (std::uint32_t i = 0; i < barriers.image_count; ++i) {
      const ImageBarrier& b = plan.images[barriers.first_image + i];
      const TextureState& t = textures_[b.image];
      for (std::uint32_t mip = b.range.base_mip; mip < b.range.base_mip + b.range.mips; ++mip) {
        for (std::uint32_t layer = b.range.base_layer; layer < b.range.base_layer + b.range.layers; ++layer) {
          if (seen[{b.image, mip, layer}]++ != 0) return "two barriers on one subresource in front of one scope";
          auto complaint = texture_oracles_[b.image][mip * t.layers + layer].barrier(b.src, b.dst, b.old_layout, b.new_layout);
          if (!complaint.empty()) return "texture: " + complaint;
        }
      }
    }
    return {};
  }

  std::string use(const ScopeList& list, const Scope& scope) {
    std::map<std::array<std::uint64_t, 3>, std::pair<Use, bool>> uses;
    for (std::uint32_t i = 0; i < scope.texture_count; ++i) {
      const TextureUse& u = list.textures()[scope.first_texture + i];
      for (std::uint32_t mip = u.range.base_mip; mip < u.range.base_mip + u.range.mips; ++mip) {
        for (std::uint32_t layer = u.range.base_layer; layer < u.range.base_layer + u.range.layers; ++layer) {
          auto [at, fresh] = uses.try_emplace({u.texture->native, mip, layer}, u.use, u.discard);
          at->second.first |= u.use;
          at->second.second = at->second.second && u.discard;
        }
      }
    }
    for (const auto& [where, what] : uses) {
      auto& oracle = texture_oracles_[where[0]][where[1] * textures_[where[0]].layers + where[2]];
      auto complaint = oracle.access(what.first, what.second);
      if (!complaint.empty()) return "texture: " + complaint;
    }
    for (std::uint32_t i = 0; i < scope.buffer_count; ++i) {
      const BufferUse& u = list.buffers()[scope.first_buffer + i];
      auto complaint = buffer_oracles_[u.buffer->native - 100].access(u.use, false);
      if (!complaint.empty()) return "buffer: " + complaint;
    }
    return {};
  }

  std::mt19937 random_;
  Feature features_;
  std::uint64_t serial_{};
  std::deque<BufferState> buffers_;
  std::deque<TextureState> textures_;
  std::vector<SubresourceOracle> buffer_oracles_;
  std::vector<std::vector<SubresourceOracle>> texture_oracles_;
};

TEST(BarriersProperty, random_scopes_are_synchronized) {
  for (std::uint32_t seed = 0; seed < 1500; ++seed) {
    World world(seed, seed % 2 == 0);
    for (int step = 0; step < 6; ++step) {
      const std::string complaint = world.step();
      ASSERT_EQ(complaint, "") << "seed " << seed << ", step " << step;
    }
  }
}

} // namespace
} // namespace mote::gpu
