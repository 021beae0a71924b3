// SPDX-License-Identifier: MIT
// The pass kind `shadow_map`: what a light sees, for the drawing passes that take it as their input
// `shadow`. The fitted view comes from shadows/light_view.hpp, the texel format is in
// shadows/shadow_maps.hpp.
#pragma once

#include "render_graph/pass.hpp"

#include <memory>

namespace mote::passes {

std::unique_ptr<rg::Pass> make_shadow_map();

} // namespace mote::passes
