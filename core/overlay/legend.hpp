// SPDX-License-Identifier: MIT
// Color bars, lists of kinds, the scale bar and the time, laid out for a picture of any size: everything is a
// multiple of the letters' size, which is one forty-fifth of the picture's height (at least 9 pixels). Bars stand at one
// side, one above the other; scale bar and time in the corners of the other side.
#pragma once

#include "core/overlay/canvas.hpp"
#include "core/scene/annotations.hpp"

namespace mote::overlay {

// How text and lines are drawn: dark on light backgrounds, light on dark ones, over a veil of the background.
struct Ink {
  glm::dvec3 text{0}, veil{1}; // working space
};
[[nodiscard]] Ink ink_for(const glm::dvec4& background);

// `pixels_per_length`: of a length across the view where the camera looks; 0: no scale bar.
void draw_legend(Canvas& canvas, const Annotations& annotations, const Ink& ink, double pixels_per_length);

} // namespace mote::overlay
