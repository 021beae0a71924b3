// SPDX-License-Identifier: MIT
// The sheet as pixels, by the filler of areas and the letters of core/overlay.
#include "core/chart/figure.hpp"
#include "core/chart/write.hpp"
#include "core/color/srgb.hpp"
#include "core/overlay/canvas.hpp"
#include "core/overlay/font.hpp"

#include <cmath>

namespace mote::chart {
namespace {

glm::dvec3 linear(std::uint32_t rgb) {
  return {srgb_decode((rgb >> 16 & 255u) / 255.0), srgb_decode((rgb >> 8 & 255u) / 255.0), srgb_decode((rgb & 255u) / 255.0)};
}

class Rasterizer {
public:
  Rasterizer(const Figure& figure, double scale)
      : scale_(scale), canvas_({static_cast<std::uint32_t>(std::ceil(figure.width * scale)), static_cast<std::uint32_t>(std::ceil(figure.height * scale))}) {
    for (const Stroke& s : figure.strokes) stroke(s.points, s.width, s.color, s.dashed);
    for (const Area& a : figure.areas) area(a);
    for (const Text& t : figure.texts) text(t);
  }
  Pixels pixels() {
    const overlay::Layer layer = canvas_.take();
    Pixels out{layer.size.width, layer.size.height, {}};
    out.rgba.reserve(layer.pixels.size() * 4);
    for (const glm::vec4& p : layer.pixels) {
      for (int k = 0; k < 3; ++k) out.rgba.push_back(to_8bit(srgb_encode(static_cast<double>(p[k]) + 1.0 - static_cast<double>(p.a))));
      out.rgba.push_back(255);
    }
    return out;
  }

private:
  void segment(glm::dvec2 a, glm::dvec2 b, double width, std::uint32_t color) {
    const glm::dvec2 along = b - a;
    const double length = glm::length(along);
    if (length < 1e-9) return;
    const glm::dvec2 side = glm::dvec2(-along.y, along.x) * (0.5 * width / length);
    fill({a + side, b + side, b - side, a - side}, color);
  }
  void stroke(const std::vector<glm::dvec2>& points, double width, std::uint32_t color, bool dashed) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const glm::dvec2 a = points[i - 1], b = points[i];
      const double length = glm::length(b - a), on = dashed ? 4.0 : length, period = dashed ? 7.0 : length;
      for (double s = 0.0; s < length; s += period) segment(a + (b - a) * (s / length), a + (b - a) * (std::min(s + on, length) / length), width, color);
    }
  }
  void area(const Area& a) {
    fill(a.points, a.hollow ? 0xFFFFFFu : a.color);
    if (!a.hollow) return;
    std::vector<glm::dvec2> closed = a.points;
    closed.push_back(closed.front());
    stroke(closed, 1.2, a.color, false);
  }
  void text(const Text& t) {
    const double size = t.size * scale_, width = overlay::text_width(t.words, size);
    const double shift = t.anchor == Anchor::Start ? 0.0 : t.anchor == Anchor::Middle ? -0.5 * width : -width;
    overlay::Path path = overlay::text_path(t.words, size, shift, 0.0);
    for (auto& contour : path)
      for (glm::dvec2& p : contour) p = t.at * scale_ + (t.upward ? glm::dvec2(p.y, -p.x) : p);
    canvas_.fill(path, linear(t.color));
  }
  void fill(std::vector<glm::dvec2> points, std::uint32_t color) {
    for (glm::dvec2& p : points) p *= scale_;
    canvas_.fill({points}, linear(color));
  }

  double scale_;
  overlay::Canvas canvas_;
};

} // namespace

Pixels to_pixels(const Chart& chart, double scale) { return Rasterizer(lay_out(chart), scale).pixels(); }

} // namespace mote::chart
