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

// Derivative of the pixel under a point along a direction of the world.
glm::dvec2 on_screen(const View& view, const glm::dvec3& point, const glm::dvec3& direction) {
  const glm::dvec3 p = view.to_view(point), d = view.rotation * direction;
  if (view.projection == Projection::Orthographic) return glm::dvec2(d) * view.focal;
  const double z = std::max(p.z, 1e-12);
  return (glm::dvec2(d) - glm::dvec2(p) * (d.z / z)) * (view.focal / z);
}

glm::dvec3 unit(int axis) {
  glm::dvec3 v(0);
  v[axis] = 1.0;
  return v;
}

// The way along an axis for which the screen moves as far as the mouse did.
double along(const glm::dvec2& pixels, double mouse, int component) {
  const double length = pixels[component];
  return std::abs(length) > 1e-9 ? mouse / length : 0.0;
}

glm::dmat4 about(const glm::dvec3& pivot, const glm::dmat4& m) { return glm::translate(glm::dmat4(1.0), pivot) * m * glm::translate(glm::dmat4(1.0), -pivot); }

} // namespace

ScreenAxes screen_axes(const View& view, const glm::dvec3& pivot) {
  std::array<glm::dvec2, 3> pixels;
  for (int a = 0; a < 3; ++a) pixels[static_cast<std::size_t>(a)] = on_screen(view, pivot, unit(a));
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

glm::dmat4 gizmo_drag(GizmoMode mode, const ScreenAxes& axes, const glm::dvec3& pivot, double dx, double dy, bool uniform) {
  const glm::dmat4 one(1.0);
  if (mode == GizmoMode::Move)
    return glm::translate(one, unit(axes.x) * along(axes.pixels_x, dx, 0) + unit(axes.y) * along(axes.pixels_y, dy, 1));
  if (mode == GizmoMode::Turn) {
    const double a_pixel = glm::radians(90.0) / pixels_a_quarter_turn;
    // The front of the thing goes with the mouse: signs by which way the axes point on the screen.
    const double sign_y = axes.pixels_y.y > 0.0 ? -1.0 : 1.0, sign_x = axes.pixels_x.x < 0.0 ? 1.0 : -1.0;
    return about(pivot, glm::rotate(one, sign_y * dx * a_pixel, unit(axes.y)) * glm::rotate(one, -sign_x * dy * a_pixel, unit(axes.x)));
  }
  const double across = std::exp2(dx / pixels_to_double), down = std::exp2(-dy / pixels_to_double);
  if (uniform) return about(pivot, glm::scale(one, glm::dvec3(across)));
  glm::dvec3 factors(1.0);
  factors[axes.x] = across;
  factors[axes.y] = down;
  return about(pivot, glm::scale(one, factors));
}

std::string transform_step(const glm::dmat4& m) {
  std::string rows;
  for (int row = 0; row < 3; ++row)
    rows += fmt::format("{}[{}, {}, {}, {}]", row ? ", " : "", toml_number(m[0][row]), toml_number(m[1][row]), toml_number(m[2][row]), toml_number(m[3][row]));
  return "{ matrix = [" + rows + "] }";
}

} // namespace mote::window
