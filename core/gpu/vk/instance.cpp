// SPDX-License-Identifier: MIT
#include "core/gpu/vk/core.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

namespace mote::gpu::vk {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT types,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  // Notes of the loader about other drivers on the machine are not about this program.
  if ((types & (VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT)) == 0) {
    return VK_FALSE;
  }
  auto& core = *static_cast<InstanceCore*>(user);
  const std::lock_guard lock(core.mutex);
  core.messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

bool validation_asked(const InstanceDescriptor& descriptor) {
  const char* variable = std::getenv("MOTE_VALIDATION");
  return descriptor.validation || (variable != nullptr && std::strcmp(variable, "1") == 0);
}

bool layer_installed() {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(),
                     [](const auto& layer) { return std::strcmp(layer.layerName, validation_layer) == 0; });
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(InstanceCore& core) {
  VkDebugUtilsMessengerCreateInfoEXT info = vk::init<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT |
                     VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT;
  info.pfnUserCallback = on_message;
  info.pUserData = &core;
  return info;
}

Error failure(VkResult result) {
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    return {ErrorFilter::Internal, "V-INST-001",
            "No Vulkan driver is found. Debian's package mesa-vulkan-drivers has one that runs on any CPU.", {}};
  }
  return {ErrorFilter::Internal, "V-INST-003", fmt::format("vkCreateInstance failed: {}.", to_string(result)), {}};
}

// The validation layer with its synchronization checks, and the messenger its words come through.
struct ValidationChain {
  std::array<VkValidationFeatureEnableEXT, 1> enables{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT features = vk::init<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
  VkDebugUtilsMessengerCreateInfoEXT messenger{};

  const void* link(InstanceCore& core) {
    messenger = messenger_info(core);
    features.enabledValidationFeatureCount = static_cast<std::uint32_t>(enables.size());
    features.pEnabledValidationFeatures = enables.data();
    features.pNext = &messenger;
    return &features;
  }
};

void make_messenger(InstanceCore& core) {
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(core.instance, "vkCreateDebugUtilsMessengerEXT"));
  const auto info = messenger_info(core);
  if (create != nullptr) create(core.instance, &info, nullptr, &core.messenger);
}

} // namespace

InstanceCore::~InstanceCore() {
  if (messenger != VK_NULL_HANDLE) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
    if (destroy != nullptr) destroy(instance, messenger, nullptr);
  }
  if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, nullptr);
}

std::shared_ptr<InstanceCore> create_instance(const InstanceDescriptor& descriptor, Error& error) {
  auto core = std::make_shared<InstanceCore>();
  const bool validate = validation_asked(descriptor);
  if (validate && !layer_installed()) {
    error = {ErrorFilter::Validation, "V-INST-002",
             "Validation is asked for (InstanceDescriptor.validation or MOTE_VALIDATION=1), but the layer "
             "VK_LAYER_KHRONOS_validation is not installed. Debian's package vulkan-validationlayers has it.",
             {}};
    return nullptr;
  }
  const std::string application(descriptor.application);
  VkApplicationInfo app = vk::init<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  app.pApplicationName = application.c_str();
  app.pEngineName = "mote";
  app.apiVersion = VK_API_VERSION_1_3;
  std::vector<const char*> extensions;
  if (descriptor.surface) extensions.assign(descriptor.surface_extensions.begin(), descriptor.surface_extensions.end());
  if (validate) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  VkInstanceCreateInfo info = vk::init<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &app;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  ValidationChain chain;
  if (validate) {
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &validation_layer;
    info.pNext = chain.link(*core);
  }
  const VkResult result = vkCreateInstance(&info, nullptr, &core->instance);
  if (result != VK_SUCCESS) {
    core->instance = VK_NULL_HANDLE;
    error = failure(result);
    return nullptr;
  }
  core->debug_utils = validate;
  core->surface = descriptor.surface;
  if (validate) make_messenger(*core);
  return core;
}

} // namespace mote::gpu::vk
