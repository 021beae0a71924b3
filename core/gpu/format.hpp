// SPDX-License-Identifier: MIT
// The one table of texture and vertex formats: names as in graph files and messages, sizes, the
// kind of number a shader sees, and what a format may be used for before any adapter is asked.
// Pure data; the Vulkan numbers are in vk/convert.hpp. What a particular adapter adds or lacks is
// in FormatCaps (filled by the adapter, invented by tests).
#pragma once

#include "core/gpu/types.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mote::gpu {

enum class FormatKind : std::uint8_t { Float, Unorm, Uint, Sint, Depth };

struct FormatInfo {
  TextureFormat format{};
  std::string_view name{};   // "rgba16float"
  std::uint8_t bytes{};      // per texel
  std::uint8_t components{};
  FormatKind kind{};
  bool srgb{};               // decoded on reading, encoded on writing
};

inline constexpr std::size_t format_count = 16; // with Undefined
const FormatInfo& format_info(TextureFormat format); // an unknown value gives the Undefined row
std::optional<TextureFormat> parse_format(std::string_view name);
std::vector<std::string> format_names(); // all but Undefined, in table order

// What an adapter does with a format (optimal tiling).
struct FormatCaps {
  bool sampled{}, filterable{}, storage{}, renderable{}, blendable{}, multisample{}; // multisample: 4 samples
};
using FormatTable = std::array<FormatCaps, format_count>;
inline const FormatCaps& caps_of(const FormatTable& table, TextureFormat format) {
  const auto i = static_cast<std::size_t>(format);
  return table[i < format_count ? i : 0];
}

struct VertexFormatInfo {
  std::uint8_t bytes{}, components{};
  FormatKind kind{}; // as the shader sees it: Unorm reads as Float
};
VertexFormatInfo vertex_format_info(VertexFormat format);

// Size of mip level `level`: each side halved and rounded down, at least 1. Array layers stay.
Extent3d mip_extent(Extent3d size, TextureDimension dimension, std::uint32_t level);
std::uint32_t max_mip_levels(Extent3d size, TextureDimension dimension);

} // namespace mote::gpu
