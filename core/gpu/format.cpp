// SPDX-License-Identifier: MIT
#include "core/gpu/format.hpp"

#include <algorithm>

namespace mote::gpu {
namespace {

using enum TextureFormat;
constexpr std::array<FormatInfo, format_count> table{{
    {Undefined, "undefined", 0, 0, FormatKind::Float, false},
    {R8Unorm, "r8unorm", 1, 1, FormatKind::Unorm, false},
    {RGBA8Unorm, "rgba8unorm", 4, 4, FormatKind::Unorm, false},
    {RGBA8UnormSrgb, "rgba8unorm_srgb", 4, 4, FormatKind::Unorm, true},
    {BGRA8Unorm, "bgra8unorm", 4, 4, FormatKind::Unorm, false},
    {RGBA16Unorm, "rgba16unorm", 8, 4, FormatKind::Unorm, false},
    {R16Float, "r16float", 2, 1, FormatKind::Float, false},
    {RGBA16Float, "rgba16float", 8, 4, FormatKind::Float, false},
    {R32Float, "r32float", 4, 1, FormatKind::Float, false},
    {RG32Float, "rg32float", 8, 2, FormatKind::Float, false},
    {RGBA32Float, "rgba32float", 16, 4, FormatKind::Float, false},
    {R32Uint, "r32uint", 4, 1, FormatKind::Uint, false},
    {RG32Uint, "rg32uint", 8, 2, FormatKind::Uint, false},
    {RGBA32Uint, "rgba32uint", 16, 4, FormatKind::Uint, false},
    {R32Sint, "r32sint", 4, 1, FormatKind::Sint, false},
    {Depth32Float, "depth32float", 4, 1, FormatKind::Depth, false},
}};

} // namespace

const FormatInfo& format_info(TextureFormat format) {
  const auto i = static_cast<std::size_t>(format);
  return table[i < table.size() ? i : 0];
}

std::optional<TextureFormat> parse_format(std::string_view name) {
  for (const FormatInfo& info : table) {
    if (info.format != Undefined && info.name == name) return info.format;
  }
  return std::nullopt;
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const FormatInfo& info : table) {
    if (info.format != Undefined) names.emplace_back(info.name);
  }
  return names;
}

VertexFormatInfo vertex_format_info(VertexFormat format) {
  switch (format) {
    case VertexFormat::Undefined: return {};
    case VertexFormat::Float32: return {4, 1, FormatKind::Float};
    case VertexFormat::Float32x2: return {8, 2, FormatKind::Float};
    case VertexFormat::Float32x3: return {12, 3, FormatKind::Float};
    case VertexFormat::Float32x4: return {16, 4, FormatKind::Float};
    case VertexFormat::Uint32: return {4, 1, FormatKind::Uint};
    case VertexFormat::Uint32x2: return {8, 2, FormatKind::Uint};
    case VertexFormat::Uint32x3: return {12, 3, FormatKind::Uint};
    case VertexFormat::Uint32x4: return {16, 4, FormatKind::Uint};
    case VertexFormat::Unorm8x4: return {4, 4, FormatKind::Float};
  }
  return {};
}

Extent3d mip_extent(Extent3d size, TextureDimension dimension, std::uint32_t level) {
  const auto half = [level](std::uint32_t side) { return std::max(1u, level < 32 ? side >> level : 0u); };
  return {half(size.width), dimension == TextureDimension::D1 ? size.height : half(size.height),
          dimension == TextureDimension::D3 ? half(size.depth_or_layers) : size.depth_or_layers};
}

std::uint32_t max_mip_levels(Extent3d size, TextureDimension dimension) {
  std::uint32_t side = size.width;
  if (dimension != TextureDimension::D1) side = std::max(side, size.height);
  if (dimension == TextureDimension::D3) side = std::max(side, size.depth_or_layers);
  std::uint32_t levels = 1;
  while (side >>= 1) ++levels;
  return levels;
}

} // namespace mote::gpu
