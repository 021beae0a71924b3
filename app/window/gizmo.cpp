// SPDX-License-Identifier: MIT
#include "app/window/gizmo.hpp"

#include "app/window/camera_control.hpp"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace mote::window {
namespace {

constexpr double pixels_a_quarter_turn = 200.0, pixels_to_double = 100.0;
constexpr double least_factor = 0.01, largest_factor = 100.0; // of one drag
constexpr double fine_pixel = 0.01, fine_degree = 0.01, fine_factor = 1e-4; // what drags are rounded to

// The way along an axis for which the screen moves as far as the mouse did.
double along(const glm::dvec2& pixels, double mouse, int component) {
  const double length = pixels[component];
  return std::abs(length) > 1e-9 ? mouse / length : 0.0;
}

glm::dmat4 about(const glm::dvec3& pivot, const glm::dmat4& m) { return glm::translate(glm::dmat4(1.0), pivot) * m * glm::translate(glm::dmat4(1.0), -pivot); }

double rounded(double value, double step) {
  const double number = std::round(value / step), out = step < 1.0 ? number / std::round(1.0 / step) : number * step;
  return std::isfinite(out) ? out : 0.0;
}

// A power of ten that is below a hundredth of a pixel at the pivot.
double step_of(const View& view, const glm::dvec3& pivot) {
  const double z = view.projection == Projection::Perspective ? std::max(std::abs(view.to_view(pivot).z), 1e-12) : 1.0;
  return std::pow(10.0, std::floor(std::log10(fine_pixel * z / view.focal)));
}

double factor_of(double pixels) { return rounded(std::clamp(std::exp2(pixels / pixels_to_double), least_factor, largest_factor), fine_factor); }

GizmoChange change_of(GizmoMode mode, const ScreenAxes& axes, const glm::dvec3& pivot, double dx, double dy, bool uniform) {
  GizmoChange out{.mode = mode, .pivot = pivot};
  if (mode == GizmoMode::Move) {
    out.shift = axis_unit(axes.x) * along(axes.pixels_x, dx, 0) + axis_unit(axes.y) * along(axes.pixels_y, dy, 1);
  } else if (mode == GizmoMode::Turn) {
    const double a_pixel = 90.0 / pixels_a_quarter_turn;
    // The front of the thing goes with the mouse: signs by which way the axes point on the screen.
    const double sign_y = axes.pixels_y.y > 0.0 ? -1.0 : 1.0, sign_x = axes.pixels_x.x < 0.0 ? 1.0 : -1.0;
    out.turns = {{{axes.x, -sign_x * dy * a_pixel}, {axes.y, sign_y * dx * a_pixel}}};
  } else if (uniform) {
    out.factors = glm::dvec3(factor_of(dx));
  } else {
    out.factors[axes.x] = factor_of(dx);
    out.factors[axes.y] = factor_of(-dy);
  }
  return out;
}

// The point of a ring about an axis that is seen nearest to a pixel.
glm::dvec3 ring_point(int axis, const View& view, const glm::dvec3& pivot, double radius, const glm::dvec2& from) {
  const glm::dvec3 one = axis_unit((axis + 1) % 3), other = axis_unit((axis + 2) % 3);
  const glm::dvec2 middle = pixel_of(view, pivot);
  glm::dvec3 best = pivot;
  double nearest = 1e300;
  for (int i = 0; i < 360; ++i) {
    const double a = glm::radians(static_cast<double>(i));
    const glm::dvec3 arm = (std::cos(a) * one + std::sin(a) * other) * radius;
    const double behind = (view.rotation * arm).z / radius * 1e-6; // of two that are seen at one place, the one before
    const double distance = glm::length(pixels_along(view, pivot, arm) + middle - from) + behind;
    if (distance >= nearest) continue;
    nearest = distance;
    best = pivot + arm;
  }
  return best;
}

GizmoChange made_legible(GizmoChange change, const View& view) {
  const double step = step_of(view, change.pivot);
  for (int k = 0; k < 3; ++k) {
    change.shift[k] = rounded(change.shift[k], step);
    change.pivot[k] = rounded(change.pivot[k], step);
  }
  for (auto& turn : change.turns) turn.degrees = rounded(turn.degrees, fine_degree);
  if (change.turns[0].degrees == 0.0) std::swap(change.turns[0], change.turns[1]);
  return change;
}

} // namespace

glm::dvec3 axis_unit(int axis) {
  glm::dvec3 v(0);
  v[axis] = 1.0;
  return v;
}

glm::dvec2 pixel_of(const View& view, const glm::dvec3& world) {
  const glm::dvec3 p = view.to_view(world);
  return glm::dvec2(p) * (view.projection == Projection::Perspective ? view.focal / p.z : view.focal) + view.center();
}

// The derivative of the pixel under a point.
glm::dvec2 pixels_along(const View& view, const glm::dvec3& point, const glm::dvec3& direction) {
  const glm::dvec3 p = view.to_view(point), d = view.rotation * direction;
  if (view.projection == Projection::Orthographic) return glm::dvec2(d) * view.focal;
  const double z = std::max(p.z, 1e-12);
  return (glm::dvec2(d) - glm::dvec2(p) * (d.z / z)) * (view.focal / z);
}

ScreenAxes screen_axes(const View& view, const glm::dvec3& pivot) {
  std::array<glm::dvec2, 3> pixels;
  for (int a = 0; a < 3; ++a) pixels[static_cast<std::size_t>(a)] = pixels_along(view, pivot, axis_unit(a));
  const auto pixels_of = [&](int a) { return pixels[static_cast<std::size_t>(a)]; };
  ScreenAxes best;
  double most = -1.0;
  for (int x = 0; x < 3; ++x) // the pair that has most to say
    for (int y = 0; y < 3; ++y) {
      const double size = std::abs(pixels_of(x).x) + std::abs(pixels_of(y).y);
      if (x == y || size <= most) continue;
      most = size;
      best = {x, y, pixels_of(x), pixels_of(y)};
    }
  return best;
}

bool GizmoChange::nothing() const { return shift == glm::dvec3(0) && turns[0].degrees == 0.0 && turns[1].degrees == 0.0 && factors == glm::dvec3(1); }

glm::dmat4 GizmoChange::matrix() const {
  const glm::dmat4 one(1.0);
  if (mode == GizmoMode::Move) return glm::translate(one, shift);
  if (mode == GizmoMode::Scale) return about(pivot, glm::scale(one, factors));
  const auto turned = [&](const AxisTurn& turn) { return glm::rotate(one, glm::radians(turn.degrees), axis_unit(turn.axis)); };
  return about(pivot, turned(turns[1]) * turned(turns[0]));
}

std::string GizmoChange::steps() const {
  if (nothing()) return {};
  if (mode == GizmoMode::Move) return fmt::format("{{ translate = {} }}", toml_vector(shift));
  if (mode == GizmoMode::Scale) return transform_step(matrix());
  std::string out;
  for (const AxisTurn& turn : turns)
    if (turn.degrees != 0.0)
      out += fmt::format("{}{{ rotate = {{ axis = {}, angle = {}, through = {} }} }}", out.empty() ? "" : ", ", toml_vector(axis_unit(turn.axis)), toml_number(turn.degrees), toml_vector(pivot));
  return out;
}

GizmoChange gizmo_change(GizmoMode mode, const View& view, const glm::dvec3& pivot, double dx, double dy, bool uniform) {
  return made_legible(change_of(mode, screen_axes(view, pivot), pivot, dx, dy, uniform), view);
}

GizmoChange gizmo_change_along(GizmoMode mode, int axis, const View& view, const glm::dvec3& pivot, double ring, const glm::dvec2& from, double dx, double dy) {
  GizmoChange out{.mode = mode, .pivot = pivot};
  const glm::dvec2 mouse(dx, dy), line = pixels_along(view, pivot, axis_unit(axis));
  const double length = glm::length(line);
  if (mode == GizmoMode::Turn) {
    const glm::dvec3 grabbed = ring_point(axis, view, pivot, ring, from);
    const glm::dvec2 way = pixels_along(view, pivot, glm::cross(axis_unit(axis), grabbed - pivot)); // a radian
    const double size = glm::dot(way, way);
    out.turns[0] = {axis, size > 1e-12 ? glm::degrees(glm::dot(mouse, way) / size) : 0.0};
  } else if (mode == GizmoMode::Move) {
    out.shift[axis] = length > 1e-9 ? glm::dot(mouse, line) / (length * length) : 0.0;
  } else {
    out.factors[axis] = length > 1e-9 ? factor_of(glm::dot(mouse, line) / length) : 1.0;
  }
  return made_legible(out, view);
}

double gizmo_length(const View& view, const glm::dvec3& pivot, double pixels) {
  double longest = 1e-12;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, glm::length(pixels_along(view, pivot, axis_unit(axis))));
  return pixels / longest;
}

std::string transform_step(const glm::dmat4& m) {
  std::string rows;
  for (int row = 0; row < 3; ++row)
    rows += fmt::format("{}[{}, {}, {}, {}]", row ? ", " : "", toml_number(m[0][row]), toml_number(m[1][row]), toml_number(m[2][row]), toml_number(m[3][row]));
  return "{ matrix = [" + rows + "] }";
}

} // namespace mote::window
