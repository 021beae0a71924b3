// SPDX-License-Identifier: MIT
// What the pass kind `opaque_impostors` writes: color, depth and AOVs, their formats, and what is where nothing is.
#pragma once

#include "core/gpu/gpu.hpp"
#include "passes/states.hpp"
#include "render_graph/pass.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace mote::passes {

void declare_opaque_slots(std::vector<rg::Slot>& slots);
// AovBits of what is connected.
std::uint32_t connected_aovs(const rg::PassContext& context);
// Of a slot, color being the scene's background.
gpu::Color opaque_clear_value(std::string_view slot, const DrawStates& states, const rg::FrameInput& frame);

} // namespace mote::passes
