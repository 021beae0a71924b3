// SPDX-License-Identifier: MIT
#include "core/gpu/vk/convert.hpp"
#include "core/gpu/vk/core.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

namespace mote::gpu::vk {
namespace {

// Everything asked of a physical device, once.
struct Properties {
  VkPhysicalDeviceProperties2 base = vk::init<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
  VkPhysicalDeviceVulkan11Properties v11 = vk::init<VkPhysicalDeviceVulkan11Properties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES);
  VkPhysicalDeviceVulkan12Properties v12 = vk::init<VkPhysicalDeviceVulkan12Properties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES);
  VkPhysicalDeviceVulkan13Properties v13 = vk::init<VkPhysicalDeviceVulkan13Properties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES);
  explicit Properties(VkPhysicalDevice device) {
    base.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &v13;
    vkGetPhysicalDeviceProperties2(device, &base);
  }
};
struct Features {
  VkPhysicalDeviceFeatures2 base = vk::init<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  VkPhysicalDeviceVulkan12Features v12 = vk::init<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  VkPhysicalDeviceVulkan13Features v13 = vk::init<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  explicit Features(VkPhysicalDevice device) {
    base.pNext = &v12;
    v12.pNext = &v13;
    vkGetPhysicalDeviceFeatures2(device, &base);
  }
};

DeviceType device_type(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return DeviceType::IntegratedGpu;
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return DeviceType::DiscreteGpu;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return DeviceType::VirtualGpu;
    case VK_PHYSICAL_DEVICE_TYPE_CPU: return DeviceType::Cpu;
    default: return DeviceType::Other;
  }
}

AdapterInfo read_info(const Properties& p) {
  const VkPhysicalDeviceProperties& base = p.base.properties;
  AdapterInfo info;
  info.name = base.deviceName;
  info.driver = p.v12.driverName;
  info.driver_info = p.v12.driverInfo;
  info.type = device_type(base.deviceType);
  for (const std::uint8_t byte : p.v11.deviceUUID) info.device_uuid += fmt::format("{:02x}", byte);
  info.api_version = base.apiVersion;
  info.driver_version = base.driverVersion;
  return info;
}

Limits read_limits(const Properties& p) {
  const VkPhysicalDeviceLimits& v = p.base.properties.limits;
  Limits limits;
  limits.max_texture_dimension_1d = v.maxImageDimension1D;
  limits.max_texture_dimension_2d = std::min(v.maxImageDimension2D, v.maxFramebufferWidth);
  limits.max_texture_dimension_3d = v.maxImageDimension3D;
  limits.max_texture_array_layers = v.maxImageArrayLayers;
  limits.max_bind_groups = v.maxBoundDescriptorSets;
  limits.max_uniform_buffer_binding_size = v.maxUniformBufferRange;
  limits.max_storage_buffer_binding_size = v.maxStorageBufferRange;
  limits.max_buffer_size = std::min(p.v13.maxBufferSize, p.v11.maxMemoryAllocationSize);
  limits.min_uniform_buffer_offset_alignment = static_cast<std::uint32_t>(v.minUniformBufferOffsetAlignment);
  limits.min_storage_buffer_offset_alignment = static_cast<std::uint32_t>(v.minStorageBufferOffsetAlignment);
  limits.max_push_constant_size = v.maxPushConstantsSize;
  limits.max_color_attachments = v.maxColorAttachments;
  limits.max_compute_workgroup_size_x = v.maxComputeWorkGroupSize[0];
  limits.max_compute_workgroup_size_y = v.maxComputeWorkGroupSize[1];
  limits.max_compute_workgroup_size_z = v.maxComputeWorkGroupSize[2];
  limits.max_compute_invocations_per_workgroup = v.maxComputeWorkGroupInvocations;
  limits.max_compute_workgroups_per_dimension =
      std::min({v.maxComputeWorkGroupCount[0], v.maxComputeWorkGroupCount[1], v.maxComputeWorkGroupCount[2]});
  limits.max_compute_shared_memory_size = v.maxComputeSharedMemorySize;
  limits.max_geometry_output_vertices = v.maxGeometryOutputVertices;
  limits.max_geometry_total_output_components = v.maxGeometryTotalOutputComponents;
  limits.subgroup_size = p.v11.subgroupSize;
  limits.min_subgroup_size = p.v13.minSubgroupSize;
  limits.timestamp_period_ns = v.timestampPeriod;
  return limits;
}

Feature read_features(const Properties& p, const Features& f, std::uint32_t timestamp_bits) {
  const VkPhysicalDeviceFeatures& v = f.base.features;
  constexpr VkSubgroupFeatureFlags subgroup =
      VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_VOTE_BIT | VK_SUBGROUP_FEATURE_SHUFFLE_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT | VK_SUBGROUP_FEATURE_ARITHMETIC_BIT;
  Feature features{};
  const auto add = [&](bool offered, Feature feature) { features |= offered ? feature : Feature::None; };
  add(v.geometryShader != 0, Feature::GeometryShader);
  add(timestamp_bits == 64, Feature::TimestampQuery);
  add(v.pipelineStatisticsQuery != 0, Feature::PipelineStatistics);
  add(v.shaderFloat64 != 0, Feature::ShaderFloat64);
  add(v.shaderInt64 != 0, Feature::ShaderInt64);
  add(v.shaderInt64 != 0 && f.v12.shaderBufferInt64Atomics != 0, Feature::Int64Atomics);
  add((p.v11.subgroupSupportedOperations & subgroup) == subgroup &&
          (p.v11.subgroupSupportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0,
      Feature::Subgroups);
  add(v.depthClamp != 0, Feature::DepthClamp);
  return features;
}

// The caller's memory as it is: only where the device is the processor, and its pages are no larger than ours.
bool takes_host_memory(VkPhysicalDevice device, const AdapterInfo& info) {
  if (info.type != DeviceType::Cpu) return false;
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
  if (std::none_of(extensions.begin(), extensions.end(), [](const auto& e) { return std::string_view(e.extensionName) == VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME; }))
    return false;
  auto host = vk::init<VkPhysicalDeviceExternalMemoryHostPropertiesEXT>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_MEMORY_HOST_PROPERTIES_EXT);
  auto properties = vk::init<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
  properties.pNext = &host;
  vkGetPhysicalDeviceProperties2(device, &properties);
  return host.minImportedHostPointerAlignment <= host_page;
}

FormatTable read_formats(VkPhysicalDevice device) {
  FormatTable table{};
  for (std::size_t i = 1; i < format_count; ++i) {
    const auto texture_format = static_cast<TextureFormat>(i);
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(device, format(texture_format), &properties);
    const auto can = [&](VkFormatFeatureFlags bit) { return (properties.optimalTilingFeatures & bit) != 0; };
    const bool depth = format_info(texture_format).kind == FormatKind::Depth;
    FormatCaps& caps = table[i];
    caps.sampled = can(VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT);
    caps.filterable = can(VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT);
    caps.storage = can(VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT);
    caps.renderable = can(depth ? VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT);
    caps.blendable = can(VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT);
    if (!caps.renderable) continue;
    VkImageFormatProperties image{};
    const VkImageUsageFlags usage = depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    const VkResult result = vkGetPhysicalDeviceImageFormatProperties(device, format(texture_format), VK_IMAGE_TYPE_2D,
                                                                     VK_IMAGE_TILING_OPTIMAL, usage, 0, &image);
    caps.multisample = result == VK_SUCCESS && (image.sampleCounts & VK_SAMPLE_COUNT_4_BIT) != 0;
  }
  return table;
}

struct QueueChoice {
  std::uint32_t family{}, timestamp_bits{};
};
std::optional<QueueChoice> choose_queue(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (std::uint32_t i = 0; i < count; ++i) {
    if ((families[i].queueFlags & needed) == needed) return QueueChoice{i, families[i].timestampValidBits};
  }
  return std::nullopt;
}

std::shared_ptr<AdapterCore> read_adapter(const std::shared_ptr<InstanceCore>& instance, VkPhysicalDevice device) {
  auto core = std::make_shared<AdapterCore>();
  core->instance = instance;
  core->physical = device;
  VkPhysicalDeviceProperties base{};
  vkGetPhysicalDeviceProperties(device, &base);
  if (base.apiVersion < VK_API_VERSION_1_3) {
    core->info.name = base.deviceName;
    core->info.type = device_type(base.deviceType);
    core->unsuitable = fmt::format("offers Vulkan {}.{}, mote needs 1.3", VK_API_VERSION_MAJOR(base.apiVersion),
                                   VK_API_VERSION_MINOR(base.apiVersion));
    return core;
  }
  const Properties properties(device);
  const Features features(device);
  core->info = read_info(properties);
  core->facts.label = core->info.name;
  core->facts.limits = read_limits(properties);
  core->facts.formats = read_formats(device);
  vkGetPhysicalDeviceMemoryProperties(device, &core->memory);
  core->max_allocation = properties.v11.maxMemoryAllocationSize;
  const auto queue = choose_queue(device);
  core->facts.features = read_features(properties, features, queue ? queue->timestamp_bits : 0);
  if (takes_host_memory(device, core->info)) core->facts.features |= Feature::HostMemory;
  core->queue_family = queue ? queue->family : 0;
  if (!queue) core->unsuitable = "has no queue for both drawing and computing";
  return core;
}

} // namespace

std::vector<std::shared_ptr<AdapterCore>> enumerate_adapters(const std::shared_ptr<InstanceCore>& instance) {
  std::uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance->instance, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  vkEnumeratePhysicalDevices(instance->instance, &count, devices.data());
  std::vector<std::shared_ptr<AdapterCore>> adapters;
  for (VkPhysicalDevice device : devices) adapters.push_back(read_adapter(instance, device));
  return adapters;
}

} // namespace mote::gpu::vk
