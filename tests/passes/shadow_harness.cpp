// SPDX-License-Identifier: MIT
#include "shadow_harness.hpp"

#include "core/reference/reference.hpp"

namespace mote::test {

Light sun(glm::dvec3 direction) {
  return {.name = "sun", .kind = LightKind::Directional, .direction = glm::normalize(direction), .intensity = 0.8, .shadows = true};
}

ShadowErrors shadow_errors(const Picture& picture, const Scene& scene, const View& view) {
  ReferenceOptions options;
  const ReferencePicture with = render_reference(scene, view, options);
  options.shadows = false;
  const ReferencePicture without = render_reference(scene, view, options);
  Scene dark = scene;
  for (Light& light : dark.lights)
    if (light.shadows) light.intensity = 0.0;
  const ReferencePicture ambient = render_reference(dark, view, options);
  ShadowErrors out;
  for (std::size_t i = 0; i < with.id.size(); ++i) {
    if (with.id[i] == reference_no_id || with.ambiguous[i]) continue;
    const double lit = without.color[i].g, unlit = ambient.color[i].g;
    if (lit - unlit < 4e-3) continue; // turned away, or beyond the cone
    ++out.facing;
    const bool truth = with.color[i].g < 0.5 * (lit + unlit), drawn = picture.color[i].g < 0.5 * (lit + unlit);
    out.shadowed += truth;
    out.false_shadow += drawn && !truth;
    out.false_light += truth && !drawn;
  }
  return out;
}

} // namespace mote::test
