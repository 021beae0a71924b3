// SPDX-License-Identifier: MIT
#include "tests/gpu/barrier_oracle.hpp"

#include <fmt/format.h>

namespace mote::gpu {
namespace {

constexpr Use all_uses[] = {Use::Index,       Use::Vertex,       Use::Uniform, Use::Indirect,        Use::CopySrc,   Use::CopyDst,
                            Use::StorageRead, Use::StorageWrite, Use::Sampled, Use::ColorAttachment, Use::DepthRead, Use::DepthWrite};

} // namespace

OracleUse oracle_use(Use use, bool geometry) {
  VkPipelineStageFlags2 shaders =
      VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  if (geometry) shaders |= VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT;
  switch (use) {
    case Use::Index: return {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, 0};
    case Use::Vertex: return {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, 0};
    case Use::Uniform: return {shaders, VK_ACCESS_2_UNIFORM_READ_BIT, 0};
    case Use::Indirect: return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0};
    case Use::CopySrc: return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, 0};
    case Use::CopyDst: return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT};
    case Use::StorageRead: return {shaders, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, 0};
    case Use::StorageWrite: return {shaders, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    case Use::Sampled: return {shaders, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0};
    case Use::ColorAttachment:
      return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    case Use::DepthRead:
      return {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
              VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, 0};
    case Use::DepthWrite:
      return {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
              VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
    default: return {};
  }
}

VkImageLayout oracle_layout(Use use, bool depth) {
  switch (use) {
    case Use::CopySrc: return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    case Use::CopyDst: return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    case Use::StorageRead: case Use::StorageWrite: return VK_IMAGE_LAYOUT_GENERAL;
    case Use::ColorAttachment: return VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    case Use::DepthWrite: return VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    case Use::DepthRead: return VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    default: return depth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  }
}

std::string SubresourceOracle::barrier(const StageAccess& src, const StageAccess& dst, VkImageLayout old_layout, VkImageLayout new_layout) {
  const VkPipelineStageFlags2 geometry = VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT;
  if (!geometry_ && ((src.stages | dst.stages) & geometry) != 0) return "the geometry stage is named without the feature";
  const bool transition = image_ && old_layout != new_layout;
  if (image_ && old_layout != VK_IMAGE_LAYOUT_UNDEFINED && old_layout != layout_) return "the old layout is not the present one";
  for (Event& e : events_) {
    const bool covered = (e.stages & ~src.stages) == 0 || (e.happens_before & src.stages) != 0;
    if (transition && !covered) return "a layout change does not wait for an earlier use";
    if (!covered) continue;
    e.happens_before |= dst.stages;
    if (e.writes == 0 && !e.transition) continue;
    if ((e.stages & ~src.stages) == 0 && (e.writes & ~src.access) == 0) e.available = true;
    if (!e.available) continue;
    e.visible_stages |= dst.stages;
    e.visible_access |= dst.access;
  }
  if (transition) {
    if (old_layout == VK_IMAGE_LAYOUT_UNDEFINED && has_contents_) lost_contents_ = true;
    layout_ = new_layout;
    // A write of the barrier itself: available at once, visible to the second scope.
    events_.push_back({dst.stages, VK_ACCESS_2_NONE, dst.stages, true, dst.stages, dst.access, true});
  }
  return {};
}

std::string SubresourceOracle::access(Use uses, bool discard) {
  std::vector<Event> added;
  for (const Use use : all_uses) {
    if (!any(uses & use)) continue;
    const OracleUse now = oracle_use(use, geometry_);
    if (image_ && layout_ != oracle_layout(use, depth_)) return fmt::format("the layout is {} for {}", static_cast<int>(layout_), to_string(use));
    if (lost_contents_ && !discard) return "a layout change threw contents away that are used later";
    for (const Event& before : events_) {
      const bool write_before = before.writes != 0 || before.transition;
      if (!write_before && now.writes == 0) continue;
      if ((now.stages & ~before.happens_before) != 0) return fmt::format("{} does not wait for an earlier use", to_string(use));
      if (!write_before) continue;
      const VkAccessFlags2 wanted = now.reads | now.writes;
      if (!before.available || (now.stages & ~before.visible_stages) != 0 || (wanted & ~before.visible_access) != 0) {
        return fmt::format("an earlier write is not visible to {}", to_string(use));
      }
    }
    added.push_back({now.stages, now.writes, 0, false, 0, 0, false});
    if (now.writes != 0) has_contents_ = true;
  }
  if (discard) lost_contents_ = false;
  for (const Event& e : added) events_.push_back(e);
  return {};
}

} // namespace mote::gpu
