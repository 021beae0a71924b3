// SPDX-License-Identifier: MIT
#include "core/overlay/cell_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::overlay {
namespace {

struct Projected {
  glm::dvec2 pixel{0};
  double depth{};
};

Projected project(const View& view, const glm::dvec3& p) {
  const double scale = view.projection == Projection::Perspective ? view.focal / p.z : view.focal;
  return {{p.x * scale + 0.5 * view.size.width, p.y * scale + 0.5 * view.size.height}, p.z};
}

// Cuts a segment in view space to what lies between the cutting planes; false when nothing is left.
bool cut(glm::dvec3& a, glm::dvec3& b, const View& view, double least) {
  const double far = view.far_cut > 0.0 ? view.far_cut : 1e30;
  if (a.z > b.z) std::swap(a, b);
  if (b.z <= least || a.z >= far) return false;
  const glm::dvec3 d = b - a;
  const glm::dvec3 from = a;
  if (a.z < least) a = from + d * ((least - from.z) / d.z);
  if (b.z > far) b = from + d * ((far - from.z) / d.z);
  return true;
}

// Keeps the part of the segment that is near the picture, so that loops stay short (Liang and Barsky 1984).
bool clip(glm::dvec2& a, glm::dvec2& b, double& t0, double& t1, const glm::dvec2& low, const glm::dvec2& high) {
  const glm::dvec2 d = b - a;
  for (int k = 0; k < 2; ++k)
    for (const double side : {-1.0, 1.0}) {
      const double p = side * d[k], q = side < 0.0 ? a[k] - low[k] : high[k] - a[k];
      if (p == 0.0 && q < 0.0) return false;
      if (p < 0.0) t0 = std::max(t0, q / p);
      if (p > 0.0) t1 = std::min(t1, q / p);
    }
  if (t0 >= t1) return false;
  const glm::dvec2 from = a;
  a = from + t0 * d;
  b = from + t1 * d;
  return true;
}

class Line {
public:
  Line(Canvas& canvas, const View& view, std::span<const float> depth) : canvas_(canvas), view_(view), depth_(depth) {}

  void draw(const glm::dvec3& from, const glm::dvec3& to, const CellOutline& cell, double width) const {
    glm::dvec3 a = view_.to_view(from), b = view_.to_view(to);
    if (!cut(a, b, view_, std::max(view_.near_cut, view_.projection == Projection::Perspective ? view_.depth_near : -1e30))) return;
    const Projected p = project(view_, a), q = project(view_, b);
    glm::dvec2 s = p.pixel, e = q.pixel;
    double t0 = 0.0, t1 = 1.0;
    if (!clip(s, e, t0, t1, glm::dvec2(-width), glm::dvec2(view_.size.width, view_.size.height) + width)) return;
    const bool flat = std::abs(e.x - s.x) >= std::abs(e.y - s.y);
    const int along = flat ? 0 : 1, across = 1 - along;
    if (s[along] > e[along]) {
      std::swap(s, e);
      std::swap(t0, t1);
    }
    const double length = glm::length(e - s), run = e[along] - s[along];
    if (!(run > 0.0)) return;
    const double reach = 0.5 * (width + 1.0) * length / run;
    const std::array<int, 2> size{static_cast<int>(view_.size.width), static_cast<int>(view_.size.height)};
    const int first = std::max(0, static_cast<int>(std::floor(s[along] - 0.5))), last = std::min(size[static_cast<std::size_t>(along)] - 1, static_cast<int>(std::ceil(e[along])));
    for (int i = first; i <= last; ++i) {
      const double u = std::clamp((i + 0.5 - s[along]) / run, 0.0, 1.0), middle = s[across] + u * (e[across] - s[across]);
      const double t = t0 + u * (t1 - t0); // on the picture; depth is linear in 1/z for perspective views
      const double z = view_.projection == Projection::Perspective ? 1.0 / (1.0 / p.depth + t * (1.0 / q.depth - 1.0 / p.depth)) : p.depth + t * (q.depth - p.depth);
      const int low = std::max(0, static_cast<int>(std::floor(middle - reach))), high = std::min(size[static_cast<std::size_t>(across)] - 1, static_cast<int>(std::ceil(middle + reach)));
      for (int k = low; k <= high; ++k) {
        const double distance = std::abs(k + 0.5 - middle) * run / length;
        const double covered = std::clamp(0.5 * width + 0.5 - distance, 0.0, 1.0);
        if (covered > 0.0) put(flat ? i : k, flat ? k : i, z, covered, cell.color);
      }
    }
  }

private:
  void put(int x, int y, double z, double covered, const glm::dvec3& color) const {
    const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
    if (!depth_.empty() && static_cast<double>(depth_[std::size_t{row} * view_.size.width + column]) < z * (1.0 - 1e-6)) return;
    canvas_.blend(column, row, color, covered);
  }
  Canvas& canvas_;
  const View& view_;
  std::span<const float> depth_;
};

} // namespace

void draw_cell(Canvas& canvas, const CellOutline& cell, const View& view, std::span<const float> depth) {
  const double width = cell.width > 0.0 ? cell.width : std::max(1.0, view.size.height / 600.0);
  const Line line(canvas, view, depth);
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 4; ++k) {
      const glm::dvec3 start = cell.corner + (k & 1 ? 1.0 : 0.0) * cell.edges[(axis + 1) % 3] + (k & 2 ? 1.0 : 0.0) * cell.edges[(axis + 2) % 3];
      line.draw(start, start + cell.edges[axis], cell, width);
    }
}

} // namespace mote::overlay
