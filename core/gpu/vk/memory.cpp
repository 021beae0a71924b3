// SPDX-License-Identifier: MIT
#include "core/gpu/vk/memory.hpp"

#include <algorithm>
#include <optional>

namespace mote::gpu::vk {
namespace {

constexpr VkMemoryPropertyFlags host_flags = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

// First type with all `flags`, on a heap of at least `least_heap` bytes.
std::optional<std::uint32_t> find_type(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                                       VkMemoryPropertyFlags flags, std::uint64_t least_heap = 0) {
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    const VkMemoryType& type = memory.memoryTypes[i];
    if ((allowed >> i & 1u) == 0 || (type.propertyFlags & flags) != flags) continue;
    if (memory.memoryHeaps[type.heapIndex].size >= least_heap) return i;
  }
  return std::nullopt;
}

std::optional<std::uint32_t> choose_type(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t allowed, MemoryKind kind) {
  std::uint64_t largest = 0; // a host-visible window onto device memory counts only if it covers all of it
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0) largest = std::max(largest, memory.memoryHeaps[i].size);
  }
  std::optional<std::uint32_t> type;
  if (kind == MemoryKind::Buffer) type = find_type(memory, allowed, host_flags | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, largest);
  if (kind == MemoryKind::Readback) type = find_type(memory, allowed, host_flags | VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
  if (!type && (kind == MemoryKind::Readback || kind == MemoryKind::Upload)) type = find_type(memory, allowed, host_flags);
  if (!type && (kind == MemoryKind::Buffer || kind == MemoryKind::Device)) {
    type = find_type(memory, allowed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (!type) type = find_type(memory, allowed, 0);
  }
  return type;
}

void check_budget(const DeviceCore& core, std::uint64_t size, std::string_view what) {
  const MemoryReport& report = core.memory;
  if (report.budget == 0 || (size <= report.budget && report.bytes <= report.budget - size)) return;
  out_of_memory("V-MEM-001", "{} asks for {} bytes; {} holds {} bytes already and its budget is {} bytes.", what, size,
                named("Device", core.label), report.bytes, report.budget);
}

} // namespace

Allocation::Allocation(DeviceCore& core, const VkMemoryRequirements& needs, MemoryKind kind, std::string_view what)
    : core_(&core), size_(needs.size) {
  MemoryReport& report = core.memory;
  check_budget(core, size_, what);
  const auto& memory = core.adapter->memory;
  const auto type = choose_type(memory, needs.memoryTypeBits, kind);
  if (!type) internal_error("V-MEM-003", "The driver offers no memory type for {}.", what);
  auto info = vk::init<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.allocationSize = size_;
  info.memoryTypeIndex = *type;
  const VkResult result = size_ > core.adapter->max_allocation ? VK_ERROR_OUT_OF_DEVICE_MEMORY
                                                               : vkAllocateMemory(core.device, &info, nullptr, &memory_);
  if (result != VK_SUCCESS) {
    memory_ = VK_NULL_HANDLE;
    out_of_memory("V-MEM-002", "{} asks for {} bytes; {} holds {} bytes already and the driver gives no more ({}; at most {} bytes at once).",
                  what, size_, named("Device", core.label), report.bytes, to_string(result), core.adapter->max_allocation);
  }
  if ((memory.memoryTypes[*type].propertyFlags & host_flags) == host_flags && kind != MemoryKind::Device) {
    void* data = nullptr;
    const VkResult mapped = vkMapMemory(core.device, memory_, 0, VK_WHOLE_SIZE, 0, &data);
    if (mapped != VK_SUCCESS) vkFreeMemory(core.device, memory_, nullptr);
    check(mapped, "vkMapMemory");
    mapped_ = static_cast<std::byte*>(data);
  }
  count();
}

void Allocation::count() {
  MemoryReport& report = core_->memory;
  report.bytes += size_;
  report.peak_bytes = std::max(report.peak_bytes, report.bytes);
  ++report.allocations;
}

Allocation::Allocation(DeviceCore& core, const VkMemoryRequirements& needs, std::span<const std::byte> pages, std::string_view what)
    : core_(&core), size_(pages.size()) {
  check_budget(core, size_, what);
  const auto type = choose_type(core.adapter->memory, needs.memoryTypeBits, MemoryKind::Buffer);
  if (!type) internal_error("V-MEM-003", "The driver offers no memory type for {}.", what);
  auto import = vk::init<VkImportMemoryHostPointerInfoEXT>(VK_STRUCTURE_TYPE_IMPORT_MEMORY_HOST_POINTER_INFO_EXT);
  import.handleType = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
  import.pHostPointer = const_cast<std::byte*>(pages.data()); // Vulkan has no pointers to what is only read
  auto info = vk::init<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.pNext = &import;
  info.allocationSize = pages.size();
  info.memoryTypeIndex = *type;
  const VkResult result = vkAllocateMemory(core.device, &info, nullptr, &memory_);
  if (result != VK_SUCCESS) {
    memory_ = VK_NULL_HANDLE;
    out_of_memory("V-MEM-002", "{} is to lie in {} bytes of the caller's memory; the driver refuses ({}).", what, pages.size(), to_string(result));
  }
  count();
}

Allocation& Allocation::operator=(Allocation&& other) noexcept {
  if (this == &other) return *this;
  release();
  core_ = other.core_;
  size_ = other.size_;
  mapped_ = std::exchange(other.mapped_, nullptr);
  memory_ = std::exchange(other.memory_, VK_NULL_HANDLE);
  return *this;
}

void Allocation::release() noexcept {
  if (memory_ == VK_NULL_HANDLE) return;
  vkFreeMemory(core_->device, memory_, nullptr);
  core_->memory.bytes -= size_;
  --core_->memory.allocations;
  memory_ = VK_NULL_HANDLE;
}

} // namespace mote::gpu::vk
