// SPDX-License-Identifier: MIT
// Transforms that tests of placements are made of; angles in radians.
#pragma once

#include <glm/gtc/matrix_transform.hpp>

namespace mote::test {

inline glm::dmat4 scaled(double x, double y, double z) { return glm::scale(glm::dmat4(1.0), glm::dvec3(x, y, z)); }
inline glm::dmat4 turned(double angle, const glm::dvec3& axis) { return glm::rotate(glm::dmat4(1.0), angle, glm::normalize(axis)); }
inline glm::dmat4 moved(double x, double y, double z) { return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z)); }
inline glm::dmat4 sheared() {
  glm::dmat4 m(1.0);
  m[1][0] = 0.8; // x grows by 0.8 y
  m[0][2] = -0.4;
  return m;
}
// Turn, stretch, turn.
inline glm::dmat4 stretched() { return turned(0.6, {1, 2, 3}) * scaled(1.5, 1.0, 0.4) * turned(1.1, {0, 1, 1}); }
// Sheared, too: nothing is left of a similarity.
inline glm::dmat4 general() { return scaled(-1, 1, 1) * sheared() * stretched(); }

} // namespace mote::test
