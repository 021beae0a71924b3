// SPDX-License-Identifier: MIT
// Texels as they come from a device, as numbers. Private to app/library.
#pragma once

#include "core/gpu/types.hpp"

#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

namespace mote::app {

struct TexelKind {
  std::string_view npy{};   // NumPy's name of one component
  std::size_t components{}; // 0: a format that nothing here reads
};
TexelKind texel_kind(gpu::TextureFormat format);

// Every component as a float; normalized ones in 0..1. Integer formats give their values.
std::vector<float> to_floats(gpu::TextureFormat format, std::span<const std::byte> bytes);

template <class T> std::vector<T> texels_as(std::span<const std::byte> bytes) {
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
  return out;
}

} // namespace mote::app
