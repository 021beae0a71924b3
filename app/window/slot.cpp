// SPDX-License-Identifier: MIT
#include "app/window/slot.hpp"

#include "app/library/texels.hpp"
#include "core/color/srgb.hpp"

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace mote::window {
namespace {

template <class T> T read(const std::byte* from) {
  T value{};
  std::memcpy(&value, from, sizeof(T));
  return value;
}

bool is_id(gpu::TextureFormat format) { return format == gpu::TextureFormat::R32Uint; }
bool is_nothing(gpu::TextureFormat format, double value) { return is_id(format) && value == 4294967295.0; }

// Neighboring ids get colors that differ.
std::array<std::uint8_t, 3> id_color(std::uint32_t id) {
  std::uint32_t h = id * 2654435761u;
  h ^= h >> 15;
  h *= 2246822519u;
  h ^= h >> 13;
  return {static_cast<std::uint8_t>(64 + (h & 0xBF)), static_cast<std::uint8_t>(64 + ((h >> 8) & 0xBF)), static_cast<std::uint8_t>(64 + ((h >> 16) & 0xBF))};
}

} // namespace

unsigned SlotPixels::components() const { return static_cast<unsigned>(app::texel_kind(format).components); }

double SlotPixels::value(std::uint32_t x, std::uint32_t y, unsigned component) const {
  const app::TexelKind kind = app::texel_kind(format);
  if (x >= size.width || y >= size.height || component >= kind.components) return 0.0;
  const std::size_t width = static_cast<std::size_t>(kind.npy[2] - '0');
  if (format == gpu::TextureFormat::BGRA8Unorm && component < 3) component = 2 - component;
  const std::byte* from = bytes.data() + ((std::size_t{y} * size.width + x) * kind.components + component) * width;
  if (kind.npy == "|u1") return read<std::uint8_t>(from) / 255.0;
  if (kind.npy == "<u2") return read<std::uint16_t>(from) / 65535.0;
  if (kind.npy == "<f2") return glm::unpackHalf1x16(read<std::uint16_t>(from));
  if (kind.npy == "<u4") return read<std::uint32_t>(from);
  if (kind.npy == "<i4") return read<std::int32_t>(from);
  return read<float>(from);
}

std::pair<double, double> SlotPixels::range(unsigned component) const {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::uint32_t y = 0; y < size.height; ++y)
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const double v = value(x, y, component);
      if (!std::isfinite(v) || is_nothing(format, v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  if (low > high) return {0.0, 0.0};
  return {low, high};
}

std::vector<std::uint8_t> SlotPixels::picture(std::pair<double, double> range) const {
  std::vector<std::uint8_t> out(std::size_t{size.width} * size.height * 4, 255);
  const unsigned n = components();
  const bool encoded = app::texel_kind(format).npy == "|u1" || app::texel_kind(format).npy == "<u2";
  const double length = range.second > range.first ? range.second - range.first : 1.0;
  for (std::uint32_t y = 0; y < size.height; ++y)
    for (std::uint32_t x = 0; x < size.width; ++x) {
      std::uint8_t* pixel = &out[(std::size_t{y} * size.width + x) * 4];
      if (is_id(format)) {
        const double id = value(x, y, 0);
        const auto color = is_nothing(format, id) ? std::array<std::uint8_t, 3>{} : id_color(static_cast<std::uint32_t>(id));
        std::copy(color.begin(), color.end(), pixel);
        continue;
      }
      for (unsigned k = 0; k < 3; ++k) {
        const double v = value(x, y, n >= 3 ? k : 0);
        const double shown = n >= 3 ? (encoded ? v : srgb_encode(std::max(v, 0.0))) : (v - range.first) / length;
        pixel[k] = std::isnan(shown) ? (k == 1 ? 0 : 255) : to_8bit(shown); // NaN: magenta
      }
    }
  return out;
}

std::string SlotPixels::text(std::uint32_t x, std::uint32_t y) const {
  std::string out;
  for (unsigned k = 0; k < components(); ++k) out += fmt::format("{}{:.6g}", k ? ", " : "", value(x, y, k));
  if (is_id(format)) out = is_nothing(format, value(x, y, 0)) ? "nothing" : fmt::format("{}", static_cast<std::uint64_t>(value(x, y, 0)));
  return out;
}

} // namespace mote::window
