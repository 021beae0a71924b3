// SPDX-License-Identifier: MIT
// Texture and TextureView.
#include "core/gpu/vk/convert.hpp"
#include "core/gpu/vk/handles.hpp"

namespace mote::gpu {
namespace vk {
namespace {

// Larger images than the driver has room for are refused before it is asked to make them.
void check_bytes(const DeviceCore& core, const VkImageCreateInfo& info, const TextureDescriptor& d) {
  VkImageFormatProperties most{};
  const VkResult known = vkGetPhysicalDeviceImageFormatProperties(core.adapter->physical, info.format, info.imageType, info.tiling, info.usage, info.flags, &most);
  if (known != VK_SUCCESS) return; // the rules of check_texture decide
  std::uint64_t bytes = 0;
  for (std::uint32_t level = 0; level < d.mip_level_count; ++level) {
    const Extent3d size = mip_extent(d.size, d.dimension, level);
    bytes += std::uint64_t{size.width} * size.height * size.depth_or_layers * format_info(d.format).bytes;
  }
  if (bytes > most.maxResourceSize)
    out_of_memory("V-MEM-002", "{} asks for {} bytes; the driver gives a texture at most {} bytes.", named("Texture", d.label), bytes, most.maxResourceSize);
}

} // namespace

void init_texture(Texture::Impl& texture, const TextureDescriptor& d) {
  DeviceCore& core = *texture.core;
  texture.facts = {texture.label, d.size, d.format, d.usage, d.dimension, d.mip_level_count, d.sample_count};
  const bool depth = format_info(d.format).kind == FormatKind::Depth;
  const bool volume = d.dimension == TextureDimension::D3;
  auto info = vk::init<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = image_type(d.dimension);
  info.format = format(d.format);
  info.extent = {d.size.width, d.size.height, volume ? d.size.depth_or_layers : 1};
  info.mipLevels = d.mip_level_count;
  info.arrayLayers = texture.facts.layers();
  info.samples = static_cast<VkSampleCountFlagBits>(d.sample_count);
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = image_usage(d.usage, depth);
  if (core.fill_new_memory) info.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  check_bytes(core, info, d);
  check(vkCreateImage(core.device, &info, nullptr, &texture.handle), "vkCreateImage");
  core.name(VK_OBJECT_TYPE_IMAGE, texture.handle, texture.label);
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(core.device, texture.handle, &needs);
  texture.memory = Allocation(core, needs, MemoryKind::Device, named("Texture", texture.label));
  check(vkBindImageMemory(core.device, texture.handle, texture.memory.memory(), 0), "vkBindImageMemory");
  texture.state.native = reinterpret_cast<std::uint64_t>(texture.handle);
  texture.state.label = texture.label;
  texture.state.depth = depth;
  texture.state.mips = d.mip_level_count;
  texture.state.layers = texture.facts.layers();
}

namespace {

void init_view(TextureView::Impl& view, const std::shared_ptr<Texture::Impl>& texture, const TextureViewDescriptor& descriptor) {
  const ViewFacts facts = check_view(texture->facts, descriptor);
  view.texture = texture;
  view.range = facts.range;
  view.dimension = facts.dimension;
  auto info = vk::init<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  info.image = texture->handle;
  info.viewType = view_type(facts.dimension);
  info.format = format(texture->facts.format);
  info.subresourceRange.aspectMask = texture->state.depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  info.subresourceRange.baseMipLevel = facts.range.base_mip;
  info.subresourceRange.levelCount = facts.range.mips;
  info.subresourceRange.baseArrayLayer = facts.range.base_layer;
  info.subresourceRange.layerCount = facts.range.layers;
  check(vkCreateImageView(view.core->device, &info, nullptr, &view.handle), "vkCreateImageView");
  view.core->name(VK_OBJECT_TYPE_IMAGE_VIEW, view.handle, view.label);
}

} // namespace
} // namespace vk

Texture Device::create_texture(const TextureDescriptor& descriptor) {
  return vk::make<Texture>(impl_->core, "create_texture", "Texture", descriptor.label, [&](Texture::Impl& texture) {
    check_texture(impl_->core->facts, descriptor);
    vk::init_texture(texture, descriptor);
    if (impl_->core->fill_new_memory && descriptor.sample_count == 1) {
      impl_->queue->fill_new(std::static_pointer_cast<Texture::Impl>(texture.shared_from_this()));
    }
  });
}

TextureView Texture::create_view(const TextureViewDescriptor& descriptor) const {
  if (!impl_) return {};
  auto view = std::make_shared<TextureView::Impl>(impl_->core, descriptor.label.empty() ? std::string_view(impl_->label) : descriptor.label);
  view->valid = false;
  vk::guarded(
      *impl_->core,
      [&] { return fmt::format("calling {}.create_view({})", named("Texture", label()), named("TextureViewDescriptor", descriptor.label)); },
      [&] {
        vk::init_view(*view, vk::require(*this, "Texture", *impl_->core), descriptor);
        view->valid = true;
      });
  return TextureView(std::move(view));
}

Extent3d Texture::size() const { return impl_ ? impl_->facts.size : Extent3d{0, 0, 0}; }
TextureFormat Texture::format() const { return impl_ ? impl_->facts.format : TextureFormat::Undefined; }
TextureUsage Texture::usage() const { return impl_ ? impl_->facts.usage : TextureUsage::None; }
TextureDimension Texture::dimension() const { return impl_ ? impl_->facts.dimension : TextureDimension::D2; }
std::uint32_t Texture::mip_level_count() const { return impl_ ? impl_->facts.mips : 0; }
std::uint32_t Texture::sample_count() const { return impl_ ? impl_->facts.samples : 0; }

Extent3d TextureView::Impl::size() const {
  Extent3d size = mip_extent(texture->facts.size, texture->facts.dimension, range.base_mip);
  if (texture->facts.dimension != TextureDimension::D3) size.depth_or_layers = range.layers;
  return size;
}
Texture TextureView::texture() const { return impl_ && impl_->texture ? Texture(impl_->texture) : Texture(); }
TextureFormat TextureView::format() const { return texture().format(); }
Extent3d TextureView::size() const { return impl_ && impl_->texture ? impl_->size() : Extent3d{0, 0, 0}; }

} // namespace mote::gpu
