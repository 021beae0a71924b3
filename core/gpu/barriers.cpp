// SPDX-License-Identifier: MIT
#include "core/gpu/barriers.hpp"

#include <optional>

namespace mote::gpu {
namespace {

struct Step {
  StageAccess src{}, dst{};
  VkImageLayout old_layout{}, new_layout{};
  bool operator==(const Step& o) const {
    return src.stages == o.src.stages && src.access == o.src.access && dst.stages == o.dst.stages &&
           dst.access == o.dst.access && old_layout == o.old_layout && new_layout == o.new_layout;
  }
};

// Moves one state to a new use; gives the barrier that must come before it, if any.
// `layout` is UNDEFINED for buffers, which have none.
std::optional<Step> advance(SyncState& state, Use use, VkImageLayout layout, bool discard, Feature features) {
  const auto old_layout = static_cast<VkImageLayout>(state.layout);
  const bool writes = any(use & write_uses);
  const bool moves = old_layout != layout;
  const Use earlier = state.write | state.reads;
  const Use later_reads = moves || writes ? Use::None : state.reads;
  const bool covered = !writes && !moves && (has(state.reads, use) || !any(state.write));
  // A write nobody could have raced with: first use of a buffer.
  const bool first = !any(earlier) && !moves;

  Step step{{stage_access(earlier, features).stages, stage_access(state.write, features).access},
            stage_access(use, features),
            discard ? VK_IMAGE_LAYOUT_UNDEFINED : old_layout,
            layout};
  state.layout = static_cast<std::uint32_t>(layout);
  if (writes) {
    state.write = use;
    state.reads = Use::None;
  } else {
    state.reads = later_reads | use;
    // A transition is a write of its own; what comes next must wait for it also if nothing else wrote.
    if (moves && !any(state.write)) state.write = use;
  }
  if (covered || first) return std::nullopt;
  return step;
}

void plan_buffer(const BufferUse& entry, Feature features, BarrierPlan& plan, MemoryBarrier& memory) {
  if (entry.buffer->host_reads && any(entry.use & write_uses)) plan.host_reads = true;
  const auto step = advance(entry.buffer->sync, entry.use, VK_IMAGE_LAYOUT_UNDEFINED, false, features);
  if (!step) return;
  memory.src.stages |= step->src.stages;
  memory.src.access |= step->src.access;
  memory.dst.stages |= step->dst.stages;
  memory.dst.access |= step->dst.access;
}

void emit(const TextureState& texture, const SubresourceRange& range, const Step& step, BarrierPlan& plan) {
  plan.images.push_back({texture.native, texture.depth, range, step.old_layout, step.new_layout, step.src, step.dst});
}

bool whole_texture(const TextureState& texture, const SubresourceRange& range) {
  return range.base_mip == 0 && range.mips == texture.mips && range.base_layer == 0 && range.layers == texture.layers;
}

// Texture whose subresources differ, or of which only some are used, or used by several entries.
void plan_parts(const TextureUse& first, const std::vector<TextureUse>& all, Feature features, BarrierPlan& plan) {
  TextureState& texture = *first.texture;
  if (texture.parts.empty()) texture.parts.assign(std::size_t{texture.mips} * texture.layers, texture.whole);
  bool equal = true;
  for (std::uint32_t mip = 0; mip < texture.mips; ++mip) {
    std::optional<Step> open; // of the layers [begin, layer) of this mip
    std::uint32_t begin = 0;
    const auto close = [&](std::uint32_t layer) {
      if (open) emit(texture, {mip, 1, begin, layer - begin}, *open, plan);
      open.reset();
    };
    for (std::uint32_t layer = 0; layer < texture.layers; ++layer) {
      SyncState& state = texture.parts[std::size_t{mip} * texture.layers + layer];
      Use use{};
      bool discard = true;
      for (const TextureUse* e = &first;; e = &all[e->next]) {
        if (contains(e->range, mip, layer)) {
          use |= e->use;
          discard = discard && e->discard;
        }
        if (e->next == no_entry) break;
      }
      std::optional<Step> step;
      if (any(use)) step = advance(state, use, layout_of(use, texture.depth), discard, features);
      if (step != open) {
        close(layer);
        open = step;
        begin = layer;
      }
      equal = equal && state == texture.parts.front();
    }
    close(texture.layers);
  }
  if (!equal) return;
  texture.whole = texture.parts.front();
  texture.parts.clear();
}

void plan_texture(const TextureUse& entry, const std::vector<TextureUse>& all, Feature features, BarrierPlan& plan) {
  TextureState& texture = *entry.texture;
  if (entry.next != no_entry || !texture.parts.empty() || !whole_texture(texture, entry.range)) {
    plan_parts(entry, all, features, plan);
    return;
  }
  const auto step = advance(texture.whole, entry.use, layout_of(entry.use, texture.depth), entry.discard, features);
  if (step) emit(texture, entry.range, *step, plan);
}

} // namespace

VkPipelineStageFlags2 shader_stages(Feature features) {
  return VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
         VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
         (has(features, Feature::GeometryShader) ? VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT : VkPipelineStageFlags2{});
}

StageAccess stage_access(Use use, Feature features) {
  StageAccess sum;
  const auto add = [&](Use bit, VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    if (!any(use & bit)) return;
    sum.stages |= stages;
    sum.access |= access;
  };
  const VkPipelineStageFlags2 shaders = shader_stages(features);
  const VkPipelineStageFlags2 depth = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
  add(Use::Index, VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT);
  add(Use::Vertex, VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT);
  add(Use::Uniform, shaders, VK_ACCESS_2_UNIFORM_READ_BIT);
  add(Use::Indirect, VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
  add(Use::CopySrc, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
  add(Use::CopyDst, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
  add(Use::StorageRead, shaders, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
  add(Use::StorageWrite, shaders, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
  add(Use::Sampled, shaders, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
  add(Use::ColorAttachment, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
      VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
  add(Use::DepthRead, depth, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT);
  add(Use::DepthWrite, depth,
      VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
  add(Use::Present, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE);
  return sum;
}

VkImageLayout layout_of(Use use, bool depth) {
  if (any(use & (Use::StorageRead | Use::StorageWrite))) return VK_IMAGE_LAYOUT_GENERAL;
  if (any(use & Use::ColorAttachment)) return VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  if (any(use & Use::DepthWrite)) return VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
  if (any(use & Use::CopySrc)) return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  if (any(use & Use::CopyDst)) return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  if (any(use & Use::Present)) return VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  if (any(use & Use::DepthRead) || depth) return VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
  return VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
}

void BarrierPlan::clear() {
  scopes.clear();
  images.clear();
  host_reads = false;
}

void plan_barriers(const ScopeList& list, Feature features, BarrierPlan& plan) {
  for (const Scope& scope : list.scopes()) {
    ScopeBarriers& barriers = plan.scopes.emplace_back();
    MemoryBarrier memory;
    barriers.first_image = static_cast<std::uint32_t>(plan.images.size());
    for (std::uint32_t i = 0; i < scope.buffer_count; ++i) {
      plan_buffer(list.buffers()[scope.first_buffer + i], features, plan, memory);
    }
    for (std::uint32_t i = 0; i < scope.texture_count; ++i) {
      const TextureUse& entry = list.textures()[scope.first_texture + i];
      if (entry.head) plan_texture(entry, list.textures(), features, plan);
    }
    barriers.memory = memory;
    barriers.image_count = static_cast<std::uint32_t>(plan.images.size()) - barriers.first_image;
  }
}

} // namespace mote::gpu
