// SPDX-License-Identifier: MIT
#include "app/charts/outlines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mote::app {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

glm::dvec2 project(const glm::dvec3& p) { return {p.x / p.z, p.y / p.z}; }

std::vector<glm::dvec2> rectangle(glm::dvec2 low, glm::dvec2 high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

// Least and largest x / z over the sphere (method book, section 4.1).
glm::dvec2 extent(double x, double z, double r) {
  const double root = r * std::sqrt(x * x + z * z - r * r), den = (z - r) * (z + r);
  return {(x * z - root) / den, (x * z + root) / den};
}

// A regular polygon around the silhouette circle, projected.
std::vector<glm::dvec2> silhouette(const glm::dvec3& m, double r, int corners) {
  const double e = glm::length(m), rho = std::sqrt(1.0 - r * r / (e * e));
  const glm::dvec3 to = m / e, middle = m - to * (r * r / e);
  const glm::dvec3 x = glm::normalize(glm::cross(to, std::abs(to.y) < 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0))), y = glm::cross(to, x);
  const double reach = rho * r / std::cos(std::numbers::pi / corners);
  std::vector<glm::dvec2> out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / corners;
    out.push_back(project(middle + reach * (std::cos(angle) * x + std::sin(angle) * y)));
  }
  return out;
}

bool inside(const std::vector<glm::dvec2>& corners, glm::dvec2 p) {
  int sides = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    sides += (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0.0 ? 1 : -1;
  }
  return std::abs(sides) == static_cast<int>(corners.size());
}

bool hits(const glm::dvec3& m, double r, glm::dvec2 p) {
  const glm::dvec3 d = glm::normalize(glm::dvec3(p, 1.0));
  return glm::length(glm::cross(d, m)) <= r;
}

} // namespace

std::vector<Outline2d> outlines(const glm::dvec3& m, double r) {
  const glm::dvec2 x = extent(m.x, m.z, r), y = extent(m.y, m.z, r), c = project(m);
  const glm::dvec2 half(r / m.z), reach(std::max({std::abs(x.x - c.x), std::abs(x.y - c.x), std::abs(y.x - c.y), std::abs(y.y - c.y)}));
  return {{"tangent rectangle (mote)", false, rectangle({x.x, y.x}, {x.y, y.y})},
          {"silhouette quad (exercise)", false, silhouette(m, r, 4)},
          {"silhouette octagon", false, silhouette(m, r, 8)},
          {"quad through the center, parallel to the image", true, rectangle(c - half, c + half)},
          {"square around the center that holds all (point sprite)", true, rectangle(c - reach, c + reach)}};
}

Covered covered(const Outline2d& outline, const glm::dvec3& m, double r, int steps) {
  glm::dvec2 low(1e300), high(-1e300);
  for (const Outline2d& o : outlines(m, r)) // all that any of them, or the sphere, covers
    for (const glm::dvec2& p : o.corners) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  double sphere = 0.0, area = 0.0, missing = 0.0;
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < steps; ++i) {
      const glm::dvec2 p = low + (high - low) * glm::dvec2((i + 0.5) / steps, (j + 0.5) / steps);
      const bool of_sphere = hits(m, r, p), of_outline = inside(outline.corners, p);
      sphere += of_sphere;
      area += of_outline;
      missing += of_sphere && !of_outline;
    }
  return {missing / sphere, area / sphere};
}

chart::Panel outline_panel(double degrees) {
  chart::Panel panel{fmt::format("Outlines of a sphere {:g} degrees off the axis", degrees), {"area of the outline / of the sphere", "", false}, {"part of the sphere outside the outline", "", true}, true, {}};
  constexpr std::array distances{1.5, 3.0, 10.0};
  for (const double kappa : distances) {
    const glm::dvec3 m = kappa * glm::dvec3(std::sin(degrees * degree), 0.0, std::cos(degrees * degree));
    if (m.z <= 1.0 + 1e-9) continue; // not wholly before the eye
    const std::vector<Outline2d> all = outlines(m, 1.0);
    if (panel.series.empty())
      for (const Outline2d& o : all) panel.series.push_back({o.name, o.baseline, {}});
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Covered of = covered(all[i], m, 1.0);
      panel.series[i].points.push_back({fmt::format("kappa = {:g}", kappa), of.overdraw, of.missing});
    }
  }
  return panel;
}

} // namespace mote::app
