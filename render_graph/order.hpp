// SPDX-License-Identifier: MIT
// Which passes run, and in what order. A pass runs if a root needs it; a reader of a version runs
// after its writer and before whoever draws over it; the file's order breaks ties. Internal.
#pragma once

#include "render_graph/plan.hpp"
#include "render_graph/resolve.hpp"

namespace mote::rg {

struct Order {
  std::vector<int> nodes{};     // those that run, in order
  std::vector<bool> live{};     // per node
  std::vector<Culled> culled{}; // in file order
};

// A cycle is G050 with its path, at the input that closes it; `nodes` is then incomplete.
Order find_order(const Resolved& resolved, Diagnostics& diagnostics);

} // namespace mote::rg
