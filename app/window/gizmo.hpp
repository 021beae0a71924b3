// SPDX-License-Identifier: MIT
// What a drag of the mouse does to a thing in the world: moves, turns or scales it along world axes. Pure. The mouse's x and y
// each go with the world axis that is largest on the screen in that direction (at the thing's place), so that the thing goes
// where the mouse goes and stays on the axes; or the drag holds one axis. One module for data sets, lights, planes and boxes.
#pragma once

#include "core/math/camera.hpp"

#include <array>
#include <cstdint>
#include <string>

namespace mote::window {

enum class GizmoMode : std::uint8_t { Move, Turn, Scale };

// World axes by direction on the screen.
struct ScreenAxes {
  int x{}, y{};                             // axis that goes with the mouse's x, and another with its y
  glm::dvec2 pixels_x{0}, pixels_y{0};      // where a unit along them goes on the screen, pixels, y down
};
// At a point that the view shows; an axis that points to the eye has no length on the screen.
ScreenAxes screen_axes(const View& view, const glm::dvec3& pivot);
// The pixel of a point of the world; meaningless for points behind the eye.
glm::dvec2 pixel_of(const View& view, const glm::dvec3& world);
// Where a unit along a direction of the world goes on the screen, at a point: pixels, y down.
glm::dvec2 pixels_along(const View& view, const glm::dvec3& point, const glm::dvec3& direction);
glm::dvec3 axis_unit(int axis);

// What a drag asks for, about a pivot. Numbers are rounded to what a hand can mean, so that files stay legible.
struct GizmoChange {
  GizmoMode mode{};
  glm::dvec3 pivot{0};
  glm::dvec3 shift{0};                      // Move: world
  struct AxisTurn {
    int axis{};
    double degrees{};
  };
  std::array<AxisTurn, 2> turns{};          // Turn: the first, then the second
  glm::dvec3 factors{1};                    // Scale: along the world axes

  [[nodiscard]] bool nothing() const;
  [[nodiscard]] glm::dmat4 matrix() const;  // world to world
  // As steps of a [[data]]'s transform: "{ translate = [1.5, 0.0, 0.0] }", "{ rotate = ... }, { rotate = ... }". Empty for nothing.
  [[nodiscard]] std::string steps() const;
};

// A drag by (dx, dy) pixels. Move: along the two axes, as far as the mouse on the screen. Turn: about the axis of y by dx, about
// the axis of x by dy; 200 pixels are a quarter turn. Scale: along the two axes by a factor, 100 pixels double; `uniform`: by dx, in
// all directions.
GizmoChange gizmo_change(GizmoMode mode, const View& view, const glm::dvec3& pivot, double dx, double dy, bool uniform = false);
// A drag that holds one axis. Move: along it, as far as the mouse went along its line on the screen; Scale: the same way; Turn: about it,
// what was grabbed at pixel `from` of a ring of this radius (world) goes with the mouse.
GizmoChange gizmo_change_along(GizmoMode mode, int axis, const View& view, const glm::dvec3& pivot, double ring, const glm::dvec2& from, double dx, double dy);
// How long handles are in the world, so that the one that lies across the view is seen `pixels` long.
double gizmo_length(const View& view, const glm::dvec3& pivot, double pixels);

// "{ matrix = [[...], [...], [...]] }": a step of a [[data]]'s transform.
std::string transform_step(const glm::dmat4& world_from_world);

} // namespace mote::window
