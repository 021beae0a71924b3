// SPDX-License-Identifier: MIT
// Device: creation from an adapter, error scopes, memory report, blocking reads.
#include "core/gpu/format.hpp"
#include "core/gpu/vk/handles.hpp"
#include "core/gpu/vk/pipeline_cache.hpp"

#include <cstring>

namespace mote::gpu {
namespace vk {

DeviceCore::DeviceCore() = default;
DeviceCore::~DeviceCore() {
  recordings.clear();
  if (device == VK_NULL_HANDLE) return;
  vkDestroyPipelineCache(device, pipeline_cache, nullptr);
  vkDestroyDevice(device, nullptr);
}

void DeviceCore::name_object(VkObjectType type, std::uint64_t handle, const std::string& text) const {
  VkDebugUtilsObjectNameInfoEXT info = vk::init<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
  info.objectType = type;
  info.objectHandle = handle;
  info.pObjectName = text.c_str();
  set_name(device, &info);
}

namespace {

// Vulkan features of a device: those mote always takes when they are there, and those asked for.
struct EnabledFeatures {
  VkPhysicalDeviceFeatures2 base = vk::init<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  VkPhysicalDeviceVulkan11Features v11 = vk::init<VkPhysicalDeviceVulkan11Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES);
  VkPhysicalDeviceVulkan12Features v12 = vk::init<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  VkPhysicalDeviceVulkan13Features v13 = vk::init<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);

  EnabledFeatures(VkPhysicalDevice device, Feature asked) {
    EnabledFeatures offered;
    vkGetPhysicalDeviceFeatures2(device, &offered.base);
    const VkPhysicalDeviceFeatures& can = offered.base.features;
    VkPhysicalDeviceFeatures& on = base.features;
    on.robustBufferAccess = can.robustBufferAccess;
    on.independentBlend = can.independentBlend;
    on.samplerAnisotropy = can.samplerAnisotropy;
    on.fullDrawIndexUint32 = can.fullDrawIndexUint32;
    on.drawIndirectFirstInstance = can.drawIndirectFirstInstance;
    on.vertexPipelineStoresAndAtomics = can.vertexPipelineStoresAndAtomics;
    on.fragmentStoresAndAtomics = can.fragmentStoresAndAtomics;
    on.largePoints = can.largePoints;
    on.shaderStorageImageExtendedFormats = can.shaderStorageImageExtendedFormats;
    on.shaderStorageImageWriteWithoutFormat = can.shaderStorageImageWriteWithoutFormat;
    on.sampleRateShading = can.sampleRateShading;
    on.geometryShader = has(asked, Feature::GeometryShader);
    on.shaderTessellationAndGeometryPointSize = on.geometryShader & can.shaderTessellationAndGeometryPointSize;
    on.pipelineStatisticsQuery = has(asked, Feature::PipelineStatistics);
    on.shaderFloat64 = has(asked, Feature::ShaderFloat64);
    on.shaderInt64 = any(asked & (Feature::ShaderInt64 | Feature::Int64Atomics));
    on.depthClamp = has(asked, Feature::DepthClamp);
    v11.shaderDrawParameters = offered.v11.shaderDrawParameters;
    v12.shaderBufferInt64Atomics = has(asked, Feature::Int64Atomics);
    v12.scalarBlockLayout = offered.v12.scalarBlockLayout;
    v12.uniformBufferStandardLayout = offered.v12.uniformBufferStandardLayout;
    v12.shaderSubgroupExtendedTypes = offered.v12.shaderSubgroupExtendedTypes;
    v12.hostQueryReset = VK_TRUE;
    v12.timelineSemaphore = VK_TRUE;
    v13.synchronization2 = VK_TRUE;
    v13.dynamicRendering = VK_TRUE;
    v13.maintenance4 = VK_TRUE;
  }

private:
  EnabledFeatures() { link(); }

public:
  void link() {
    base.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &v13;
  }
};

void create_device(DeviceCore& core, Feature asked) {
  EnabledFeatures features(core.adapter->physical, asked);
  features.link();
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue = vk::init<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = core.adapter->queue_family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  std::vector<const char*> extensions;
  if (core.adapter->instance->surface) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  if (has(asked, Feature::HostMemory)) extensions.push_back(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
  VkDeviceCreateInfo info = vk::init<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.pNext = &features.base;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  const VkResult result = vkCreateDevice(core.adapter->physical, &info, nullptr, &core.device);
  if (result != VK_SUCCESS) core.device = VK_NULL_HANDLE;
  check(result, "vkCreateDevice");
  vkGetDeviceQueue(core.device, core.adapter->queue_family, 0, &core.queue);
  if (!core.adapter->instance->debug_utils) return;
  const auto load = [&](const char* name) { return vkGetDeviceProcAddr(core.device, name); };
  core.set_name = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(load("vkSetDebugUtilsObjectNameEXT"));
  core.begin_label = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(load("vkCmdBeginDebugUtilsLabelEXT"));
  core.end_label = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(load("vkCmdEndDebugUtilsLabelEXT"));
}

} // namespace
} // namespace vk

Device Adapter::request_device(const DeviceDescriptor& descriptor, Error& error) const {
  if (!impl_ && !error.code.empty()) return {}; // `error` says already why there is no adapter
  auto core = std::make_shared<vk::DeviceCore>();
  auto impl = std::make_shared<Device::Impl>();
  try {
    if (!impl_) invalid("V-OBJ-001", "[Adapter] was never made: it is an empty handle.");
    const Feature missing = static_cast<Feature>(static_cast<std::uint32_t>(descriptor.required_features) &
                                                 ~static_cast<std::uint32_t>(impl_->core->facts.features));
    if (any(missing)) {
      invalid("V-FEAT-002", "{} asks for Feature {}, which {} does not offer; it offers {}.",
              named("DeviceDescriptor", descriptor.label), to_string(missing), named("Adapter", label()), to_string(features()));
    }
    core->adapter = impl_->core;
    core->label = descriptor.label;
    core->facts = impl_->core->facts;
    core->facts.label = descriptor.label;
    core->facts.features = descriptor.required_features;
    core->memory.budget = descriptor.memory_budget;
    core->fill_new_memory = descriptor.fill_new_memory;
    vk::create_device(*core, descriptor.required_features);
    vk::load_pipeline_cache(*core, descriptor.cache_directory);
    impl->label = descriptor.label;
    impl->core = core;
    impl->queue = std::make_shared<Queue::Impl>(core);
  } catch (Fault& fault) {
    error = std::move(fault.error());
    error.context.push_back(fmt::format("While calling {}.request_device({}).", named("Adapter", label()),
                                        named("DeviceDescriptor", descriptor.label)));
    return {};
  }
  return Device(std::move(impl));
}

Queue Device::queue() const { return impl_ ? Queue(impl_->queue) : Queue(); }
Feature Device::features() const { return impl_ ? impl_->core->facts.features : Feature::None; }
const Limits& Device::limits() const {
  static const Limits none{};
  return impl_ ? impl_->core->facts.limits : none;
}
MemoryReport Device::memory() const { return impl_ ? impl_->core->memory : MemoryReport{}; }

void Device::push_error_scope(ErrorFilter filter) { impl_->core->errors.push(filter); }
std::optional<Error> Device::pop_error_scope() {
  std::optional<Error> error;
  vk::guarded(
      *impl_->core, [&] { return fmt::format("calling {}.pop_error_scope()", named("Device", label())); },
      [&] { error = impl_->core->errors.pop(); });
  return error;
}
void Device::on_uncaptured_error(std::function<void(const Error&)> handler) {
  impl_->core->errors.set_handler(std::move(handler));
}
void Device::save_pipeline_cache() { vk::save_pipeline_cache(*impl_->core); }

std::vector<std::byte> Device::read_buffer(const Buffer& buffer, std::uint64_t offset, std::uint64_t size) {
  std::vector<std::byte> bytes;
  vk::guarded(
      *impl_->core, [&] { return fmt::format("calling {}.read_buffer({})", named("Device", label()), named("Buffer", buffer.label())); },
      [&] {
        const auto& source = vk::require(buffer, "Buffer", *impl_->core);
        const std::uint64_t count = check_range("the range to read", {source->label, source->size, source->usage}, offset, size, 4);
        if (count == 0) return;
        Buffer staging = create_buffer({.label = "read_buffer", .size = count, .usage = BufferUsage::MapRead | BufferUsage::CopyDst});
        CommandEncoder encoder = create_command_encoder("read_buffer");
        encoder.copy_buffer_to_buffer(buffer, offset, staging, 0, count);
        const CommandBuffer commands = encoder.finish();
        if (!commands || !staging) secondary_fault();
        queue().wait(queue().submit(commands));
        bytes.assign(staging.mapped().begin(), staging.mapped().end());
      });
  return bytes;
}

std::vector<std::byte> Device::read_texture(const Texture& texture, std::uint32_t mip_level) {
  std::vector<std::byte> bytes;
  vk::guarded(
      *impl_->core, [&] { return fmt::format("calling {}.read_texture({})", named("Device", label()), named("Texture", texture.label())); },
      [&] {
        const auto& source = vk::require(texture, "Texture", *impl_->core);
        const TextureFacts& facts = source->facts;
        if (mip_level >= facts.mips) {
          invalid("V-COPY-004", "Mip level {} is read; {} has {}.", mip_level, named("Texture", facts.label), facts.mips);
        }
        const Extent3d size = mip_extent(facts.size, facts.dimension, mip_level);
        const std::uint64_t count =
            std::uint64_t{size.width} * size.height * size.depth_or_layers * format_info(facts.format).bytes;
        Buffer staging = create_buffer({.label = "read_texture", .size = count, .usage = BufferUsage::MapRead | BufferUsage::CopyDst});
        CommandEncoder encoder = create_command_encoder("read_texture");
        encoder.copy_texture_to_buffer({.texture = &texture, .mip_level = mip_level}, {.buffer = &staging}, size);
        const CommandBuffer commands = encoder.finish();
        if (!commands || !staging) secondary_fault();
        queue().wait(queue().submit(commands));
        bytes.assign(staging.mapped().begin(), staging.mapped().end());
      });
  return bytes;
}

} // namespace mote::gpu
