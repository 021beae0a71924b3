// SPDX-License-Identifier: MIT
// Which particle is under the mouse, from the ids around it; and what picks tell: distance and angle. Pure.
//
// Small particles are hard to hit, so the nearest one within a search window counts; a pixel that is hit exactly wins.
#pragma once

#include "core/math/camera.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mote::window {

inline constexpr std::uint32_t no_particle = 0xFFFFFFFFu;

// Part of a picture, row by row.
struct PickArea {
  glm::uvec2 origin{0};      // its top left pixel in the picture
  Size2d size{};
  std::vector<std::uint32_t> ids{};
  std::vector<float> depths{}; // +inf where nothing is
};

struct Pick {
  std::uint32_t id{no_particle};
  glm::uvec2 pixel{0};   // of the picture, where it was found
  double depth{};
  glm::dvec3 surface{0}; // world: the point of the surface there
};

// The particle nearest to place (x, y) of the picture, in pixels; of equally near ones that before the others. Nothing where the area is empty.
std::optional<Pick> nearest_particle(const PickArea& area, double x, double y, const View& view);

// The view's panel around a place: at most `radius` pixels to each side, cut at the picture.
View pick_view(const View& view, double x, double y, std::uint32_t radius);

// Where a particle's id leads: data set or batch, instance and row.
struct Particle {
  std::size_t batch{}, instance{};
  std::uint64_t row{};
};

// Degrees at `corner`, 0 to 180; nothing where two points are the same.
std::optional<double> angle_at(const glm::dvec3& a, const glm::dvec3& corner, const glm::dvec3& b);

} // namespace mote::window
