// SPDX-License-Identifier: MIT
// OpenEXR out and in: linear pictures and AOVs side by side in one file, by channel name. Customary
// names: R, G, B, A (half or float, linear), Z (depth, float), normal.X/.Y/.Z (float), id (uint).
// Scan lines from the top, ZIP at its fastest level. Values are stored as they are; only a finite
// number too large for a half becomes +-65504, so that no infinity appears. No OpenEXR type leaks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace mote {

enum class ExrType : std::uint8_t { Half, Float, Uint };

// A channel to be written: pixel i of the picture is at [i * stride]. `floats` for Half and Float,
// `uints` for Uint; the other one is null. Read during the call only.
struct ExrPlane {
  std::string name{};
  ExrType type{ExrType::Half};
  const float* floats{};
  const std::uint32_t* uints{};
  std::size_t stride{1};
};
using ExrAttributes = std::vector<std::pair<std::string, std::string>>;

// Whole or not at all; "-" is standard output. Failure(Failed) I001..I003; I008 for an empty picture,
// no channel, two channels of one name or a plane without values.
void write_exr(const std::string& path, std::uint32_t width, std::uint32_t height,
               const std::vector<ExrPlane>& planes, const ExrAttributes& attributes = {});

struct ExrChannel {
  std::string name{};
  ExrType type{};
  std::vector<float> floats{};        // Half and Float
  std::vector<std::uint32_t> uints{}; // Uint
};
struct ExrPicture {
  std::uint32_t width{}, height{};
  std::vector<ExrChannel> channels{}; // sorted by name
  ExrAttributes attributes{};         // those that are text
  [[nodiscard]] const ExrChannel* find(const std::string& name) const;
};
// Flat scan-line and tiled files, the data window as the picture. Failure(BadInput) I004, I006.
ExrPicture read_exr(const std::string& path);

} // namespace mote
