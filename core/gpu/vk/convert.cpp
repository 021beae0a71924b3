// SPDX-License-Identifier: MIT
#include "core/gpu/vk/convert.hpp"

#include "core/gpu/format.hpp"

#include <algorithm>
#include <cmath>

namespace mote::gpu::vk {

VkFormat format(TextureFormat format) {
  using enum TextureFormat;
  switch (format) {
    case Undefined: return VK_FORMAT_UNDEFINED;
    case R8Unorm: return VK_FORMAT_R8_UNORM;
    case RGBA8Unorm: return VK_FORMAT_R8G8B8A8_UNORM;
    case RGBA8UnormSrgb: return VK_FORMAT_R8G8B8A8_SRGB;
    case BGRA8Unorm: return VK_FORMAT_B8G8R8A8_UNORM;
    case RGBA16Unorm: return VK_FORMAT_R16G16B16A16_UNORM;
    case R16Float: return VK_FORMAT_R16_SFLOAT;
    case RGBA16Float: return VK_FORMAT_R16G16B16A16_SFLOAT;
    case R32Float: return VK_FORMAT_R32_SFLOAT;
    case RG32Float: return VK_FORMAT_R32G32_SFLOAT;
    case RGBA32Float: return VK_FORMAT_R32G32B32A32_SFLOAT;
    case R32Uint: return VK_FORMAT_R32_UINT;
    case RG32Uint: return VK_FORMAT_R32G32_UINT;
    case RGBA32Uint: return VK_FORMAT_R32G32B32A32_UINT;
    case R32Sint: return VK_FORMAT_R32_SINT;
    case Depth32Float: return VK_FORMAT_D32_SFLOAT;
  }
  return VK_FORMAT_UNDEFINED;
}

VkFormat vertex_format(VertexFormat format) {
  using enum VertexFormat;
  switch (format) {
    case Undefined: return VK_FORMAT_UNDEFINED;
    case Float32: return VK_FORMAT_R32_SFLOAT;
    case Float32x2: return VK_FORMAT_R32G32_SFLOAT;
    case Float32x3: return VK_FORMAT_R32G32B32_SFLOAT;
    case Float32x4: return VK_FORMAT_R32G32B32A32_SFLOAT;
    case Uint32: return VK_FORMAT_R32_UINT;
    case Uint32x2: return VK_FORMAT_R32G32_UINT;
    case Uint32x3: return VK_FORMAT_R32G32B32_UINT;
    case Uint32x4: return VK_FORMAT_R32G32B32A32_UINT;
    case Unorm8x4: return VK_FORMAT_R8G8B8A8_UNORM;
  }
  return VK_FORMAT_UNDEFINED;
}

VkBufferUsageFlags buffer_usage(BufferUsage usage) {
  VkBufferUsageFlags flags = VK_BUFFER_USAGE_TRANSFER_DST_BIT; // first contents, test fills
  const auto add = [&](BufferUsage bit, VkBufferUsageFlags flag) { flags |= any(usage & bit) ? flag : 0u; };
  add(BufferUsage::CopySrc, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  add(BufferUsage::Index, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  add(BufferUsage::Vertex, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  add(BufferUsage::Uniform, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  add(BufferUsage::Storage, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  add(BufferUsage::Indirect, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
  return flags;
}

VkImageUsageFlags image_usage(TextureUsage usage, bool depth) {
  VkImageUsageFlags flags = 0;
  const auto add = [&](TextureUsage bit, VkImageUsageFlags flag) { flags |= any(usage & bit) ? flag : 0u; };
  add(TextureUsage::CopySrc, VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  add(TextureUsage::CopyDst, VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  add(TextureUsage::Sampled, VK_IMAGE_USAGE_SAMPLED_BIT);
  add(TextureUsage::Storage, VK_IMAGE_USAGE_STORAGE_BIT);
  add(TextureUsage::RenderAttachment,
      depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  return flags;
}

VkImageType image_type(TextureDimension dimension) {
  return dimension == TextureDimension::D1   ? VK_IMAGE_TYPE_1D
         : dimension == TextureDimension::D3 ? VK_IMAGE_TYPE_3D
                                             : VK_IMAGE_TYPE_2D;
}

VkImageViewType view_type(TextureViewDimension dimension) {
  switch (dimension) {
    case TextureViewDimension::D1: return VK_IMAGE_VIEW_TYPE_1D;
    case TextureViewDimension::D2Array: return VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    case TextureViewDimension::D3: return VK_IMAGE_VIEW_TYPE_3D;
    default: return VK_IMAGE_VIEW_TYPE_2D;
  }
}

VkShaderStageFlags shader_stages(ShaderStage stages) {
  VkShaderStageFlags flags = 0;
  if (any(stages & ShaderStage::Vertex)) flags |= VK_SHADER_STAGE_VERTEX_BIT;
  if (any(stages & ShaderStage::Fragment)) flags |= VK_SHADER_STAGE_FRAGMENT_BIT;
  if (any(stages & ShaderStage::Compute)) flags |= VK_SHADER_STAGE_COMPUTE_BIT;
  if (any(stages & ShaderStage::Geometry)) flags |= VK_SHADER_STAGE_GEOMETRY_BIT;
  return flags;
}

VkShaderStageFlags push_constant_stages(Feature features) {
  ShaderStage stages = ShaderStage::Vertex | ShaderStage::Fragment | ShaderStage::Compute;
  if (has(features, Feature::GeometryShader)) stages |= ShaderStage::Geometry;
  return shader_stages(stages);
}

VkDescriptorType descriptor_type(BindingType type) {
  switch (type) {
    case BindingType::UniformBuffer: return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BindingType::SampledTexture: return VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    case BindingType::StorageTexture:
    case BindingType::ReadOnlyStorageTexture: return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    case BindingType::Sampler: return VK_DESCRIPTOR_TYPE_SAMPLER;
    default: return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  }
}

VkPrimitiveTopology topology(Topology topology) {
  switch (topology) {
    case Topology::PointList: return VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
    case Topology::LineList: return VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
    case Topology::TriangleStrip: return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    default: return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  }
}

VkCullModeFlags cull_mode(CullMode mode) {
  return mode == CullMode::Front ? VK_CULL_MODE_FRONT_BIT : mode == CullMode::Back ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE;
}

VkCompareOp compare(CompareFunction function) {
  return function == CompareFunction::Undefined ? VK_COMPARE_OP_ALWAYS
                                                : static_cast<VkCompareOp>(static_cast<int>(function) - 1);
}
static_assert(static_cast<int>(CompareFunction::Never) - 1 == VK_COMPARE_OP_NEVER);
static_assert(static_cast<int>(CompareFunction::Greater) - 1 == VK_COMPARE_OP_GREATER);
static_assert(static_cast<int>(CompareFunction::Always) - 1 == VK_COMPARE_OP_ALWAYS);

VkBlendFactor blend_factor(BlendFactor factor) {
  using enum BlendFactor;
  switch (factor) {
    case Zero: return VK_BLEND_FACTOR_ZERO;
    case One: return VK_BLEND_FACTOR_ONE;
    case Src: return VK_BLEND_FACTOR_SRC_COLOR;
    case OneMinusSrc: return VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR;
    case SrcAlpha: return VK_BLEND_FACTOR_SRC_ALPHA;
    case OneMinusSrcAlpha: return VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    case Dst: return VK_BLEND_FACTOR_DST_COLOR;
    case OneMinusDst: return VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR;
    case DstAlpha: return VK_BLEND_FACTOR_DST_ALPHA;
    case OneMinusDstAlpha: return VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA;
    case SrcAlphaSaturated: return VK_BLEND_FACTOR_SRC_ALPHA_SATURATE;
    case Constant: return VK_BLEND_FACTOR_CONSTANT_COLOR;
    case OneMinusConstant: return VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_COLOR;
  }
  return VK_BLEND_FACTOR_ONE;
}

VkBlendOp blend_operation(BlendOperation operation) { return static_cast<VkBlendOp>(operation); }
static_assert(static_cast<int>(BlendOperation::Subtract) == VK_BLEND_OP_SUBTRACT);
static_assert(static_cast<int>(BlendOperation::Max) == VK_BLEND_OP_MAX);

VkFilter filter(FilterMode mode) { return mode == FilterMode::Linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST; }

VkSamplerAddressMode address_mode(AddressMode mode) {
  return mode == AddressMode::Repeat         ? VK_SAMPLER_ADDRESS_MODE_REPEAT
         : mode == AddressMode::MirrorRepeat ? VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT
                                             : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
}

VkAttachmentLoadOp load_op(LoadOp op) {
  return op == LoadOp::Clear  ? VK_ATTACHMENT_LOAD_OP_CLEAR
         : op == LoadOp::Load ? VK_ATTACHMENT_LOAD_OP_LOAD
                              : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
}

VkAttachmentStoreOp store_op(StoreOp op) {
  return op == StoreOp::Store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
}

VkClearColorValue clear_color(Color color, TextureFormat texture_format) {
  double values[4] = {color.r, color.g, color.b, color.a};
  const FormatKind kind = format_info(texture_format).kind;
  if (kind == FormatKind::Uint || kind == FormatKind::Sint) {
    for (double& v : values) v = std::isnan(v) ? 0.0 : v;
  }
  VkClearColorValue value{};
  for (int i = 0; i < 4; ++i) {
    switch (kind) {
      case FormatKind::Uint:
        value.uint32[i] = static_cast<std::uint32_t>(std::clamp(std::nearbyint(values[i]), 0.0, 4294967295.0));
        break;
      case FormatKind::Sint:
        value.int32[i] = static_cast<std::int32_t>(std::clamp(std::nearbyint(values[i]), -2147483648.0, 2147483647.0));
        break;
      default: value.float32[i] = static_cast<float>(values[i]);
    }
  }
  return value;
}

} // namespace mote::gpu::vk
