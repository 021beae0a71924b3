// SPDX-License-Identifier: MIT
#include "passes/particles/steps.hpp"

#include "core/base/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace mote::passes {
namespace {
constexpr std::array<std::string_view, 6> words{"proxy", "discard", "shade", "depth", "quadratic", "points"}; // order of Step
}

Steps read_steps(rg::Params& params) {
  Steps steps;
  const std::vector<std::string> known(words.begin(), words.end());
  const std::string word = params.word("steps", "depth", known,
                                       "for teaching, how far to go: rectangles, those without what misses, shaded, all; or all by the quadratic formula, or points");
  steps.step = static_cast<Step>(std::find(words.begin(), words.end(), word) - words.begin());
  steps.point_size = params.number("point_size", 8.0, {.min = 1, .max = 256}, "pixels, with steps = \"points\"");
  return steps;
}

std::string to_string(Step step) { return std::string(words[static_cast<std::size_t>(step)]); }

std::string why_not(Step step, Expansion expansion) {
  const bool quads = expansion == Expansion::Vertex || (expansion == Expansion::Geometry && step != Step::Points);
  if (step == Step::Depth || quads) return {};
  return fmt::format("expansion '{}' does not draw steps = \"{}\"", to_string(expansion), to_string(step));
}

void check_steps(const Steps& steps, const Scene& scene, const Selection& selection) {
  if (steps.step != Step::Quadratic) return;
  for (const Batch& batch : scene.batches) {
    if (!selection.draws(batch)) continue;
    const bool similar = std::all_of(batch.instances.begin(), batch.instances.end(), [](const Instance& i) { return similarity_scale(i.world_from_data).has_value(); });
    if (batch.type != "sphere" || !similar)
      fail(Exit::Failed, "P023", {}, fmt::format("steps = \"quadratic\" draws spheres that stay spheres; '{}' has {}", batch.name, similar ? "particles of type " + batch.type : "a transform that stretches them"));
  }
}

} // namespace mote::passes
