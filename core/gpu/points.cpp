// SPDX-License-Identifier: MIT
#include "core/gpu/points.hpp"

#include "core/gpu/gpu.hpp"
#include "core/gpu/vk/handles.hpp"

namespace mote::gpu {

float max_point_size(const Device& device) {
  if (!device) return 0.0f;
  const VkPhysicalDevice physical = device.impl()->core->adapter->physical;
  VkPhysicalDeviceFeatures features{};
  vkGetPhysicalDeviceFeatures(physical, &features);
  if (!features.largePoints) return 1.0f;
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical, &properties);
  return properties.limits.pointSizeRange[1];
}

} // namespace mote::gpu
