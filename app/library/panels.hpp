// SPDX-License-Identifier: MIT
// Pictures larger than a texture may be, or than one wants to hold on the device at once: drawn panel by
// panel and put together in memory. All panels share the camera and take their rays from the whole
// picture's pixel grid, so there are no seams: what two panels would both draw is the same bit for bit.
#pragma once

#include "app/library/frame_renderer.hpp"

#include <cstdint>

namespace mote::app {

// Pixels a side from which on pictures are drawn in panels when nobody says otherwise.
constexpr std::uint32_t default_panel = 4096;
// Pixels a side of the largest picture: up to here a float32 ray is within 1e-3 pixels of the exact one.
constexpr std::uint32_t largest_picture = 32768;

// Draws all of `view` and waits. `panel`: pixels a side of a panel at most; 0: default_panel. What the device cannot
// hold at once is smaller still.
DrawnPicture draw_picture(FrameRenderer& renderer, const View& view, std::uint32_t panel = 0);

// In how many panels that is.
std::size_t panel_count(const FrameRenderer& renderer, const View& view, std::uint32_t panel = 0);

} // namespace mote::app
