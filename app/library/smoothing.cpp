// SPDX-License-Identifier: MIT
#include "app/library/smoothing.hpp"

#include "passes/particles/particle_type.hpp"

#include <fmt/format.h>

namespace mote::app {

bool takes_edges(const GraphRequest& request, const Scene& scene) {
  for (const Batch& batch : scene.batches) {
    const passes::ParticleType* type = passes::find_particle_type(batch.type);
    if (!type || !type->analytic_edges) return false;
  }
  return !request.linear && !request.every_aov && scene.particle_count() <= most_with_edges;
}

void request_smoothing(GraphRequest& request, const Smoothing& smoothing, bool automatic) {
  if (smoothing.samples != 0) request.opaque_settings = {fmt::format("samples={}", smoothing.samples)};
  else if (smoothing.edges != "auto") request.opaque_settings = {fmt::format("edges=\"{}\"", smoothing.edges)};
  else if (automatic) request.opaque_settings = {"edges=\"analytic\""};
  request.opaque_settings_yield = !smoothing.asked();
}

} // namespace mote::app
