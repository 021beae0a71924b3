// SPDX-License-Identifier: MIT
// The shape that a linear map makes of the unit sphere: an ellipsoid with three orthogonal half axes.
// Placement of particles under a general affine transform uses it (a sphere has no orientation of its
// own, so only the image matters), and the scene refuses maps that flatten it.
#pragma once

#include <glm/glm.hpp>

namespace mote {

// linear * (unit ball) = { axes * (lengths * w) : |w| <= 1 }.
struct PrincipalAxes {
  glm::dmat3 axes{1};    // columns: orthonormal, right-handed
  glm::dvec3 lengths{1}; // >= 0, in no order
  [[nodiscard]] double longest() const { return glm::max(lengths.x, glm::max(lengths.y, lengths.z)); }
  [[nodiscard]] double shortest() const { return glm::min(lengths.x, glm::min(lengths.y, lengths.z)); }
};

// One-sided Jacobi (Hestenes 1958): columns are turned until they are orthogonal, so even lengths that differ by many
// orders of magnitude come out with full relative precision. A zero length has an arbitrary axis.
PrincipalAxes principal_axes(const glm::dmat3& linear);

} // namespace mote
