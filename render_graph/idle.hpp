// SPDX-License-Identifier: MIT
// Which passes of a plan a frame can do without. Pure; the Executor asks it every frame.
//
// A pass that says it is idle is left out if each of its outputs passes through from a source (it
// would draw over it) or is read only where it is optional. What then has no reader is left out too.
#pragma once

#include "render_graph/plan.hpp"

#include <string>
#include <vector>

namespace mote::rg {

struct FrameChoice {
  std::vector<std::string> skipped{};       // per pass: why it is left out; empty: it runs
  std::vector<std::vector<bool>> missing{}; // per pass and use: its source is not there in this frame
  bool operator==(const FrameChoice&) const = default;
};

// idle_reasons: one per pass, empty for a pass that has work. Passes with state are left out only by
// their own reason.
FrameChoice choose_passes(const Plan& plan, const std::vector<std::string>& idle_reasons);

} // namespace mote::rg
