// SPDX-License-Identifier: MIT
// The double-precision twins of the particle types: per type name, the bounds of a record and the
// interval in which a ray is inside the particle. The table in shapes.cpp is what a new particle type adds a
// line to so that the reference can draw it; the tracer knows nothing of spheres.
//
// Everything here lives in the data set's own space and reads the record as stored (float32
// relative to its chunk's origin), widened to double. Nothing is shared with the shaders.
//
// Records: r[0] = (center, radius of a bounding sphere) and
//   sphere        r[0].w is its radius
//   capsule       r[1] = (h, radius): all points within the radius of the segment center - h .. center + h
//   cylinder      r[1] = (h, radius at center - h), r[2] = (radius at center + h, ends, 0, 0); ends 0: disks close it;
//                 1: open, a surface with two faces whose normal is turned to the ray
//   cone          r[1] = (h, radius at center - h), r[2] = (radius at center + h, 0, 0, 0); disks close it
//   arrow         r[1] = (h, shaft radius), r[2] = (head radius, head length, 0, 0), from center - h to the tip center + h
//   ellipsoid     r[1] = quaternion (x, y, z, w), r[2] = (semi-axes, 0)
//   box           r[1] = quaternion, r[2] = (half extents, 0)
//   polyline      r[1] = (h, radius), r[2] = (n, 0), r[3] = (n, 0): a capsule of which the part before the plane through
//                 center - h with normal r[2], and behind the one through center + h with normal r[3], belongs to neighbors; n = 0: all
//                 of it. Where a plane ends it there is no surface. r[2] or r[3] = (h, radius > 0): no plane, but the neighbor
//                 there, with which a transparent one is one body: see `united`
//   superquadric  r[1] = quaternion, r[2] = (semi-axes, 0), r[3] = (e1, e2, 0, 0)
// A quaternion turns the solid's axes into the data set's and counts by its direction alone. A solid without
// extent (no radius, an axis of length 0, but for the capsule without length, which is a sphere) is never met.
#pragma once

#include "core/math/camera.hpp"
#include "core/scene/chunks.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::reference {

struct Ray {
  glm::dvec3 origin{0}, direction{0, 0, 1}; // any length; the parameter t counts in it
};

// One record, widened: its bounding sphere and all of its vec4s.
struct Particle {
  glm::dvec3 center{0};
  double radius{};
  std::span<const glm::vec4> record{};
};
Particle particle(const ChunkSet& chunks, std::uint64_t record);

struct Interval {
  double t_in{}, t_out{}; // t_in <= t_out; either sign
  bool inner_in{}, inner_out{}; // that end lies within a neighbor of one body (polyline): no surface
};

struct Shape {
  std::string_view type;
  Bounds (*bounds)(const Particle&);
  // The part of the line (any t) inside the particle, from the first entry to the last exit (the arrow is the one
  // that is not convex); nullopt: missed.
  std::optional<Interval> (*intersect)(const Particle&, const Ray&);
  // Outward normal, unit, where the ray enters (exit = false) or leaves. Only after intersect() hit.
  glm::dvec3 (*normal)(const Particle&, const Ray&, bool exit);
  // About the smallest radius of curvature, for the bar on normals.
  double (*curvature)(const Particle&);
  // As intersect(), of a transparent particle that makes one body with neighbors that it overlaps: without what is theirs. What is within two
  // of them belongs to the one that the ray enters first. nullptr: the same as intersect().
  std::optional<Interval> (*united)(const Particle&, const Ray&){};
};

const Shape* find_shape(std::string_view type); // nullptr: not known
std::vector<std::string> shape_types();

} // namespace mote::reference
