// SPDX-License-Identifier: MIT
#include "app/window/handles.hpp"

#include "app/window/hud.hpp"
#include "core/overlay/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::window {
namespace {

constexpr double middle_half = 6.0, end_half = 4.5, arrow = 11.0, line_width = 2.5; // pixels of a usual display
constexpr double grab = 7.0, square_half = 100.0;
constexpr int ring_points = 64;

double distance_to(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 d = b - a;
  const double length = glm::dot(d, d), t = length > 0.0 ? std::clamp(glm::dot(p - a, d) / length, 0.0, 1.0) : 0.0;
  return glm::length(p - a - t * d);
}

glm::dvec3 color_of(GizmoPart part, bool lit) {
  constexpr std::array<glm::dvec3, 4> colors{{{0.85, 0.06, 0.06}, {0.07, 0.55, 0.07}, {0.08, 0.2, 0.9}, {0.55, 0.55, 0.55}}};
  return lit ? glm::dvec3(1.0, 0.75, 0.05) : colors[static_cast<std::size_t>(part)];
}

// A line of constant width with round ends, coverage by distance.
void draw_line(overlay::Canvas& canvas, const glm::dvec2& a, const glm::dvec2& b, double width, const glm::dvec3& color) {
  const double half = 0.5 * width;
  const auto range = [&](int k, std::uint32_t size) {
    const auto low = std::clamp(std::floor(std::min(a[k], b[k]) - half - 1.0), 0.0, static_cast<double>(size));
    const auto high = std::clamp(std::ceil(std::max(a[k], b[k]) + half + 1.0), 0.0, static_cast<double>(size));
    return std::pair(static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high));
  };
  const auto [left, right] = range(0, canvas.size().width);
  const auto [top, bottom] = range(1, canvas.size().height);
  for (std::uint32_t y = top; y < bottom; ++y)
    for (std::uint32_t x = left; x < right; ++x)
      if (const double covered = std::clamp(half + 0.5 - distance_to({x + 0.5, y + 0.5}, a, b), 0.0, 1.0); covered > 0.0) canvas.blend(x, y, color, covered);
}

void draw_stroke(overlay::Canvas& canvas, const GizmoStroke& stroke, const glm::dvec2& corner, const glm::dvec3& color, double width, double scale) {
  for (std::size_t i = 0; i + 1 < stroke.points.size(); ++i) draw_line(canvas, stroke.points[i] - corner, stroke.points[i + 1] - corner, width, color);
  const glm::dvec2 end = stroke.points.back() - corner;
  if (stroke.ends_in_box) {
    const double half = (stroke.part == GizmoPart::Both ? middle_half : end_half) * scale;
    canvas.rectangle(end - half, end + half, color, 1.0);
  }
  const glm::dvec2 along = end - (stroke.points.front() - corner);
  if (!stroke.ends_in_arrow || glm::length(along) < 1.0) return;
  const glm::dvec2 forward = along / glm::length(along) * arrow * scale, side(-forward.y * 0.45, forward.x * 0.45);
  canvas.fill({{end + forward * 0.6, end - forward * 0.4 + side, end - forward * 0.4 - side}}, color);
}

GizmoStroke ring(GizmoPart part, int axis, const View& view, const glm::dvec3& pivot, double radius) {
  GizmoStroke out{.part = part};
  for (int i = 0; i <= ring_points; ++i) {
    const double a = glm::radians(360.0 * i / ring_points);
    out.points.push_back(pixel_of(view, pivot) + pixels_along(view, pivot, (std::cos(a) * axis_unit((axis + 1) % 3) + std::sin(a) * axis_unit((axis + 2) % 3)) * radius));
  }
  return out;
}

} // namespace

std::vector<GizmoStroke> gizmo_strokes(GizmoMode mode, const View& view, const glm::dvec3& pivot, double scale) {
  std::vector<GizmoStroke> out;
  if (view.projection == Projection::Perspective && !(view.to_view(pivot).z > view.depth_near)) return out;
  const glm::dvec2 middle = pixel_of(view, pivot);
  if (!(std::abs(middle.x) < 1e6) || !(std::abs(middle.y) < 1e6)) return out;
  const double length = gizmo_length(view, pivot, handle_pixels * scale);
  for (int axis = 0; axis < 3; ++axis) {
    const auto part = static_cast<GizmoPart>(axis);
    if (mode == GizmoMode::Turn) out.push_back(ring(part, axis, view, pivot, length));
    else out.push_back({part, {middle, middle + pixels_along(view, pivot, axis_unit(axis) * length)}, mode == GizmoMode::Move, mode == GizmoMode::Scale});
  }
  out.push_back({.part = GizmoPart::Both, .points = {middle}, .ends_in_box = true});
  return out;
}

std::optional<GizmoPart> gizmo_part_at(const std::vector<GizmoStroke>& strokes, double x, double y, double scale) {
  std::optional<GizmoPart> best;
  double nearest = grab * scale;
  for (const GizmoStroke& stroke : strokes) {
    if (stroke.part == GizmoPart::Both) {
      const glm::dvec2 d = glm::abs(glm::dvec2(x, y) - stroke.points[0]);
      if (std::max(d.x, d.y) <= (middle_half + 2.0) * scale) return GizmoPart::Both;
    }
    for (std::size_t i = 0; i + 1 < stroke.points.size(); ++i) {
      const double d = distance_to({x, y}, stroke.points[i], stroke.points[i + 1]);
      if (d >= nearest) continue;
      nearest = d;
      best = stroke.part;
    }
  }
  return best;
}

FlatPicture gizmo_picture(const std::vector<GizmoStroke>& strokes, std::optional<GizmoPart> lit, double scale) {
  FlatPicture out;
  if (strokes.empty()) return out;
  const auto side = static_cast<std::uint32_t>(2.0 * std::ceil(square_half * scale));
  const glm::dvec2 corner = glm::floor(strokes.back().points[0]) - 0.5 * side;
  overlay::Canvas canvas({side, side});
  for (const double rim : {2.0, 0.0}) // dark below, so that the lines are seen on any ground
    for (const GizmoStroke& stroke : strokes)
      draw_stroke(canvas, stroke, corner, rim > 0.0 ? glm::dvec3(0.01) : color_of(stroke.part, lit == stroke.part), (line_width + rim) * scale, scale * (rim > 0.0 ? 1.2 : 1.0));
  out.size = canvas.size();
  out.rgba = displayed(canvas.take());
  out.x = static_cast<std::int32_t>(corner.x);
  out.y = static_cast<std::int32_t>(corner.y);
  return out;
}

} // namespace mote::window
