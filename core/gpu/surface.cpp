// SPDX-License-Identifier: MIT
// Surface: a swapchain whose pictures are plain textures. Acquiring waits on the host for the
// picture (a window needs no more), so submissions need no semaphores of the window system; present()
// submits the last layout change itself.
#include "core/gpu/vk/convert.hpp"
#include "core/gpu/vk/handles.hpp"

#include <algorithm>

namespace mote::gpu {
namespace {

constexpr TextureFormat wanted_formats[] = {TextureFormat::BGRA8Unorm, TextureFormat::RGBA8Unorm};
constexpr TextureUsage picture_usage = TextureUsage::CopySrc | TextureUsage::CopyDst | TextureUsage::RenderAttachment;

TextureFormat choose_format(VkPhysicalDevice device, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  vk::check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, nullptr), "vkGetPhysicalDeviceSurfaceFormatsKHR");
  std::vector<VkSurfaceFormatKHR> offered(count);
  vk::check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, offered.data()), "vkGetPhysicalDeviceSurfaceFormatsKHR");
  for (const TextureFormat format : wanted_formats) {
    if (std::any_of(offered.begin(), offered.end(), [&](const auto& f) { return f.format == vk::format(format); })) return format;
  }
  invalid("V-SURF-002", "The surface offers neither bgra8unorm nor rgba8unorm.");
}

VkPresentModeKHR choose_mode(VkPhysicalDevice device, VkSurfaceKHR surface, PresentMode wanted) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceSurfacePresentModesKHR(device, surface, &count, nullptr);
  std::vector<VkPresentModeKHR> offered(count);
  vkGetPhysicalDeviceSurfacePresentModesKHR(device, surface, &count, offered.data());
  const VkPresentModeKHR mode = wanted == PresentMode::Mailbox     ? VK_PRESENT_MODE_MAILBOX_KHR
                                : wanted == PresentMode::Immediate ? VK_PRESENT_MODE_IMMEDIATE_KHR
                                                                   : VK_PRESENT_MODE_FIFO_KHR;
  return std::find(offered.begin(), offered.end(), mode) != offered.end() ? mode : VK_PRESENT_MODE_FIFO_KHR; // always there
}

// The extent the window system wants: its own if it says one, else what was configured, in its limits.
VkExtent2D choose_extent(const VkSurfaceCapabilitiesKHR& caps, const SurfaceConfiguration& configuration) {
  if (caps.currentExtent.width != 0xFFFFFFFFu) return caps.currentExtent;
  return {std::clamp(configuration.width, caps.minImageExtent.width, caps.maxImageExtent.width),
          std::clamp(configuration.height, caps.minImageExtent.height, caps.maxImageExtent.height)};
}

VkSurfaceCapabilitiesKHR capabilities(const Surface::Impl& s) {
  VkSurfaceCapabilitiesKHR caps{};
  vk::check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(s.core->adapter->physical, s.surface, &caps), "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  return caps;
}

Texture wrap_picture(const Surface::Impl& s, VkImage image, std::size_t index) {
  auto texture = std::make_shared<Texture::Impl>(s.core, fmt::format("{} picture {}", s.label, index));
  texture->owned = false;
  texture->handle = image;
  texture->facts = {texture->label, {s.extent.width, s.extent.height, 1}, s.format, picture_usage, TextureDimension::D2, 1, 1};
  texture->state.native = reinterpret_cast<std::uint64_t>(image);
  texture->state.label = texture->label;
  s.core->name(VK_OBJECT_TYPE_IMAGE, image, texture->label);
  return Texture(std::move(texture));
}

VkSwapchainKHR make_swapchain(const Surface::Impl& s, const VkSurfaceCapabilitiesKHR& caps, VkSwapchainKHR old) {
  const VkPhysicalDevice physical = s.core->adapter->physical;
  auto info = vk::init<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
  info.surface = s.surface;
  info.minImageCount = caps.maxImageCount == 0 ? caps.minImageCount + 1 : std::min(caps.minImageCount + 1, caps.maxImageCount);
  info.imageFormat = vk::format(s.format);
  info.imageColorSpace = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
  info.imageExtent = s.extent;
  info.imageArrayLayers = 1;
  info.imageUsage = vk::image_usage(picture_usage, false);
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = caps.currentTransform;
  info.compositeAlpha = (caps.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0 ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                                                               : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
  info.presentMode = choose_mode(physical, s.surface, s.configuration.present_mode);
  info.clipped = VK_TRUE;
  info.oldSwapchain = old;
  VkSwapchainKHR swapchain{};
  vk::check(vkCreateSwapchainKHR(s.core->device, &info, nullptr, &swapchain), "vkCreateSwapchainKHR");
  return swapchain;
}

} // namespace

Surface::operator bool() const { return impl_ && impl_->valid; }
const std::string& Surface::label() const {
  static const std::string empty;
  return impl_ ? impl_->label : empty;
}

Surface Instance::create_surface(const SurfaceDescriptor& d, Error& error) const {
  if (!impl_ || !impl_->core->surface || !d.create) {
    error = {ErrorFilter::Validation, "V-SURF-001",
             fmt::format("{} needs an Instance made with InstanceDescriptor.surface and a create function.", named("Surface", d.label)), {}};
    return {};
  }
  std::string reason;
  void* made = d.create(impl_->core->instance, reason);
  if (made == nullptr) {
    error = {ErrorFilter::Internal, "V-SURF-003", fmt::format("The window system gives no surface: {}.", reason), {}};
    return {};
  }
  auto impl = std::make_shared<Surface::Impl>();
  impl->label = d.label;
  impl->instance = impl_->core;
  impl->surface = reinterpret_cast<VkSurfaceKHR>(made);
  return Surface(std::move(impl));
}

Surface::Impl::~Impl() {
  if (core) {
    vkDeviceWaitIdle(core->device);
    drop_swapchain();
    vkDestroyFence(core->device, acquired, nullptr);
  }
  vkDestroySurfaceKHR(instance->instance, surface, nullptr);
}

void Surface::Impl::drop_swapchain() {
  pictures.clear();
  for (VkSemaphore semaphore : drawn) vkDestroySemaphore(core->device, semaphore, nullptr);
  drawn.clear();
  current.reset();
  if (swapchain != VK_NULL_HANDLE) vkDestroySwapchainKHR(core->device, swapchain, nullptr);
  swapchain = VK_NULL_HANDLE;
}

// Makes the swapchain for the window's present size; none while the window has no area.
void Surface::Impl::configure() {
  vkDeviceWaitIdle(core->device);
  queue->wait(queue->last);
  const VkSurfaceCapabilitiesKHR caps = capabilities(*this);
  extent = choose_extent(caps, configuration);
  if (extent.width == 0 || extent.height == 0 || configuration.width == 0 || configuration.height == 0) {
    drop_swapchain();
    return;
  }
  const VkSwapchainKHR old = std::exchange(swapchain, VK_NULL_HANDLE);
  VkSwapchainKHR made = VK_NULL_HANDLE;
  try {
    made = make_swapchain(*this, caps, old);
  } catch (...) {
    if (old != VK_NULL_HANDLE) vkDestroySwapchainKHR(core->device, old, nullptr);
    drop_swapchain();
    throw;
  }
  if (old != VK_NULL_HANDLE) vkDestroySwapchainKHR(core->device, old, nullptr);
  drop_swapchain();
  swapchain = made;
  std::uint32_t count = 0;
  vk::check(vkGetSwapchainImagesKHR(core->device, swapchain, &count, nullptr), "vkGetSwapchainImagesKHR");
  std::vector<VkImage> images(count);
  vk::check(vkGetSwapchainImagesKHR(core->device, swapchain, &count, images.data()), "vkGetSwapchainImagesKHR");
  for (VkImage image : images) {
    pictures.push_back(wrap_picture(*this, image, pictures.size()));
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, nullptr, 0};
    vk::check(vkCreateSemaphore(core->device, &info, nullptr, &drawn.emplace_back()), "vkCreateSemaphore");
  }
}

void Surface::configure(const Device& device, const SurfaceConfiguration& configuration) {
  Impl& s = *impl_;
  const auto& target = device.impl();
  vk::guarded(
      *target->core, [&] { return fmt::format("calling {}.configure({}x{})", named("Surface", s.label), configuration.width, configuration.height); },
      [&] {
        if (!s.core) {
          s.core = target->core;
          s.queue = target->queue;
          VkBool32 supported = VK_FALSE;
          vkGetPhysicalDeviceSurfaceSupportKHR(s.core->adapter->physical, s.core->adapter->queue_family, s.surface, &supported);
          if (supported == VK_FALSE) invalid("V-SURF-004", "{} cannot present to {}.", named("Device", s.core->label), named("Surface", s.label));
          const VkFenceCreateInfo info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
          vk::check(vkCreateFence(s.core->device, &info, nullptr, &s.acquired), "vkCreateFence");
          s.format = choose_format(s.core->adapter->physical, s.surface);
        } else if (s.core != target->core) {
          invalid("V-OBJ-002", "{} belongs to {}, not to {}.", named("Surface", s.label), named("Device", s.core->label), named("Device", target->core->label));
        }
        s.configuration = configuration;
        s.configure();
      });
}

TextureFormat Surface::format() const { return impl_ ? impl_->format : TextureFormat::Undefined; }

Texture Surface::acquire() {
  Impl& s = *impl_;
  if (s.swapchain == VK_NULL_HANDLE) return {};
  Texture picture;
  vk::guarded(
      *s.core, [&] { return fmt::format("calling {}.acquire()", named("Surface", s.label)); },
      [&] {
        if (s.current) {
          picture = s.pictures[*s.current];
          return;
        }
        // Some drivers never say that the window has another size by now, so the surface is asked.
        const VkExtent2D now = choose_extent(capabilities(s), s.configuration);
        if (now.width != s.extent.width || now.height != s.extent.height) return;
        std::uint32_t index = 0;
        const VkResult result = vkAcquireNextImageKHR(s.core->device, s.swapchain, ~std::uint64_t{0}, VK_NULL_HANDLE, s.acquired, &index);
        if (result == VK_ERROR_OUT_OF_DATE_KHR) return;
        vk::check(result, "vkAcquireNextImageKHR");
        vk::check(vkWaitForFences(s.core->device, 1, &s.acquired, VK_TRUE, ~std::uint64_t{0}), "vkWaitForFences");
        vk::check(vkResetFences(s.core->device, 1, &s.acquired), "vkResetFences");
        s.current = index; // also when suboptimal: a shown picture is better than none
        TextureState& state = s.pictures[index].impl()->state;
        state.whole = {Use::Present, Use::None, 0}; // contents are undefined again
        state.parts.clear();
        picture = s.pictures[index];
      });
  return picture;
}

bool Surface::present() {
  Impl& s = *impl_;
  if (!s.current) return false;
  bool good = false;
  vk::guarded(
      *s.core, [&] { return fmt::format("calling {}.present()", named("Surface", s.label)); },
      [&] {
        const std::uint32_t index = *std::exchange(s.current, std::nullopt);
        auto recording = take_recording(*s.core);
        const auto& picture = s.pictures[index].impl();
        recording->scopes.begin(s.core->next_serial());
        use_texture(recording->scopes, *picture, {0, 1, 0, 1}, Use::Present, false);
        recording->commands.push_back(cmd::Synchronize{recording->scopes.end()});
        recording->keep(picture);
        std::vector<std::unique_ptr<Recording>> list;
        list.push_back(std::move(recording));
        s.queue->submit(std::move(list), s.drawn[index]);
        auto info = vk::init<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
        info.waitSemaphoreCount = 1;
        info.pWaitSemaphores = &s.drawn[index];
        info.swapchainCount = 1;
        info.pSwapchains = &s.swapchain;
        info.pImageIndices = &index;
        const VkResult result = vkQueuePresentKHR(s.core->queue, &info);
        if (result == VK_ERROR_OUT_OF_DATE_KHR) return;
        vk::check(result, "vkQueuePresentKHR");
        good = result == VK_SUCCESS;
      });
  return good;
}

} // namespace mote::gpu
