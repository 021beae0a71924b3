// SPDX-License-Identifier: MIT
// The sRGB curve of IEC 61966-2-1 in double precision: what "#rrggbb" means. Header only, no OCIO.
// Readers of scenes decode colors with it, tests compare OCIO's own curve with it. Never used on
// whole pictures: those go through a DisplayTransform.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace mote {

// encoded -> linear. Any finite value; below zero the linear segment goes on.
inline double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}
// linear -> encoded. Any finite value; below zero the linear segment goes on.
inline double srgb_encode(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}
inline std::array<double, 3> srgb_decode(const std::array<double, 3>& c) {
  return {srgb_decode(c[0]), srgb_decode(c[1]), srgb_decode(c[2])};
}
inline std::array<double, 3> srgb_encode(const std::array<double, 3>& c) {
  return {srgb_encode(c[0]), srgb_encode(c[1]), srgb_encode(c[2])};
}
// [0,1] -> 0..255, rounded to the nearest; NaN gives 0. The rule of every 8-bit picture of mote.
inline std::uint8_t to_8bit(double value) {
  return static_cast<std::uint8_t>(std::clamp(value > 0.0 ? value : 0.0, 0.0, 1.0) * 255.0 + 0.5);
}

} // namespace mote
