// SPDX-License-Identifier: MIT
#include "core/gpu/vk/convert.hpp"
#include "core/gpu/vk/handles.hpp"

#include <algorithm>
#include <bit>

namespace mote::gpu {
namespace {

VkClearColorValue loud_color(TextureFormat format) {
  VkClearColorValue value{};
  switch (format_info(format).kind) {
    case FormatKind::Unorm: value = {{1.0f, 0.0f, 1.0f, 1.0f}}; break; // magenta
    case FormatKind::Float: std::fill(std::begin(value.float32), std::end(value.float32), std::bit_cast<float>(loud_word)); break;
    default: std::fill(std::begin(value.uint32), std::end(value.uint32), loud_word);
  }
  return value;
}
constexpr float loud_depth = 0.7734375f;

} // namespace

void Replayer::begin(vk::DeviceCore& core, VkCommandBuffer commands) {
  core_ = &core;
  commands_ = commands;
  push_stages_ = vk::push_constant_stages(core.facts.features);
  host_reads_ = false;
}

void Replayer::barriers(std::uint32_t scope) {
  const ScopeBarriers& needed = plan_.scopes[scope];
  const bool memory = needed.memory.dst.stages != 0;
  if (!memory && needed.image_count == 0) return;
  const VkMemoryBarrier2 buffers{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, needed.memory.src.stages, needed.memory.src.access,
                                 needed.memory.dst.stages, needed.memory.dst.access};
  images_.clear();
  for (std::uint32_t i = 0; i < needed.image_count; ++i) {
    const ImageBarrier& b = plan_.images[needed.first_image + i];
    VkImageMemoryBarrier2& out = images_.emplace_back();
    out = vk::init<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
    out.srcStageMask = b.src.stages;
    out.srcAccessMask = b.src.access;
    out.dstStageMask = b.dst.stages;
    out.dstAccessMask = b.dst.access;
    out.oldLayout = b.old_layout;
    out.newLayout = b.new_layout;
    out.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    out.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    out.image = reinterpret_cast<VkImage>(b.image);
    out.subresourceRange = {static_cast<VkImageAspectFlags>(b.depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT), b.range.base_mip,
                            b.range.mips, b.range.base_layer, b.range.layers};
  }
  auto info = vk::init<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  info.memoryBarrierCount = memory ? 1 : 0;
  info.pMemoryBarriers = &buffers;
  info.imageMemoryBarrierCount = static_cast<std::uint32_t>(images_.size());
  info.pImageMemoryBarriers = images_.data();
  vkCmdPipelineBarrier2(commands_, &info);
}

// One call per kind of command.
struct Replayer::Visitor {
  Replayer& replayer;
  const Recording& recording;
  VkCommandBuffer out;

  void operator()(const cmd::BeginRender& c) const {
    const RecordedPass& pass = recording.passes[c.pass];
    for (const cmd::BeginStatistics& query : pass.statistics) vkCmdResetQueryPool(out, query.set->handle, query.index, 1);
    replayer.barriers(pass.scope);
    auto info = vk::init<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
    info.renderArea = pass.area;
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<std::uint32_t>(pass.colors.size());
    info.pColorAttachments = pass.colors.data();
    info.pDepthAttachment = pass.has_depth ? &pass.depth : nullptr;
    vkCmdBeginRendering(out, &info);
    const VkViewport viewport{0, 0, static_cast<float>(pass.area.extent.width), static_cast<float>(pass.area.extent.height), 0, 1};
    vkCmdSetViewport(out, 0, 1, &viewport);
    vkCmdSetScissor(out, 0, 1, &pass.area);
    constexpr float no_blend[4]{};
    vkCmdSetBlendConstants(out, no_blend);
  }
  void operator()(const cmd::EndRender&) const { vkCmdEndRendering(out); }

  void operator()(const cmd::Timestamp& c) const {
    vkCmdResetQueryPool(out, c.set->handle, c.index, 1);
    vkCmdWriteTimestamp2(out, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, c.set->handle, c.index);
    c.set->written[c.index] = true;
  }
  void operator()(const cmd::BeginStatistics& c) const { vkCmdBeginQuery(out, c.set->handle, c.index, 0); }
  void operator()(const cmd::EndStatistics& c) const {
    vkCmdEndQuery(out, c.set->handle, c.index);
    c.set->written[c.index] = true;
  }
  void operator()(const cmd::ResolveQueries& c) const {
    const auto begin = c.set->written.begin() + c.first;
    if (std::find(begin, begin + c.count, false) != begin + c.count) {
      replayer.core_->errors.report({ErrorFilter::Validation, "V-QRY-003",
                                     fmt::format("Queries [{}, {}) of {} are resolved, but not all of them were ever written.", c.first,
                                                 c.first + c.count, named("QuerySet", c.set->label)),
                                     {"While replaying CommandEncoder.resolve_query_set in Queue.submit."}});
      return;
    }
    replayer.barriers(c.scope);
    const VkDeviceSize stride = c.set->type == QueryType::Timestamp ? 8 : sizeof(PipelineStatistics);
    vkCmdCopyQueryPoolResults(out, c.set->handle, c.first, c.count, c.dst, c.offset, stride, VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  }

  void operator()(const cmd::SetPipeline& c) const { vkCmdBindPipeline(out, c.point, c.pipeline); }
  void operator()(const cmd::SetGroup& c) const { vkCmdBindDescriptorSets(out, c.point, c.layout, c.index, 1, &c.set, 0, nullptr); }
  void operator()(const cmd::PushConstants& c) const {
    vkCmdPushConstants(out, c.layout, replayer.push_stages_, 0, c.size, recording.bytes.data() + c.first_byte);
  }
  void operator()(const cmd::SetVertexBuffer& c) const { vkCmdBindVertexBuffers(out, c.slot, 1, &c.buffer, &c.offset); }
  void operator()(const cmd::SetIndexBuffer& c) const { vkCmdBindIndexBuffer(out, c.buffer, c.offset, c.type); }
  void operator()(const cmd::SetViewport& c) const { vkCmdSetViewport(out, 0, 1, &c.viewport); }
  void operator()(const cmd::SetScissor& c) const { vkCmdSetScissor(out, 0, 1, &c.rect); }
  void operator()(const cmd::SetBlendConstant& c) const { vkCmdSetBlendConstants(out, c.color); }
  void operator()(const cmd::Draw& c) const { vkCmdDraw(out, c.vertices, c.instances, c.first_vertex, c.first_instance); }
  void operator()(const cmd::DrawIndexed& c) const {
    vkCmdDrawIndexed(out, c.indices, c.instances, c.first_index, c.base_vertex, c.first_instance);
  }
  void operator()(const cmd::DrawIndirect& c) const {
    if (c.indexed) {
      vkCmdDrawIndexedIndirect(out, c.buffer, c.offset, 1, 20);
    } else {
      vkCmdDrawIndirect(out, c.buffer, c.offset, 1, 16);
    }
  }
  void operator()(const cmd::Dispatch& c) const {
    replayer.barriers(c.scope);
    vkCmdDispatch(out, c.x, c.y, c.z);
  }
  void operator()(const cmd::DispatchIndirect& c) const {
    replayer.barriers(c.scope);
    vkCmdDispatchIndirect(out, c.buffer, c.offset);
  }

  void operator()(const cmd::CopyBuffer& c) const {
    replayer.barriers(c.scope);
    vkCmdCopyBuffer(out, c.src, c.dst, 1, &c.region);
  }
  void operator()(const cmd::CopyBufferTexture& c) const {
    replayer.barriers(c.scope);
    const VkBufferImageCopy& region = recording.buffer_texture_regions[c.region];
    if (c.to_texture) {
      vkCmdCopyBufferToImage(out, c.buffer, c.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    } else {
      vkCmdCopyImageToBuffer(out, c.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, c.buffer, 1, &region);
    }
  }
  void operator()(const cmd::CopyTexture& c) const {
    replayer.barriers(c.scope);
    vkCmdCopyImage(out, c.src, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, c.dst, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                   &recording.texture_regions[c.region]);
  }
  void operator()(const cmd::FillBuffer& c) const {
    replayer.barriers(c.scope);
    vkCmdFillBuffer(out, c.buffer, c.offset, c.size, c.value);
  }
  void operator()(const cmd::ClearTexture& c) const {
    replayer.barriers(c.scope);
    const Texture::Impl& t = *c.texture;
    const VkImageAspectFlags aspect = t.state.depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    const VkImageSubresourceRange range{aspect, 0, t.state.mips, 0, t.state.layers};
    if (t.state.depth) {
      const VkClearDepthStencilValue value{loud_depth, 0};
      vkCmdClearDepthStencilImage(out, t.handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &range);
    } else {
      const VkClearColorValue value = loud_color(t.facts.format);
      vkCmdClearColorImage(out, t.handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &range);
    }
  }
  void operator()(const cmd::BeginLabel& c) const {
    if (replayer.core_->begin_label == nullptr) return;
    auto label = vk::init<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
    label.pLabelName = recording.texts[c.text].c_str();
    replayer.core_->begin_label(out, &label);
  }
  void operator()(const cmd::EndLabel&) const {
    if (replayer.core_->end_label != nullptr) replayer.core_->end_label(out);
  }
  void operator()(const cmd::Synchronize& c) const { replayer.barriers(c.scope); }
};

void Replayer::replay(const Recording& recording) {
  plan_.clear();
  plan_barriers(recording.scopes, core_->facts.features, plan_);
  host_reads_ = host_reads_ || plan_.host_reads;
  const Visitor visitor{*this, recording, commands_};
  for (const cmd::Any& command : recording.commands) std::visit(visitor, command);
}

void Replayer::end() {
  if (!host_reads_) return;
  const VkMemoryBarrier2 to_host{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                 VK_ACCESS_2_MEMORY_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
  auto info = vk::init<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &to_host;
  vkCmdPipelineBarrier2(commands_, &info);
}

} // namespace mote::gpu
