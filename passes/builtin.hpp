// SPDX-License-Identifier: MIT
// The list of built-in pass kinds: explicit, no static initializers.
#pragma once

#include "render_graph/registry.hpp"

namespace mote::passes {

void register_builtin_passes(rg::Registry& registry);

} // namespace mote::passes
