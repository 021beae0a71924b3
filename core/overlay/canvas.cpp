// SPDX-License-Identifier: MIT
#include "core/overlay/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace mote::overlay {
namespace {

// Signed areas of a path in a window of pixels. An edge adds to each cell the area to its right within the cell's row;
// the running sum along a row is then the coverage (the accumulation buffer of R. Levien's font-rs, written anew).
class Coverage {
public:
  Coverage(int x, int y, int width, int height) : x_(x), y_(y), width_(width), height_(height) {
    sums_.resize(static_cast<std::size_t>((width + 2) * height));
  }
  void edge(glm::dvec2 a, glm::dvec2 b) {
    a -= glm::dvec2(x_, y_);
    b -= glm::dvec2(x_, y_);
    if (a.y == b.y) return;
    const double sign = a.y < b.y ? 1.0 : -1.0;
    if (a.y > b.y) std::swap(a, b);
    const double slope = (b.x - a.x) / (b.y - a.y);
    const int last = std::min(height_ - 1, static_cast<int>(std::floor(b.y)));
    for (int row = std::max(0, static_cast<int>(std::floor(a.y))); row <= last; ++row) {
      const double top = std::max(a.y, static_cast<double>(row)), bottom = std::min(b.y, row + 1.0);
      if (bottom <= top) continue;
      span(row, a.x + slope * (top - a.y), a.x + slope * (bottom - a.y), sign * (bottom - top));
    }
  }
  template <class Fn> void each(const Fn& fn) const { // fn(x, y, coverage)
    for (int row = 0; row < height_; ++row) {
      double sum = 0.0;
      for (int k = 0; k < width_; ++k) {
        sum += sums_[at(row, k)];
        if (const double covered = std::min(std::abs(sum), 1.0); covered > 1e-4) fn(x_ + k, y_ + row, covered);
      }
    }
  }

private:
  [[nodiscard]] std::size_t at(int row, int k) const { return static_cast<std::size_t>(row * (width_ + 2) + k); }
  // A piece of an edge within one row, from x0 to x1, `height` of it (signed).
  void span(int row, double x0, double x1, double height) {
    if (x0 > x1) std::swap(x0, x1);
    x0 = std::clamp(x0, 0.0, static_cast<double>(width_));
    x1 = std::clamp(x1, 0.0, static_cast<double>(width_));
    const int first = static_cast<int>(std::floor(x0)), last = static_cast<int>(std::floor(x1));
    double before = 0.0; // of the height, that which lies in pixels left of k, area to the right counted
    for (int k = first; k <= last; ++k) {
      const double left = std::max(x0, static_cast<double>(k)), right = std::min(x1, k + 1.0);
      const double part = x1 > x0 ? height * (right - left) / (x1 - x0) : height;
      const double inside = part * (k + 1.0 - 0.5 * (left + right)); // area right of the edge within pixel k
      sums_[at(row, k)] += inside + before;
      before = part - inside;
    }
    sums_[at(row, last + 1)] += before;
  }

  int x_, y_, width_, height_;
  std::vector<double> sums_{};
};

} // namespace

void Canvas::blend(std::uint32_t x, std::uint32_t y, const glm::dvec3& color, double alpha) {
  glm::vec4& p = layer_.pixels[std::size_t{y} * layer_.size.width + x];
  const auto a = static_cast<float>(std::clamp(alpha, 0.0, 1.0));
  p = glm::vec4(glm::vec3(color) * a, a) + p * (1.0f - a);
}

void Canvas::fill(const Path& path, const glm::dvec3& color, double alpha) {
  glm::dvec2 low(1e9), high(-1e9);
  for (const auto& contour : path)
    for (const glm::dvec2& p : contour) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  const int x0 = static_cast<int>(std::max(0.0, std::floor(low.x))), y0 = static_cast<int>(std::max(0.0, std::floor(low.y)));
  const int x1 = static_cast<int>(std::min<double>(layer_.size.width, std::ceil(high.x)));
  const int y1 = static_cast<int>(std::min<double>(layer_.size.height, std::ceil(high.y)));
  if (x1 <= x0 || y1 <= y0) return;
  Coverage coverage(x0, y0, x1 - x0, y1 - y0);
  for (const auto& contour : path)
    for (std::size_t i = 0; i < contour.size(); ++i) coverage.edge(contour[i], contour[(i + 1) % contour.size()]);
  coverage.each([&](int x, int y, double covered) { blend(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), color, alpha * covered); });
}

void Canvas::rectangle(const glm::dvec2& low, const glm::dvec2& high, const glm::dvec3& color, double alpha) {
  fill({{low, {high.x, low.y}, high, {low.x, high.y}}}, color, alpha);
}

} // namespace mote::overlay
