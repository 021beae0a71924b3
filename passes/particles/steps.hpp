// SPDX-License-Identifier: MIT
// How far a drawing pass goes, for teaching and comparison: parameter `steps` of opaque_impostors. All but Depth, which is the whole
// thing, are drawn by shaders of their own (shaders/particles/phase/steps.frag), so that nobody pays for them. AOVs are
// always those of the whole thing.
#pragma once

#include "core/scene/scene.hpp"
#include "passes/particles/particle_type.hpp"
#include "passes/particles/selection.hpp"
#include "render_graph/params.hpp"

#include <cstdint>
#include <string>

namespace mote::passes {

enum class Step : std::uint32_t {
  Proxy,     // the rectangle that covers a particle: red grows to the right, green downward
  Discard,   // the same where the ray meets the particle
  Shade,     // lit, with the proxy's depth: particles that intersect do not
  Depth,     // the whole thing
  Quadratic, // the whole thing by the quadratic formula of the books in float32: spheres only
  Points     // squares of a fixed size in the particles' colors
};

struct Steps {
  Step step{Step::Depth};
  double point_size{8.0}; // edge of the squares, pixels
  [[nodiscard]] bool whole() const { return step == Step::Depth; }
};

// Asks for `steps` and `point_size`.
Steps read_steps(rg::Params& params);
std::string to_string(Step step);

// Why an expansion cannot draw that step, or empty.
std::string why_not(Step step, Expansion expansion);
// Throws P023 for a scene that the step cannot draw.
void check_steps(const Steps& steps, const Scene& scene, const Selection& selection);

} // namespace mote::passes
