// SPDX-License-Identifier: MIT
#include "core/reference/shapes.hpp"

#include "core/reference/shapes_local.hpp"

#include <array>
#include <cmath>

namespace mote::reference {

namespace {

// The ray point closest to the center, relative to it, and half the chord: the form that stays accurate
// however far away the eye is (the offset from the center is taken first, and once).
struct Chord {
  double s{};      // parameter of the closest point
  glm::dvec3 l{0}; // closest point minus center
  double h2{};     // (half the chord in t) squared; negative: missed
};

Chord chord(const Particle& p, const Ray& ray) {
  const glm::dvec3 m = p.center - ray.origin;
  const double dd = glm::dot(ray.direction, ray.direction);
  Chord c;
  c.s = glm::dot(m, ray.direction) / dd;
  c.l = c.s * ray.direction - m;
  const double distance = glm::length(c.l);
  c.h2 = (p.radius - distance) * (p.radius + distance) / dd;
  return c;
}

Bounds sphere_bounds(const Particle& p) {
  Bounds b;
  b.add(p.center, p.radius);
  return b;
}

std::optional<Interval> sphere_intersect(const Particle& p, const Ray& ray) {
  const Chord c = chord(p, ray);
  if (!(c.h2 >= 0.0)) return std::nullopt;
  const double h = std::sqrt(c.h2);
  return Interval{c.s - h, c.s + h};
}

glm::dvec3 sphere_normal(const Particle& p, const Ray& ray, bool exit) {
  const Chord c = chord(p, ray);
  const double h = std::sqrt(std::max(0.0, c.h2));
  return glm::normalize(c.l + (exit ? h : -h) * ray.direction);
}

double sphere_curvature(const Particle& p) { return p.radius; }

constexpr Shape sphere_shape{"sphere", sphere_bounds, sphere_intersect, sphere_normal, sphere_curvature};

// A new type's row is added here.
constexpr std::array<const Shape*, 9> shapes{&sphere_shape,    &capsule_shape, &cylinder_shape, &cone_shape, &arrow_shape,
                                             &ellipsoid_shape, &box_shape,     &superquadric_shape, &polyline_shape};

} // namespace

Particle particle(const ChunkSet& chunks, std::uint64_t record) {
  const glm::vec4* first = &chunks.records[record * chunks.vec4s_per_record];
  return {chunks.center(record), double(first->w), {first, chunks.vec4s_per_record}};
}

const Shape* find_shape(std::string_view type) {
  for (const Shape* shape : shapes)
    if (shape->type == type) return shape;
  return nullptr;
}

std::vector<std::string> shape_types() {
  std::vector<std::string> names;
  for (const Shape* shape : shapes) names.emplace_back(shape->type);
  return names;
}

} // namespace mote::reference
