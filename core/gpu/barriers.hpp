// SPDX-License-Identifier: MIT
// Plans the barriers between scopes: a pure function of the scopes, in submission order, and of the
// states their resources were left in. submit calls it once per recording and then emits what it says.
//
// Rule: a read that is already synchronized with the last write, in the same layout, needs nothing;
// everything else needs a barrier, also write after write on the same attachment (dynamic
// rendering orders nothing between two passes). Shader uses always name every shader stage the device
// has enabled, so a second shader read never needs a second barrier; the geometry bit is legal only
// with Feature::GeometryShader and appears only then.
//
// Neither lavapipe nor the validation layer of Debian 12 notices a missing barrier between render
// passes: tests/gpu checks this function against an independent oracle instead.
#pragma once

#include "core/gpu/usage.hpp"

#include <vulkan/vulkan_core.h>

#include <vector>

namespace mote::gpu {

struct StageAccess {
  VkPipelineStageFlags2 stages{};
  VkAccessFlags2 access{};
};
// Every shader stage a pipeline of this device may have.
VkPipelineStageFlags2 shader_stages(Feature features);
// Stages and accesses of a set of uses, reads and writes.
StageAccess stage_access(Use use, Feature features);
// The layout in which all of these (compatible) uses happen.
VkImageLayout layout_of(Use use, bool depth);

struct MemoryBarrier { // covers the buffers of a scope together; no stages: nothing to do
  StageAccess src{}, dst{};
};
struct ImageBarrier {
  std::uint64_t image{}; // TextureState::native
  bool depth{};
  SubresourceRange range{};
  VkImageLayout old_layout{}, new_layout{};
  StageAccess src{}, dst{};
};
struct ScopeBarriers {
  MemoryBarrier memory{};
  std::uint32_t first_image{}, image_count{};
};
struct BarrierPlan {
  std::vector<ScopeBarriers> scopes{}; // one per scope, to be emitted before it
  std::vector<ImageBarrier> images{};
  bool host_reads{};                   // some scope writes a buffer the host will read
  void clear();
};

// Appends to `plan` and moves the states of the resources behind the last scope.
void plan_barriers(const ScopeList& list, Feature features, BarrierPlan& plan);

} // namespace mote::gpu
