// SPDX-License-Identifier: MIT
// What a device, a pass and a scene allow each expansion, in words; from there to the one that draws. `auto` takes the
// cheapest that can (expansion_cost.hpp); one that was asked for and cannot is P001, with the reason.
#pragma once

#include "core/gpu/gpu.hpp"
#include "passes/particles/expansion_cost.hpp"
#include "passes/particles/particle_type.hpp"
#include "passes/particles/steps.hpp"
#include "passes/states.hpp"

#include <string>

namespace mote::passes {

// What an opaque pass draws.
struct ExpansionNeeds {
  const gpu::Device& device;
  const Scene& scene;
  const View& view;
  const Selection& selection;
  const DrawStates& states;
  gpu::TextureFormat color{};
  std::uint32_t aovs{}; // how many are made
  std::string_view beyond_tiles{}; // what the pass does besides and tiles do not ("shadow maps of method depth"); empty: nothing
  Phase phase{Phase::Opaque};      // or Surface, Shadow
  Step step{Step::Depth};
  bool edges{}; // analytic ones: `auto` takes tiles where they can draw, since their pictures differ from those of quads
};

// A sentence, or empty: `expansion` can draw it.
std::string why_not(Expansion expansion, const ExpansionNeeds& needs);
// What the device lacks for tiles, or empty.
std::string device_lacks_tiles(const gpu::Device& device);

// What FrameOptions::chosen is told, once the pass has recorded.
struct ExpansionReport {
  std::string kind{}; // of the pass that reports
  std::string pass{}; // its name, which who collects reports fills in: they come in the order of the plan
  ExpansionChoice choice{};
  bool automatic{};            // else the user named it
  std::uint64_t tiled{};       // chunks that tiles drew
  std::uint64_t rastered{};    // chunks that draws drew
};

// The expansion of this frame. Throws P001 if options.expansion names one that cannot.
ExpansionChoice choose_expansion(const ExpansionNeeds& needs, const FrameOptions& options, ExpansionChooser& chooser);

} // namespace mote::passes
