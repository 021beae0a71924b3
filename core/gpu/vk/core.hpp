// SPDX-License-Identifier: MIT
// The three owners every object leans on: InstanceCore (VkInstance, layer messages), AdapterCore (a
// physical device with everything asked of it once) and DeviceCore (VkDevice, memory accounting,
// error sink). Objects share ownership of DeviceCore; DeviceCore never owns objects, so there is no cycle.
// Private to core/gpu.
#pragma once

#include "core/gpu/error.hpp"
#include "core/gpu/format.hpp"
#include "core/gpu/gpu.hpp"
#include "core/gpu/validation.hpp"

#include <vulkan/vulkan.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace mote::gpu {
struct Recording;
}

namespace mote::gpu::vk {

// A zeroed Vulkan structure with its type set.
template <class T> T init(VkStructureType type) {
  T value{};
  value.sType = type;
  return value;
}

struct InstanceCore {
  VkInstance instance{};
  VkDebugUtilsMessengerEXT messenger{};
  bool debug_utils{};
  bool surface{};
  std::mutex mutex{};
  std::vector<std::string> messages{}; // of the validation layer

  InstanceCore() = default;
  InstanceCore(const InstanceCore&) = delete;
  InstanceCore& operator=(const InstanceCore&) = delete;
  ~InstanceCore();
};
// Null and `error` set on failure.
std::shared_ptr<InstanceCore> create_instance(const InstanceDescriptor& descriptor, Error& error);

struct AdapterCore {
  std::shared_ptr<InstanceCore> instance{};
  VkPhysicalDevice physical{};
  AdapterInfo info{};
  DeviceFacts facts{}; // features: all that are offered
  VkPhysicalDeviceMemoryProperties memory{};
  std::uint64_t max_allocation{};
  std::uint32_t queue_family{};
  std::string unsuitable{}; // why it cannot be used; empty: it can
};
std::vector<std::shared_ptr<AdapterCore>> enumerate_adapters(const std::shared_ptr<InstanceCore>& instance);

struct DeviceCore {
  std::shared_ptr<AdapterCore> adapter{};
  std::string label{};
  VkDevice device{};
  VkQueue queue{};
  DeviceFacts facts{}; // features: those asked for
  ErrorSink errors{};
  MemoryReport memory{};
  bool fill_new_memory{};
  VkPipelineCache pipeline_cache{};
  std::string pipeline_cache_file{};
  std::uint64_t serial{}; // source of scope and recording serials
  std::vector<std::unique_ptr<Recording>> recordings{}; // emptied ones, kept for their capacity
  PFN_vkSetDebugUtilsObjectNameEXT set_name{};
  PFN_vkCmdBeginDebugUtilsLabelEXT begin_label{};
  PFN_vkCmdEndDebugUtilsLabelEXT end_label{};

  DeviceCore();
  DeviceCore(const DeviceCore&) = delete;
  DeviceCore& operator=(const DeviceCore&) = delete;
  ~DeviceCore();

  std::uint64_t next_serial() { return ++serial; }
  template <class Handle> void name(VkObjectType type, Handle handle, const std::string& text) const {
    if (set_name != nullptr && !text.empty()) name_object(type, reinterpret_cast<std::uint64_t>(handle), text);
  }

private:
  void name_object(VkObjectType type, std::uint64_t handle, const std::string& text) const;
};

// Throws a Fault unless the result is a success: V-MEM-002 for memory, V-INT-001 for the rest.
void check(VkResult result, std::string_view call);
std::string_view to_string(VkResult result);

} // namespace mote::gpu::vk
