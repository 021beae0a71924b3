// SPDX-License-Identifier: MIT
// The view that a light's shadow map is drawn from: pure, double precision, no device.
//
// A map is fitted to what the camera sees: its frustum cut with the scene's bounds, turned about the
// light's axis so that most texels are used. Everything between the light and that region is kept as
// a caster; what lies behind it is left out by far_cut. The result is an ordinary View, so that
// placement, culling, expansions and intersections need nothing of their own for lights.
#pragma once

#include "core/scene/scene.hpp"

#include <optional>
#include <vector>

namespace mote::passes {

// Of a spot light that a perspective map can hold: its outer angle, radians from the axis.
constexpr double widest_spot = 1.3962634015954636; // 80 degrees

// Corners of the part of `bounds` that the camera sees, relative to the camera's eye, world axes. Empty: it sees none.
std::vector<glm::dvec3> seen_corners(const Bounds& bounds, const View& camera);

// A directional light and a head light give an orthographic view, a spot light a perspective one. A border of four
// texels on each side stays free, so that neighbors of every looked-up texel exist. Nothing: the light reaches
// nothing that is seen, or a light of another kind. Precondition for spots: outer_angle <= widest_spot.
std::optional<View> light_view(const Bounds& bounds, const View& camera, const Light& light, Size2d map);

} // namespace mote::passes
