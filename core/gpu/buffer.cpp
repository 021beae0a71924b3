// SPDX-License-Identifier: MIT
#include "core/gpu/vk/convert.hpp"
#include "core/gpu/vk/handles.hpp"

#include <cstring>

namespace mote::gpu {
namespace vk {

namespace {
bool lies_in_host_memory(const DeviceCore& core, const BufferDescriptor& d) {
  return d.contents_owner && has(core.facts.features, Feature::HostMemory) && d.contents.size() == d.size &&
         reinterpret_cast<std::uintptr_t>(d.contents.data()) % host_page == 0;
}
} // namespace

// Vulkan buffer and memory; the descriptor is valid already.
void init_buffer(Buffer::Impl& buffer, const BufferDescriptor& descriptor, MemoryKind kind) {
  DeviceCore& core = *buffer.core;
  buffer.size = descriptor.size;
  buffer.usage = descriptor.usage;
  auto info = vk::init<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = (descriptor.size + 3) / 4 * 4; // fills and clears work in words
  info.usage = buffer_usage(descriptor.usage);
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  const bool in_host = lies_in_host_memory(core, descriptor);
  auto external = vk::init<VkExternalMemoryBufferCreateInfo>(VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO);
  external.handleTypes = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
  if (in_host) info.pNext = &external;
  check(vkCreateBuffer(core.device, &info, nullptr, &buffer.handle), "vkCreateBuffer");
  core.name(VK_OBJECT_TYPE_BUFFER, buffer.handle, buffer.label);
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(core.device, buffer.handle, &needs);
  if (in_host) {
    buffer.host = descriptor.contents_owner;
    buffer.memory = Allocation(core, needs, {descriptor.contents.data(), (descriptor.size + host_page - 1) / host_page * host_page}, named("Buffer", buffer.label));
  } else {
    buffer.memory = Allocation(core, needs, kind, named("Buffer", buffer.label));
  }
  check(vkBindBufferMemory(core.device, buffer.handle, buffer.memory.memory(), 0), "vkBindBufferMemory");
  buffer.mapped = in_host ? nullptr : buffer.memory.mapped();
  buffer.state.native = reinterpret_cast<std::uint64_t>(buffer.handle);
  buffer.state.label = buffer.label;
  buffer.state.host_reads = any(descriptor.usage & BufferUsage::MapRead);
}

} // namespace vk

Buffer Device::create_buffer(const BufferDescriptor& descriptor) {
  return vk::make<Buffer>(impl_->core, "create_buffer", "Buffer", descriptor.label, [&](Buffer::Impl& buffer) {
    check_buffer(impl_->core->facts, descriptor);
    const bool reads = any(descriptor.usage & BufferUsage::MapRead);
    const bool writes = any(descriptor.usage & BufferUsage::MapWrite);
    vk::init_buffer(buffer, descriptor, reads ? vk::MemoryKind::Readback : writes ? vk::MemoryKind::Upload : vk::MemoryKind::Buffer);
    const auto shared = std::static_pointer_cast<Buffer::Impl>(buffer.shared_from_this());
    if (shared->host) return; // holds its contents already
    if (impl_->core->fill_new_memory && descriptor.contents.size() < descriptor.size) impl_->queue->fill_new(shared);
    if (!descriptor.contents.empty()) impl_->queue->write(shared, 0, descriptor.contents);
  });
}

std::uint64_t Buffer::size() const { return impl_ ? impl_->size : 0; }
BufferUsage Buffer::usage() const { return impl_ ? impl_->usage : BufferUsage::None; }
std::span<std::byte> Buffer::mapped() const {
  if (!impl_ || !impl_->valid || !any(impl_->usage & (BufferUsage::MapRead | BufferUsage::MapWrite))) return {};
  return {impl_->mapped, impl_->size};
}

} // namespace mote::gpu
