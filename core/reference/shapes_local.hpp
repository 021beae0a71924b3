// SPDX-License-Identifier: MIT
// What the families of shapes (shapes_*.cpp) share: the ray moved to the point nearest to a particle's
// center, frames of axes and quaternions, and the table rows that shapes.cpp collects. Private to
// core/reference; nothing here is shared with the shaders.
//
// The offset from the center is taken first and once; all that follows has the size of the particle, so that
// errors do not grow with the distance of the eye beyond that of the subtraction itself.
#pragma once

#include "core/reference/shapes.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>

namespace mote::reference {

// A ray seen from a center: point(t) = l + (t - t_l) d.
struct Nearest {
  glm::dvec3 l{0}; // the ray's point nearest to the center, relative to it
  double t{};      // its parameter
};

// `offset`: the ray's origin minus the center. Two steps: the second takes away what the first left along d.
inline Nearest nearest(const glm::dvec3& offset, const glm::dvec3& d) {
  const double dd = glm::dot(d, d);
  const double s = -glm::dot(offset, d) / dd;
  glm::dvec3 l(std::fma(s, d.x, offset.x), std::fma(s, d.y, offset.y), std::fma(s, d.z, offset.z));
  const double e = glm::dot(l, d) / dd;
  l = {std::fma(-e, d.x, l.x), std::fma(-e, d.y, l.y), std::fma(-e, d.z, l.z)};
  return {l, s - e};
}

// Orthonormal columns; the third is the direction of h. A zero h gets the axes of space.
struct AxisFrame {
  glm::dmat3 axes{1};
  double half{}; // |h|
};
inline AxisFrame axis_frame(const glm::dvec3& h) {
  AxisFrame frame;
  frame.half = glm::length(h);
  if (!(frame.half > 0.0)) return frame;
  const glm::dvec3 z = h / frame.half, a = glm::abs(z);
  const glm::dvec3 least = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                           : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                    : glm::dvec3(0, 0, 1);
  const glm::dvec3 x = glm::normalize(glm::cross(least, z));
  frame.axes = glm::dmat3(x, glm::cross(z, x), z);
  return frame;
}

// Rotation by the direction of a quaternion (x, y, z, w); its length does not matter.
inline glm::dmat3 rotation_of(const glm::vec4& q) {
  return glm::mat3_cast(glm::normalize(glm::dquat(double(q.w), double(q.x), double(q.y), double(q.z))));
}

// v in the frame of orthonormal columns.
inline glm::dvec3 into(const glm::dmat3& axes, const glm::dvec3& v) { return glm::transpose(axes) * v; }

inline glm::dvec3 xyz(const Particle& p, std::size_t i) { return glm::dvec3(p.record[i]); }

inline Bounds box_around(const glm::dvec3& center, const glm::dvec3& half) {
  Bounds b;
  b.add(center - half);
  b.add(center + half);
  return b;
}

// Rows of the table, by family.
extern const Shape capsule_shape, cylinder_shape, cone_shape, arrow_shape, polyline_shape; // shapes_axial.cpp
extern const Shape ellipsoid_shape, box_shape, superquadric_shape;           // shapes_oriented.cpp, shapes_superquadric.cpp

} // namespace mote::reference
