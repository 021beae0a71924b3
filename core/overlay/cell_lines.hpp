// SPDX-License-Identifier: MIT
// The twelve edges of a cell as lines of constant width in pixels, behind what is nearer than they: each pixel of
// a line is compared with the depth AOV. They cast no shadow and change no AOV.
#pragma once

#include "core/overlay/canvas.hpp"
#include "core/scene/annotations.hpp"

#include <span>

namespace mote::overlay {

// `depth`: one value a pixel along the view axis, +inf where nothing is; empty: nothing hides the lines.
void draw_cell(Canvas& canvas, const CellOutline& cell, const View& view, std::span<const float> depth);

} // namespace mote::overlay
