// SPDX-License-Identifier: MIT
#include "app/library/texels.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cstdint>

namespace mote::app {

using gpu::TextureFormat;

TexelKind texel_kind(TextureFormat format) {
  switch (format) {
  case TextureFormat::R8Unorm: return {"|u1", 1};
  case TextureFormat::RGBA8Unorm:
  case TextureFormat::RGBA8UnormSrgb:
  case TextureFormat::BGRA8Unorm: return {"|u1", 4};
  case TextureFormat::RGBA16Unorm: return {"<u2", 4};
  case TextureFormat::R16Float: return {"<f2", 1};
  case TextureFormat::RGBA16Float: return {"<f2", 4};
  case TextureFormat::R32Float:
  case TextureFormat::Depth32Float: return {"<f4", 1};
  case TextureFormat::RG32Float: return {"<f4", 2};
  case TextureFormat::RGBA32Float: return {"<f4", 4};
  case TextureFormat::R32Uint: return {"<u4", 1};
  case TextureFormat::RG32Uint: return {"<u4", 2};
  case TextureFormat::RGBA32Uint: return {"<u4", 4};
  case TextureFormat::R32Sint: return {"<i4", 1};
  case TextureFormat::Undefined: break;
  }
  return {};
}

std::vector<float> to_floats(TextureFormat format, std::span<const std::byte> bytes) {
  const std::string_view type = texel_kind(format).npy;
  std::vector<float> out;
  auto convert = [&](const auto& values, auto to_float) {
    out.resize(values.size());
    std::transform(values.begin(), values.end(), out.begin(), to_float);
  };
  if (type == "<f4") out = texels_as<float>(bytes);
  else if (type == "<f2") convert(texels_as<std::uint16_t>(bytes), [](std::uint16_t h) { return glm::unpackHalf1x16(h); });
  else if (type == "|u1") convert(texels_as<std::uint8_t>(bytes), [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
  else if (type == "<u2") convert(texels_as<std::uint16_t>(bytes), [](std::uint16_t v) { return static_cast<float>(v) / 65535.0f; });
  else if (type == "<u4") convert(texels_as<std::uint32_t>(bytes), [](std::uint32_t v) { return static_cast<float>(v); });
  else if (type == "<i4") convert(texels_as<std::int32_t>(bytes), [](std::int32_t v) { return static_cast<float>(v); });
  if (format == TextureFormat::BGRA8Unorm)
    for (std::size_t i = 0; i + 3 < out.size(); i += 4) std::swap(out[i], out[i + 2]);
  return out;
}

} // namespace mote::app
