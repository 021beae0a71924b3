// SPDX-License-Identifier: MIT
// What a drag of the mouse does to a thing in the world: moves, turns or scales it along world axes. Pure. The mouse's x and y
// each go with the world axis that is largest on the screen in that direction (at the thing's place), so that the thing goes
// where the mouse goes and stays on the axes. One module for data sets, planes and boxes.
#pragma once

#include "core/math/camera.hpp"

#include <array>
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

// World to world: what a drag by (dx, dy) pixels does to a thing about `pivot`. Move: along the two axes, as far as the mouse
// on the screen. Turn: about the axis of y by dx, about the axis of x by dy; 200 pixels are a quarter turn. Scale: along the two
// axes by a factor, 100 pixels double; `uniform`: by dx, in all directions.
glm::dmat4 gizmo_drag(GizmoMode mode, const ScreenAxes& axes, const glm::dvec3& pivot, double dx, double dy, bool uniform = false);

// "{ matrix = [[...], [...], [...]] }": a step of a [[data]]'s transform.
std::string transform_step(const glm::dmat4& world_from_world);

} // namespace mote::window
