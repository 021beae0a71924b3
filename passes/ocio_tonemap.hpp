// SPDX-License-Identifier: MIT
// Pass kind `ocio_tonemap`: scene-linear color to display color by OpenColorIO's shader. The display
// and view come from the frame's DisplaySettings unless the graph names them.
// Needs in the frame input: DisplaySettings.
#pragma once

#include "render_graph/pass.hpp"

#include <memory>

namespace mote::passes {

std::unique_ptr<rg::Pass> make_ocio_tonemap();

} // namespace mote::passes
