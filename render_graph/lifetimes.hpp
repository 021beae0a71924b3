// SPDX-License-Identifier: MIT
// From ordered passes to textures and buffers: what is made, its usage, first and last use, what is
// cleared, loaded, stored, copied for a root, and which resources share memory. Internal.
#pragma once

#include "render_graph/order.hpp"
#include "render_graph/plan.hpp"
#include "render_graph/resolve.hpp"

namespace mote::rg {

// Needs a resolved graph without errors. Fills everything but the plan's name and culled list.
void plan_resources(const Resolved& resolved, const Order& order, Plan& plan);

// Gives resources of equal spec one physical number where their lives do not meet; state and roots
// (`keep`) have numbers of their own from their first use on. Pure; called per kind of resource.
struct Life { std::uint32_t first{}, last{}; bool state{}, keep{}; std::size_t same{}; }; // same: equal specs have equal numbers
std::vector<std::uint32_t> share_memory(const std::vector<Life>& lives);

} // namespace mote::rg
