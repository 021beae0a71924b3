// SPDX-License-Identifier: MIT
// Which pass could do the work of the one after it: pure, from the plan alone. A pixel map (pass.hpp) may be applied by
// the pass before it if that pass makes the texture it reads, nothing else touches the texture, both textures have one
// size, and the memory of the second is free while the first pass runs.
#pragma once

#include "render_graph/plan.hpp"

#include <cstddef>
#include <optional>
#include <string_view>

namespace mote::rg {

// The use through which pass `pass + 1` writes what it makes from the output `slot` of `pass`, or nothing.
std::optional<std::size_t> successor_use(const Plan& plan, std::size_t pass, std::string_view slot);

// Whether passes of `kind` sample the output `slot` of `pass`, and nothing else touches it.
bool only_sampled_by(const Plan& plan, std::size_t pass, std::string_view slot, std::string_view kind);

} // namespace mote::rg
