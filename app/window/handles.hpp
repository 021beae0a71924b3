// SPDX-License-Identifier: MIT
// The gizmo's handles on the screen: lines that a hand can take, which one it takes, and their picture. Drawn on the processor
// like all texts of the window, so they are there in a build without panels, too. Pure.
#pragma once

#include "app/window/gizmo.hpp"
#include "app/window/presenter.hpp"

#include <optional>
#include <vector>

namespace mote::window {

enum class GizmoPart : std::uint8_t { X, Y, Z, Both }; // an axis, or the middle: both of the mouse's directions

inline constexpr double handle_pixels = 80.0; // of a usual display

struct GizmoStroke {
  GizmoPart part{};
  std::vector<glm::dvec2> points{}; // pixels; an open line
  bool ends_in_arrow{}, ends_in_box{};
};
// An axis each: arrows (Move), rings (Turn), lines with a box at their end (Scale), about 80 pixels of a usual display long where they
// lie across the view; and a box in the middle. Empty where the pivot is not before the eye. `scale`: of the display (HiDPI).
std::vector<GizmoStroke> gizmo_strokes(GizmoMode mode, const View& view, const glm::dvec3& pivot, double scale);

// The part that a press at (x, y) takes: within a few pixels, the middle before the axes.
std::optional<GizmoPart> gizmo_part_at(const std::vector<GizmoStroke>& strokes, double x, double y, double scale);

// A square about the pivot's pixel; red, green and blue axes, the `lit` part bright. Empty without strokes.
FlatPicture gizmo_picture(const std::vector<GizmoStroke>& strokes, std::optional<GizmoPart> lit, double scale);

} // namespace mote::window
