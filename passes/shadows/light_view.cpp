// SPDX-License-Identifier: MIT
#include "passes/shadows/light_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mote::passes {
namespace {

constexpr double border = 4.0; // texels on each side
constexpr int turns = 32;      // tried angles about the light's axis, over 90 degrees

struct Plane { // dot(normal, p) + offset >= 0 inside; p relative to the camera's eye, world axes
  glm::dvec3 normal{0};
  double offset{};
};

std::vector<Plane> planes_of(const Bounds& bounds, const View& camera) {
  std::vector<Plane> planes;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 n(0);
    n[axis] = 1.0;
    planes.push_back({n, camera.eye[axis] - bounds.min[axis]});
    planes.push_back({-n, bounds.max[axis] - camera.eye[axis]});
  }
  const glm::dmat3 world_from_view = glm::transpose(camera.rotation);
  const auto add = [&](glm::dvec3 n, double offset) {
    const double length = glm::length(n);
    planes.push_back({world_from_view * (n / length), offset / length});
  };
  // Of the whole picture, so that all its panels have one map. One pixel of slack: sample offsets and samples never leave it.
  const Size2d whole = camera.whole();
  const double hx = (0.5 * whole.width + 1.0) / camera.focal, hy = (0.5 * whole.height + 1.0) / camera.focal;
  const bool perspective = camera.projection == Projection::Perspective;
  for (const double side : {-1.0, 1.0}) {
    add(perspective ? glm::dvec3(side, 0, hx) : glm::dvec3(side, 0, 0), perspective ? 0.0 : hx);
    add(perspective ? glm::dvec3(0, side, hy) : glm::dvec3(0, side, 0), perspective ? 0.0 : hy);
  }
  add({0, 0, 1}, -camera.near_cut);
  if (camera.far_cut > 0) add({0, 0, -1}, camera.far_cut);
  return planes;
}

// Any two unit vectors that make a right-handed frame with a unit `forward`: (right, down, forward).
glm::dmat3 frame_about(const glm::dvec3& forward) {
  const glm::dvec3 other = std::abs(forward.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, other));
  return {right, glm::cross(forward, right), forward};
}
glm::dmat3 turned(const glm::dmat3& frame, int turn) {
  const double angle = turn * std::acos(0.0) / turns, c = std::cos(angle), s = std::sin(angle);
  return {frame[0] * c + frame[1] * s, frame[1] * c - frame[0] * s, frame[2]};
}

struct Rectangle {
  glm::dvec2 min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec2& p) { min = glm::min(min, p); max = glm::max(max, p); }
};

// Units (of the rectangle) a texel when `half` is the larger half extent that has to fit on each axis.
double texel_size(const glm::dvec2& half, Size2d map) {
  return std::max(half.x / std::max(0.5 * map.width - border, 0.5), half.y / std::max(0.5 * map.height - border, 0.5));
}

View view_of(const glm::dmat3& frame, const glm::dvec3& eye, double texel, Size2d map) {
  View view;
  view.eye = eye;
  view.rotation = glm::transpose(frame);
  view.size = map;
  view.focal = 1.0 / texel;
  return view;
}

std::optional<View> directional_view(const Bounds& bounds, const View& camera, const glm::dvec3& direction,
                                     const std::vector<glm::dvec3>& seen, Size2d map) {
  const glm::dmat3 straight = frame_about(direction);
  const double size = std::max(bounds.diagonal(), 1e-30);
  glm::dmat3 best(1);
  glm::dvec2 center(0);
  double texel = std::numeric_limits<double>::infinity();
  for (int k = 0; k < turns; ++k) {
    const glm::dmat3 frame = turned(straight, k);
    Rectangle r;
    for (const glm::dvec3& p : seen) r.add({glm::dot(p, frame[0]), glm::dot(p, frame[1])});
    const double t = texel_size(glm::max((r.max - r.min) * 0.5, glm::dvec2(1e-9 * size)), map);
    if (t < texel) texel = t, best = frame, center = (r.min + r.max) * 0.5;
  }
  // Casters: the scene up to the farthest thing seen. Its first corner lies a twentieth of the scene before the eye.
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y, i & 4 ? bounds.max.z : bounds.min.z);
    first = std::min(first, glm::dot(corner - camera.eye, direction));
  }
  for (const glm::dvec3& p : seen) last = std::max(last, glm::dot(p, direction));
  const double start = first - 0.05 * size;
  View view = view_of(best, camera.eye + best * glm::dvec3(center, start), texel, map);
  view.projection = Projection::Orthographic;
  view.depth_near = 0.025 * size;
  view.far_cut = last - start + 1e-6 * size;
  return view;
}

// What a spot light may reach of the seen corners, as a rectangle of tangents about its axis. Nothing: all outside.
std::optional<Rectangle> lit_tangents(const glm::dmat3& frame, double outer, const std::vector<glm::dvec3>& from_light) {
  const double half = std::tan(std::min(outer, widest_spot)) * (1.0 + 1e-6);
  Rectangle cone, seen;
  cone.add(glm::dvec2(-half));
  cone.add(glm::dvec2(half));
  if (std::all_of(from_light.begin(), from_light.end(), [&](const glm::dvec3& p) { return glm::dot(p, frame[2]) <= 0.0; })) return std::nullopt;
  for (const glm::dvec3& p : from_light) {
    const double z = glm::dot(p, frame[2]);
    if (!(z > 1e-3 * glm::length(p))) return cone; // the light stands among what is seen, or beside it
    seen.add(glm::dvec2(glm::dot(p, frame[0]), glm::dot(p, frame[1])) / z);
  }
  cone.min = glm::max(cone.min, seen.min);
  cone.max = glm::min(cone.max, seen.max);
  if (cone.min.x > cone.max.x || cone.min.y > cone.max.y) return std::nullopt;
  return cone;
}

std::optional<View> spot_view(const Bounds& bounds, const View& camera, const Light& light, const std::vector<glm::dvec3>& seen, Size2d map) {
  const glm::dmat3 axis = frame_about(glm::normalize(light.direction));
  std::vector<glm::dvec3> from_light;
  for (const glm::dvec3& p : seen) from_light.push_back(p + (camera.eye - light.position));
  const std::optional<Rectangle> lit = lit_tangents(axis, light.outer_angle, from_light);
  if (!lit) return std::nullopt;
  std::array<glm::dvec3, 4> rays;
  for (std::size_t i = 0; i < 4; ++i) rays[i] = axis * glm::dvec3(i & 1 ? lit->max.x : lit->min.x, i & 2 ? lit->max.y : lit->min.y, 1.0);

  // Aim at the middle of that rectangle, then turn about the aim.
  const glm::dmat3 aim = frame_about(glm::normalize(rays[0] / glm::length(rays[0]) + rays[1] / glm::length(rays[1]) +
                                              rays[2] / glm::length(rays[2]) + rays[3] / glm::length(rays[3])));
  glm::dmat3 best = aim;
  double texel = std::numeric_limits<double>::infinity();
  for (int k = 0; k < turns; ++k) {
    const glm::dmat3 frame = turned(aim, k);
    glm::dvec2 half(1e-6);
    for (const glm::dvec3& ray : rays)
      half = glm::max(half, glm::abs(glm::dvec2(glm::dot(ray, frame[0]), glm::dot(ray, frame[1])) / glm::dot(ray, frame[2])));
    if (const double t = texel_size(half, map); t < texel) texel = t, best = frame;
  }
  View view = view_of(best, light.position, texel, map);
  double last = 0.0;
  for (const glm::dvec3& p : from_light) last = std::max(last, glm::dot(p, best[2]));
  const double size = std::max(bounds.diagonal(), 1e-30);
  view.far_cut = std::max(last, 0.0) + 1e-6 * size;
  view.depth_near = 1e-6 * size;
  return view;
}

} // namespace

std::vector<glm::dvec3> seen_corners(const Bounds& bounds, const View& camera) {
  if (bounds.empty()) return {};
  const std::vector<Plane> planes = planes_of(bounds, camera);
  const double scale = bounds.diagonal() + glm::length(bounds.center() - camera.eye);
  std::vector<glm::dvec3> corners;
  const auto inside = [&](const glm::dvec3& p) {
    return std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) { return glm::dot(plane.normal, p) + plane.offset >= -1e-9 * scale; });
  };
  // A corner of a convex polyhedron is where three of its planes meet and no other one is violated.
  for (std::size_t a = 0; a < planes.size(); ++a)
    for (std::size_t b = a + 1; b < planes.size(); ++b)
      for (std::size_t c = b + 1; c < planes.size(); ++c) {
        const glm::dmat3 m = glm::transpose(glm::dmat3(planes[a].normal, planes[b].normal, planes[c].normal));
        if (std::abs(glm::determinant(m)) < 1e-9) continue;
        const glm::dvec3 p = glm::inverse(m) * -glm::dvec3(planes[a].offset, planes[b].offset, planes[c].offset);
        if (inside(p)) corners.push_back(p);
      }
  return corners;
}

std::optional<View> light_view(const Bounds& bounds, const View& camera, const Light& light, Size2d map) {
  const std::vector<glm::dvec3> seen = seen_corners(bounds, camera);
  if (seen.empty() || map.width == 0 || map.height == 0) return std::nullopt;
  switch (light.kind) {
  case LightKind::Directional: return directional_view(bounds, camera, glm::normalize(light.direction), seen, map);
  case LightKind::Headlight: return directional_view(bounds, camera, glm::transpose(camera.rotation)[2], seen, map);
  case LightKind::Spot: return spot_view(bounds, camera, light, seen, map);
  case LightKind::Point: break;
  }
  return std::nullopt;
}

} // namespace mote::passes
