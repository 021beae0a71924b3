// SPDX-License-Identifier: MIT
#include "app/charts/icosphere.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace mote::app {
namespace {

Icosphere icosahedron() {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  Icosphere out;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g})
      for (const glm::dvec3& p : {glm::dvec3(0, a, b), glm::dvec3(a, b, 0), glm::dvec3(b, 0, a)}) out.corners.push_back(glm::normalize(p));
  const double edge = 2.0 / std::sqrt(1.0 + g * g); // of the unit icosahedron
  auto near = [&](std::uint32_t i, std::uint32_t j) { return std::abs(glm::length(out.corners[i] - out.corners[j]) - edge) < 1e-9; };
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t j = i + 1; j < 12; ++j)
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(i, k)) continue;
        const bool outward = glm::dot(glm::cross(out.corners[j] - out.corners[i], out.corners[k] - out.corners[i]), out.corners[i]) > 0.0;
        out.triangles.insert(out.triangles.end(), {i, outward ? j : k, outward ? k : j});
      }
  return out;
}

Icosphere refined(const Icosphere& mesh) {
  Icosphere out{mesh.corners, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(out.corners.size()));
    if (fresh) out.corners.push_back(glm::normalize(mesh.corners[a] + mesh.corners[b]));
    return it->second;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const std::uint32_t a = mesh.triangles[t], b = mesh.triangles[t + 1], c = mesh.triangles[t + 2];
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    out.triangles.insert(out.triangles.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
  }
  return out;
}

} // namespace

Icosphere icosphere(int level) {
  Icosphere mesh = icosahedron();
  for (int i = 0; i < level; ++i) mesh = refined(mesh);
  return mesh;
}

double deficit(const Icosphere& mesh) {
  double least = 1.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    least = std::min(least, glm::length((mesh.corners[mesh.triangles[t]] + mesh.corners[mesh.triangles[t + 1]] + mesh.corners[mesh.triangles[t + 2]]) / 3.0));
  return 1.0 - least;
}

chart::Panel sagitta_panel() {
  chart::Panel panel{"How far a triangle lies below its sphere", {"triangles", "", true}, {"deepest point", "radii", true}, true, {}};
  chart::Series flat{"icosphere", false, {}};
  for (int level = 0; level <= 5; ++level) {
    const Icosphere mesh = icosphere(level);
    flat.points.push_back({fmt::format("level {}", level), static_cast<double>(mesh.triangles.size() / 3), deficit(mesh)});
  }
  panel.series.push_back(std::move(flat));
  return panel;
}

} // namespace mote::app
