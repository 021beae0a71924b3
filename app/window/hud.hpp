// SPDX-License-Identifier: MIT
// Boxes of text over the window's picture: help, messages, what was picked. Drawn on the processor with the letters of
// legends, so the window has words also where it was built without panels. Pure.
#pragma once

#include "app/window/presenter.hpp"
#include "core/overlay/canvas.hpp"

#include <array>
#include <string>
#include <vector>

namespace mote::window {

inline constexpr double panel_width = 330.0, panel_part = 0.6; // of panels: pixels of a usual display, at most this part of the window

// A layer as straight RGBA8, encoded for the display without a view transform.
std::vector<std::uint8_t> displayed(const overlay::Layer& layer);

enum class HudPlace : std::uint8_t { Center, TopLeft, BottomLeft };

// Rows of two columns (the second may be empty), light on dark. `scale`: of the display (HiDPI). Rows that do not fit
// into the window are left out, long ones are cut.
FlatPicture text_box(const std::vector<std::array<std::string, 2>>& rows, HudPlace place, Size2d window, double scale);

} // namespace mote::window
