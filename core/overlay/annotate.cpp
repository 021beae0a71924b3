// SPDX-License-Identifier: MIT
#include "core/overlay/annotate.hpp"

#include "core/color/srgb.hpp"
#include "core/overlay/cell_lines.hpp"
#include "core/overlay/legend.hpp"

#include <algorithm>

namespace mote::overlay {
namespace {

// Straight alpha: `over` on `under`.
template <class V> V blended(const V& over, const V& under) {
  const auto alpha = over.w + under.w * (1 - over.w);
  if (!(alpha > 0)) return V(0);
  V out = (over * over.w + under * (under.w * (1 - over.w))) / alpha;
  out.w = alpha;
  return out;
}

glm::vec4 straight(const glm::vec4& p) { return {glm::vec3(p) / p.a, p.a}; }

// Pixels that are not empty, and their colors on the display.
struct Displayed {
  std::vector<std::size_t> places{};
  std::vector<float> rgba{};
};
Displayed displayed(const Layer& layer, const DisplayTransform& display) {
  Displayed out;
  for (std::size_t i = 0; i < layer.pixels.size(); ++i) {
    if (!(layer.pixels[i].a > 0.0f)) continue;
    const glm::vec4 p = straight(layer.pixels[i]);
    out.places.push_back(i);
    out.rgba.insert(out.rgba.end(), {p.r, p.g, p.b, p.a});
  }
  display.apply(out.rgba);
  return out;
}

glm::vec4 four(const std::vector<float>& v, std::size_t i) { return {v[4 * i], v[4 * i + 1], v[4 * i + 2], v[4 * i + 3]}; }

// Of a length across the view, where the camera looks.
double pixels_per_length(const Camera& camera, const View& view) {
  if (view.projection == Projection::Orthographic) return view.focal;
  const double depth = view.to_view(camera.target).z;
  return depth > 0.0 ? view.focal / depth : 0.0;
}

} // namespace

Layer draw_annotations(const Scene& scene, const View& view, std::span<const float> depth) {
  Canvas canvas(view.size);
  for (const CellOutline& cell : scene.annotations.cells) draw_cell(canvas, cell, view, depth);
  draw_legend(canvas, scene.annotations, ink_for(scene.background), pixels_per_length(scene.camera, view));
  return canvas.take();
}

void lay_over_linear(const Layer& layer, std::span<float> rgba) {
  for (std::size_t i = 0; i < layer.pixels.size(); ++i) {
    if (!(layer.pixels[i].a > 0.0f)) continue;
    const glm::vec4 out = blended(straight(layer.pixels[i]), glm::vec4(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2], rgba[4 * i + 3]));
    for (int k = 0; k < 4; ++k) rgba[4 * i + static_cast<std::size_t>(k)] = out[k];
  }
}

void lay_over_linear(const Layer& layer, std::span<glm::dvec4> rgba) {
  for (std::size_t i = 0; i < layer.pixels.size(); ++i)
    if (layer.pixels[i].a > 0.0f) rgba[i] = blended(glm::dvec4(straight(layer.pixels[i])), rgba[i]);
}

void lay_over_display(const Layer& layer, const DisplayTransform& display, std::span<float> rgba) {
  const Displayed over = displayed(layer, display);
  for (std::size_t i = 0; i < over.places.size(); ++i) {
    float* p = &rgba[4 * over.places[i]];
    const glm::vec4 out = blended(four(over.rgba, i), glm::vec4(p[0], p[1], p[2], p[3]));
    for (int k = 0; k < 4; ++k) p[k] = out[k];
  }
}

void lay_over_display(const Layer& layer, const DisplayTransform& display, std::span<std::uint8_t> rgba) {
  const Displayed over = displayed(layer, display);
  for (std::size_t i = 0; i < over.places.size(); ++i) {
    std::uint8_t* p = &rgba[4 * over.places[i]];
    const glm::vec4 out = blended(four(over.rgba, i), glm::vec4(p[0], p[1], p[2], p[3]) / 255.0f);
    for (int k = 0; k < 4; ++k) p[k] = to_8bit(static_cast<double>(out[k]));
  }
}

} // namespace mote::overlay
