// SPDX-License-Identifier: MIT
// A texture of the graph as it came from the device, looked at: the value of a pixel, the range of all, and a picture that
// an eye can read. Pure.
#pragma once

#include "core/gpu/types.hpp"
#include "core/math/camera.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace mote::window {

struct SlotPixels {
  Size2d size{};
  gpu::TextureFormat format{};
  std::vector<std::byte> bytes{}; // tight rows; further layers behind the first

  [[nodiscard]] unsigned components() const;
  // Normalized formats in 0..1, integers exactly. (0, 0) is the top left pixel.
  [[nodiscard]] double value(std::uint32_t x, std::uint32_t y, unsigned component) const;
  // Smallest and largest finite value of a component; {0, 0} where there is none. The largest id (nothing is there) does not count.
  [[nodiscard]] std::pair<double, double> range(unsigned component) const;
  // RGBA8: colors as they are, encoded for the display; one number a pixel as gray from `range`; ids as colors of their own.
  [[nodiscard]] std::vector<std::uint8_t> picture(std::pair<double, double> range) const;
  // "0.25, 0.5, 1, 1"
  [[nodiscard]] std::string text(std::uint32_t x, std::uint32_t y) const;
};

} // namespace mote::window
