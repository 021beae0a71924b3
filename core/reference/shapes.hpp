// SPDX-License-Identifier: MIT
// The double-precision twins of the particle types: per type name, the bounds of a record and the
// interval in which a ray is inside the particle. This is the one table a new particle type adds a
// line to so that the reference can draw it; the tracer knows nothing of spheres.
//
// Everything here lives in the data set's own space and reads the record as stored (float32
// relative to its chunk's origin), widened to double. Nothing is shared with the shaders.
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
};

struct Shape {
  std::string_view type;
  Bounds (*bounds)(const Particle&);
  // The part of the line (any t) inside the convex particle; nullopt: missed.
  std::optional<Interval> (*intersect)(const Particle&, const Ray&);
  // Outward normal, unit, where the ray enters (exit = false) or leaves. Only after intersect() hit.
  glm::dvec3 (*normal)(const Particle&, const Ray&, bool exit);
};

const Shape* find_shape(std::string_view type); // nullptr: not known
std::vector<std::string> shape_types();

} // namespace mote::reference
