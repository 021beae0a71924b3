// SPDX-License-Identifier: MIT
// Queue: submission, waiting, writes from the host. Every submission signals one value of a timeline
// semaphore; what it used is let go when the value has been reached.
#include "core/gpu/vk/handles.hpp"

#include <algorithm>
#include <cstring>

namespace mote::gpu {
namespace {

constexpr std::uint64_t chunk_bytes = 1u << 20;
constexpr std::uint64_t staging_alignment = 16; // suits every texel size

} // namespace

Queue::Impl::Impl(std::shared_ptr<vk::DeviceCore> owner) : core(std::move(owner)) {
  auto type = vk::init<VkSemaphoreTypeCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO);
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  auto info = vk::init<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
  info.pNext = &type;
  vk::check(vkCreateSemaphore(core->device, &info, nullptr, &timeline), "vkCreateSemaphore");
}

Queue::Impl::~Impl() {
  vkDeviceWaitIdle(core->device);
  completed = last;
  for (InFlight& slot : in_flight) retire(slot);
  for (InFlight& slot : idle) vkDestroyCommandPool(core->device, slot.pool, nullptr);
  vkDestroySemaphore(core->device, timeline, nullptr);
}

Recording& Queue::Impl::open_pending() {
  if (!pending) pending = take_recording(*core);
  return *pending;
}

InFlight Queue::Impl::take_slot() {
  InFlight slot;
  if (!idle.empty()) {
    slot = std::move(idle.back());
    idle.pop_back();
    vk::check(vkResetCommandPool(core->device, slot.pool, 0), "vkResetCommandPool");
    return slot;
  }
  auto pool = vk::init<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool.queueFamilyIndex = core->adapter->queue_family;
  vk::check(vkCreateCommandPool(core->device, &pool, nullptr, &slot.pool), "vkCreateCommandPool");
  auto info = vk::init<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  info.commandPool = slot.pool;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  vk::check(vkAllocateCommandBuffers(core->device, &info, &slot.commands), "vkAllocateCommandBuffers");
  return slot;
}

void Queue::Impl::mark_used(const Recording& recording, Submission value) {
  for (const BufferUse& use : recording.scopes.buffers()) use.buffer->last_submission = value;
}

void Queue::Impl::record(InFlight& slot) {
  auto begin = vk::init<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  vk::check(vkBeginCommandBuffer(slot.commands, &begin), "vkBeginCommandBuffer");
  replayer.begin(*core, slot.commands);
  for (const auto& recording : slot.recordings) {
    replayer.replay(*recording);
    mark_used(*recording, slot.value);
  }
  replayer.end();
  vk::check(vkEndCommandBuffer(slot.commands), "vkEndCommandBuffer");
}

Submission Queue::Impl::submit(std::vector<std::unique_ptr<Recording>> recordings, VkSemaphore signal) {
  poll();
  InFlight slot = take_slot();
  slot.value = last + 1;
  if (pending) slot.recordings.push_back(std::move(pending));
  for (auto& recording : recordings) slot.recordings.push_back(std::move(recording));
  slot.chunks = std::move(pending_chunks);
  pending_chunks.clear();
  record(slot);
  std::array<VkSemaphoreSubmitInfo, 2> signals;
  signals.fill(vk::init<VkSemaphoreSubmitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO));
  signals[0].semaphore = timeline;
  signals[0].value = slot.value;
  signals[0].stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  signals[1].semaphore = signal;
  signals[1].stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  auto commands = vk::init<VkCommandBufferSubmitInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO);
  commands.commandBuffer = slot.commands;
  auto info = vk::init<VkSubmitInfo2>(VK_STRUCTURE_TYPE_SUBMIT_INFO_2);
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &commands;
  info.signalSemaphoreInfoCount = signal != VK_NULL_HANDLE ? 2 : 1;
  info.pSignalSemaphoreInfos = signals.data();
  vk::check(vkQueueSubmit2(core->queue, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
  last = slot.value;
  in_flight.push_back(std::move(slot));
  return last;
}

void Queue::Impl::retire(InFlight& slot) {
  for (auto& recording : slot.recordings) give_back(*core, std::move(recording));
  slot.recordings.clear();
  for (StagingChunk& chunk : slot.chunks) {
    chunk.used = 0;
    if (chunk.buffer->size == chunk_bytes) idle_chunks.push_back(std::move(chunk));
  }
  slot.chunks.clear();
  idle.push_back(std::move(slot));
}

void Queue::Impl::poll() {
  if (in_flight.empty()) return;
  vk::check(vkGetSemaphoreCounterValue(core->device, timeline, &completed), "vkGetSemaphoreCounterValue");
  while (!in_flight.empty() && in_flight.front().value <= completed) {
    InFlight slot = std::move(in_flight.front());
    in_flight.pop_front();
    retire(slot);
  }
}

void Queue::Impl::wait(Submission submission) {
  submission = std::min(submission, last);
  if (submission > completed) {
    auto info = vk::init<VkSemaphoreWaitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO);
    info.semaphoreCount = 1;
    info.pSemaphores = &timeline;
    info.pValues = &submission;
    vk::check(vkWaitSemaphores(core->device, &info, ~std::uint64_t{0}), "vkWaitSemaphores");
  }
  poll();
}

bool Queue::Impl::busy(const Buffer::Impl& buffer) const {
  if (pending && buffer.pending == pending->serial) return true;
  return buffer.state.last_submission > completed;
}

// Copies `data` to upload memory that lives until the next submission has finished.
Queue::Impl::Staged Queue::Impl::stage(std::span<const std::byte> data) {
  if (pending_chunks.empty() || pending_chunks.back().used + data.size() > pending_chunks.back().buffer->size) {
    StagingChunk chunk;
    if (data.size() <= chunk_bytes && !idle_chunks.empty()) {
      chunk = std::move(idle_chunks.back());
      idle_chunks.pop_back();
    } else {
      chunk.buffer = std::make_shared<Buffer::Impl>(core, "staging");
      const BufferDescriptor d{.label = "staging", .size = std::max<std::uint64_t>(chunk_bytes, data.size()), .usage = BufferUsage::CopySrc};
      vk::init_buffer(*chunk.buffer, d, vk::MemoryKind::Upload);
    }
    pending_chunks.push_back(std::move(chunk));
  }
  StagingChunk& chunk = pending_chunks.back();
  const Staged place{chunk.buffer.get(), chunk.used};
  std::memcpy(chunk.buffer->mapped + chunk.used, data.data(), data.size());
  chunk.used = std::min(chunk.buffer->size, (chunk.used + data.size() + staging_alignment - 1) / staging_alignment * staging_alignment);
  return place;
}

void Queue::Impl::write(const std::shared_ptr<Buffer::Impl>& buffer, std::uint64_t offset, std::span<const std::byte> data) {
  if (data.empty()) return;
  if (buffer->mapped != nullptr && busy(*buffer)) poll();
  if (buffer->mapped != nullptr && !busy(*buffer)) {
    std::memcpy(buffer->mapped + offset, data.data(), data.size());
    return;
  }
  const Staged place = stage(data);
  Recording& recording = open_pending();
  recording.scopes.begin(core->next_serial());
  use_buffer(recording.scopes, *place.buffer, Use::CopySrc);
  use_buffer(recording.scopes, *buffer, Use::CopyDst);
  recording.commands.push_back(cmd::CopyBuffer{place.buffer->handle, buffer->handle, {place.offset, offset, data.size()}, recording.scopes.end()});
  recording.keep(buffer);
  buffer->pending = recording.serial;
}

void Queue::Impl::write(const std::shared_ptr<Texture::Impl>& texture, const TexelCopyTexture& dst, std::span<const std::byte> data,
                        std::uint32_t row_texels, std::uint32_t image_rows, Extent3d size) {
  const Staged place = stage(data);
  Recording& recording = open_pending();
  const SubresourceRange range = copy_range(texture->facts, dst.mip_level, dst.origin, size);
  const bool volume = texture->facts.dimension == TextureDimension::D3;
  recording.scopes.begin(core->next_serial());
  use_buffer(recording.scopes, *place.buffer, Use::CopySrc);
  use_texture(recording.scopes, *texture, range, Use::CopyDst, false);
  VkBufferImageCopy region{};
  region.bufferOffset = place.offset;
  region.bufferRowLength = row_texels;
  region.bufferImageHeight = image_rows;
  region.imageSubresource = {static_cast<VkImageAspectFlags>(texture->state.depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT),
                             dst.mip_level, range.base_layer, range.layers};
  region.imageOffset = {static_cast<std::int32_t>(dst.origin.x), static_cast<std::int32_t>(dst.origin.y),
                        volume ? static_cast<std::int32_t>(dst.origin.z) : 0};
  region.imageExtent = {size.width, size.height, volume ? size.depth_or_layers : 1};
  recording.commands.push_back(cmd::CopyBufferTexture{place.buffer->handle, texture->handle,
                                                      static_cast<std::uint32_t>(recording.buffer_texture_regions.size()),
                                                      recording.scopes.end(), true});
  recording.buffer_texture_regions.push_back(region);
  recording.keep(texture);
}

void Queue::Impl::fill_new(const std::shared_ptr<Buffer::Impl>& buffer) {
  if (buffer->mapped != nullptr) { // its memory is a multiple of four bytes
    std::fill_n(reinterpret_cast<std::uint32_t*>(buffer->mapped), (buffer->size + 3) / 4, loud_word);
    return;
  }
  Recording& recording = open_pending();
  recording.scopes.begin(core->next_serial());
  use_buffer(recording.scopes, *buffer, Use::CopyDst);
  recording.commands.push_back(cmd::FillBuffer{buffer->handle, 0, VK_WHOLE_SIZE, loud_word, recording.scopes.end()});
  recording.keep(buffer);
  buffer->pending = recording.serial;
}

void Queue::Impl::fill_new(const std::shared_ptr<Texture::Impl>& texture) {
  Recording& recording = open_pending();
  recording.scopes.begin(core->next_serial());
  use_texture(recording.scopes, *texture, {0, texture->state.mips, 0, texture->state.layers}, Use::CopyDst, true);
  recording.commands.push_back(cmd::ClearTexture{texture.get(), recording.scopes.end()});
  recording.keep(texture);
}

// ---- the public handle
namespace {
std::string note(const Queue::Impl& queue, std::string_view call) { return fmt::format("calling {}.queue.{}", named("Device", queue.core->label), call); }
} // namespace

Submission Queue::submit(std::span<const CommandBuffer> commands) {
  Submission value = impl_->last;
  vk::guarded(
      *impl_->core, [&] { return note(*impl_, "submit"); },
      [&] {
        std::vector<std::unique_ptr<Recording>> recordings;
        for (const CommandBuffer& buffer : commands) {
          const auto& found = vk::require(buffer, "CommandBuffer", *impl_->core);
          if (!found->recording) invalid("V-SUB-001", "{} has been submitted already.", named("CommandBuffer", found->label));
        }
        for (std::size_t i = 0; i < commands.size(); ++i) {
          auto& recording = commands[i].impl()->recording;
          if (!recording) {
            invalid("V-SUB-001", "{} is given twice to one submit.", named("CommandBuffer", commands[i].label()));
          }
          recordings.push_back(std::move(recording));
        }
        value = impl_->submit(std::move(recordings));
      });
  return value;
}

void Queue::write_buffer(const Buffer& buffer, std::uint64_t offset, std::span<const std::byte> data) {
  vk::guarded(
      *impl_->core, [&] { return note(*impl_, "write_buffer"); },
      [&] {
        const auto& target = vk::require(buffer, "Buffer", *impl_->core);
        const BufferFacts facts{target->label, target->size, target->usage};
        check_usage("the buffer to write", facts, BufferUsage::CopyDst);
        if (data.empty()) return;
        check_range("the range to write", facts, offset, data.size(), 1);
        impl_->write(target, offset, data);
      });
}

void Queue::write_texture(const TexelCopyTexture& dst, std::span<const std::byte> data, std::uint32_t bytes_per_row,
                          std::uint32_t rows_per_image, Extent3d size) {
  vk::guarded(
      *impl_->core, [&] { return note(*impl_, "write_texture"); },
      [&] {
        const auto& target = vk::require(dst.texture, "Texture", *impl_->core);
        check_usage("the texture to write", target->facts, TextureUsage::CopyDst);
        check_texture_copy("the texture to write", target->facts, dst.mip_level, dst.origin, size);
        const BufferFacts source{"(the data given)", data.size(), BufferUsage::CopySrc};
        const CopyLayout layout = check_buffer_copy("the data", source, 0, bytes_per_row, rows_per_image, target->facts.format, size);
        if (layout.bytes == 0) return;
        impl_->write(target, dst, data.first(layout.bytes), layout.bytes_per_row / format_info(target->facts.format).bytes,
                     layout.rows_per_image, size);
      });
}

void Queue::wait(Submission submission) {
  vk::guarded(*impl_->core, [&] { return note(*impl_, "wait"); }, [&] { impl_->wait(submission); });
}
void Queue::wait_idle() { wait(impl_->last); }

} // namespace mote::gpu
