// SPDX-License-Identifier: MIT
// How smooth the outlines of a picture are, where the graph does not say it: one sample a pixel, several, or analytic
// edges. Changes the request for the graph before it is compiled. docs/decisions.md has the reasons for `automatic`.
#pragma once

#include "app/library/graphs.hpp"
#include "app/library/job.hpp"

#include <cstdint>
#include <string>

namespace mote::app {

struct Smoothing {
  std::string edges{"auto"};  // "analytic", "sampled"
  std::uint32_t samples{};    // a pixel; 0: not asked for
  [[nodiscard]] bool asked() const { return samples != 0 || edges != "auto"; }
};

// The largest scene whose pictures get analytic edges by themselves: more particles are mostly thinner than a pixel, where single samples err less.
inline constexpr std::uint64_t most_with_edges = 100'000;

// May a picture have analytic edges without being asked for? Only one to look at: linear values with AOVs beside them (EXR) are
// those of the pixel centers. AOVs in files of their own change nothing.
// Every type of the scene must have them.
[[nodiscard]] bool takes_edges(const GraphRequest& request, const Scene& scene);

// What the user said, or `automatic` where nothing was said and no pass says something itself.
void request_smoothing(GraphRequest& request, const Smoothing& smoothing, bool automatic);

} // namespace mote::app
