// SPDX-License-Identifier: MIT
// Our enumerations as Vulkan's. Private to core/gpu; total functions over valid values.
#pragma once

#include "core/gpu/descriptors.hpp"

#include <vulkan/vulkan.h>

namespace mote::gpu::vk {

VkFormat format(TextureFormat format);
VkFormat vertex_format(VertexFormat format);
VkBufferUsageFlags buffer_usage(BufferUsage usage);
VkImageUsageFlags image_usage(TextureUsage usage, bool depth);
VkImageType image_type(TextureDimension dimension);
VkImageViewType view_type(TextureViewDimension dimension);
VkShaderStageFlags shader_stages(ShaderStage stages);
// Every stage that reads push constants: all that the device has.
VkShaderStageFlags push_constant_stages(Feature features);
VkDescriptorType descriptor_type(BindingType type);
VkPrimitiveTopology topology(Topology topology);
VkCullModeFlags cull_mode(CullMode mode);
VkCompareOp compare(CompareFunction function);
VkBlendFactor blend_factor(BlendFactor factor);
VkBlendOp blend_operation(BlendOperation operation);
VkFilter filter(FilterMode mode);
VkSamplerAddressMode address_mode(AddressMode mode);
VkAttachmentLoadOp load_op(LoadOp op);
VkAttachmentStoreOp store_op(StoreOp op);
// The value as a format's shader type takes it: integers rounded and clamped, floats kept (also infinite).
VkClearColorValue clear_color(Color color, TextureFormat format);

} // namespace mote::gpu::vk
