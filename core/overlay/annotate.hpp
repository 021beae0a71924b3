// SPDX-License-Identifier: MIT
// Lays the annotations of a scene over its finished picture: over linear values as they are, over displayed values
// through the same view transform that the picture went through. So a color in the legend is the color on
// an evenly lit particle, whatever the view transform. AOVs are read, never written.
#pragma once

#include "core/color/display_transform.hpp"
#include "core/overlay/canvas.hpp"
#include "core/scene/scene.hpp"

#include <cstdint>
#include <span>

namespace mote::overlay {

// `depth` as the AOV; may be empty.
[[nodiscard]] Layer draw_annotations(const Scene& scene, const View& view, std::span<const float> depth);

// Straight RGBA, row 0 on top, of the layer's size. Displayed values go through `display`.
void lay_over_linear(const Layer& layer, std::span<float> rgba);
void lay_over_linear(const Layer& layer, std::span<glm::dvec4> rgba);
void lay_over_display(const Layer& layer, const DisplayTransform& display, std::span<float> rgba);
void lay_over_display(const Layer& layer, const DisplayTransform& display, std::span<std::uint8_t> rgba);

} // namespace mote::overlay
