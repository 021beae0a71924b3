// SPDX-License-Identifier: MIT
// Transparent particles along one ray, exactly: every surface of every particle in view that the ray
// meets before the opaque surface, in the order of its depth, in double. Called by the pixel loop
// (reference.hpp); const and safe to share between threads. It knows nothing of the GPU's orders and lists.
//
// A particle of opacity alpha has two surfaces that block 1 - sqrt(1 - alpha) each (contracts,
// "Transparency"), so both together block alpha; or, with one surface, the one that an opaque particle
// would show, which blocks alpha. With a density d a particle blocks 1 - exp(-d L), L the length of the ray's way within it that is in view,
// shared out to its surfaces in view. Ties go to the lowest id, then to the entry.
#pragma once

#include "core/reference/tracer.hpp"

#include <cstdint>
#include <vector>

namespace mote::reference {

struct Layer {
  double t{};
  std::uint64_t id{};
  std::uint32_t placed{}, record{}; // World::transparent_placed
  bool exit{};
  bool inner{};      // within a neighbor of one body; there only with a density
  double blocks{-1}; // with a density: what this surface blocks
};

class LayerTracer {
public:
  // `two_surfaces`: entry and exit, else one layer a particle.
  LayerTracer(const Tracer& tracer, bool two_surfaces);

  // The surfaces nearer than `limit`, nearest first.
  [[nodiscard]] std::vector<Layer> layers(const Ray& ray, double limit) const;
  // What the sample shows with the layers before it: straight color. `behind`: the opaque surface's light or the
  // background, straight.
  [[nodiscard]] glm::dvec4 over(const std::vector<Layer>& layers, const Ray& ray, const glm::dvec4& behind, bool shadows) const;
  // Whether moving the sample by 1e-3 px changes which surfaces are met or their order, or two of them (or the
  // opaque one, or a cut) lie within 4 ulp of each other. `sample` is that of pixel (x, y).
  [[nodiscard]] bool ambiguous(double x, double y, const Sample& sample, const std::vector<Layer>& layers) const;

private:
  [[nodiscard]] Ray local(const Ray& ray, std::uint32_t placed) const;
  void add(const Ray& ray, double limit, std::uint32_t placed, std::uint32_t record, std::vector<Layer>& out) const;
  [[nodiscard]] double alpha_of(const Layer& layer) const;
  [[nodiscard]] glm::dvec3 normal(const Layer& layer, const Ray& ray) const;

  const Tracer& tracer_;
  const World& world_;
  bool two_surfaces_;
  std::vector<glm::dvec3> eyes_{}; // per instance: the eye in its data space
  std::vector<double> slacks_{};   // what rounding may lose there
  double near_{}, far_{}, top_slack_{};
};

} // namespace mote::reference
