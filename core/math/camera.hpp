// SPDX-License-Identifier: MIT
// The camera as a user describes it, and the view that a renderer draws: double precision, on the
// CPU. Raster passes, compute passes and the reference all take their rays from the same View.
//
// View space: origin at the eye, x right, y DOWN, z forward; right-handed. Pixel (0,0) is the top
// left one, its center (0.5, 0.5). The ray through pixel (x, y), with s = sample offset:
//   perspective    origin 0,               direction ((x+s.x-w/2)/focal, (y+s.y-h/2)/focal, 1)
//   orthographic   origin ((x+s.x-w/2)/focal, (y+s.y-h/2)/focal, 0),       direction (0, 0, 1)
// so the ray parameter is the depth along the view axis in both. Pixels are square.
//
// A view may be a panel of a larger picture: pixels count from the panel's top left, and the w/2 and h/2 above are
// where the axis meets it, center(). A panel's rays are those of the whole picture, so panels have no seams.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mote {

enum class Projection : std::uint8_t { Perspective, Orthographic };

struct Camera {
  Projection projection{Projection::Perspective};
  glm::dvec3 eye{0, 0, 1}, target{0}, up{0, 0, 1}; // world
  double fov_y{30.0};                              // degrees, (0, 180); perspective
  double height{1.0};                              // world units seen from top to bottom; orthographic
  std::optional<double> near{}, far{};             // along the view axis; near > 0 for perspective
};

struct Size2d {
  std::uint32_t width{}, height{};
  bool operator==(const Size2d&) const = default;
};

struct View {
  Projection projection{Projection::Perspective};
  glm::dvec3 eye{0};               // world
  glm::dmat3 rotation{1};          // view from world; its rows are right, down, forward
  Size2d size{};                   // pixels, of what is drawn: the picture or a panel of it
  Size2d picture{};                // pixels, of the picture that this is a panel of; 0x0: this is all of it
  glm::uvec2 panel_origin{0};      // its top left pixel there
  double focal{1};                 // pixels; orthographic: pixels per world unit
  glm::dvec2 sample_offset{0.5, 0.5};
  double near_cut{0};              // nothing nearer is visible; 0: everything in front of the eye plane
  double far_cut{0};               // nothing farther is visible; 0: no limit
  double depth_near{1};            // n of the depth encoding n/z (reverse-Z, infinite far); <= near_cut where that is set

  [[nodiscard]] Size2d whole() const { return picture.width ? picture : size; }
  [[nodiscard]] glm::dvec2 center() const { return glm::dvec2(whole().width, whole().height) * 0.5 - glm::dvec2(panel_origin); }
  [[nodiscard]] glm::dvec3 to_view(const glm::dvec3& world) const { return rotation * (world - eye); }
  [[nodiscard]] glm::dvec3 ray_origin(double x, double y) const;    // view space; pixel indices, offset added inside
  [[nodiscard]] glm::dvec3 ray_direction(double x, double y) const; // view space, not normalized; z = 1
};

// An empty string, or what is wrong with the camera ("eye and target are the same point", ...): eye =
// target, up along the view, fov outside (0, 180), height <= 0, near >= far, near <= 0, non-finite numbers.
std::string check(const Camera& camera);

// `scene_size` is a length of the scene (bounding diagonal); it only scales depth_near. Precondition: check() is empty.
View make_view(const Camera& camera, Size2d size, double scene_size);

// The panels of a view, row by row: none larger than `most` x `most` pixels, as equal as can be. One that fits is
// its own only panel.
std::vector<View> panels(const View& view, std::uint32_t most);

struct Bounds { // axis-aligned, world; empty while min > max
  glm::dvec3 min{1e300}, max{-1e300};
  [[nodiscard]] bool empty() const { return !(min.x <= max.x); }
  void add(const glm::dvec3& p) { min = glm::min(min, p); max = glm::max(max, p); }
  void add(const glm::dvec3& p, double r) { add(p - r); add(p + r); }
  void add(const Bounds& b) { if (!b.empty()) { add(b.min); add(b.max); } }
  [[nodiscard]] glm::dvec3 center() const { return (min + max) * 0.5; }
  [[nodiscard]] double diagonal() const { return empty() ? 0.0 : glm::length(max - min); }
};

// A camera that sees all of `bounds` from the direction (0.25 right, -1 front, 0.15 up), z up, 30 degrees;
// empty bounds give the unit cube's.
Camera frame(const Bounds& bounds, Size2d size);

} // namespace mote
