// SPDX-License-Identifier: MIT
// Pass kind `opaque_impostors`: every particle as its exact surface, shaded, with depth and, where
// something wants them, AOVs. Clears its targets: color to the scene's background, depth to
// infinitely far, aov_depth to +inf, aov_id to 0xFFFFFFFF.
// Needs in the frame input: Scene, View, FrameOptions, ParticleStore.
#pragma once

#include "render_graph/pass.hpp"

#include <memory>

namespace mote::passes {

std::unique_ptr<rg::Pass> make_opaque_impostors();

} // namespace mote::passes
