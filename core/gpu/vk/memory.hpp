// SPDX-License-Identifier: MIT
// Device memory: one VkDeviceMemory per resource, counted against the device's budget. Host-visible
// memory is mapped once, for life. Private to core/gpu.
#pragma once

#include "core/gpu/vk/core.hpp"

#include <span>
#include <utility>

namespace mote::gpu::vk {

enum class MemoryKind : std::uint8_t {
  Device,   // textures
  Buffer,   // device memory, host-visible as well where that costs nothing (CPU drivers, integrated GPUs)
  Upload,   // host-visible
  Readback, // host-visible and cached
};

class Allocation {
public:
  Allocation() = default;
  // Faults: V-MEM-001 over budget, V-MEM-002 the driver has no more, V-MEM-003 no fitting memory type.
  Allocation(DeviceCore& core, const VkMemoryRequirements& needs, MemoryKind kind, std::string_view what);
  // Memory of the caller, of a multiple of host_page bytes, for as long as this lives; counts as the device's. Faults: V-MEM-001, 002, 003.
  Allocation(DeviceCore& core, const VkMemoryRequirements& needs, std::span<const std::byte> pages, std::string_view what);
  Allocation(Allocation&& other) noexcept { *this = std::move(other); }
  Allocation& operator=(Allocation&& other) noexcept;
  Allocation(const Allocation&) = delete;
  Allocation& operator=(const Allocation&) = delete;
  ~Allocation() { release(); }

  [[nodiscard]] VkDeviceMemory memory() const { return memory_; }
  [[nodiscard]] std::byte* mapped() const { return mapped_; }

private:
  void count();
  void release() noexcept;
  DeviceCore* core_{}; // outlived by: the owner of the allocation shares the core
  VkDeviceMemory memory_{};
  std::byte* mapped_{};
  std::uint64_t size_{};
};

} // namespace mote::gpu::vk
