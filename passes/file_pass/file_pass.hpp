// SPDX-License-Identifier: MIT
// The pass kinds `fullscreen` and `compute`: a pass that is a GLSL file and a pass.toml, without a
// line of C++. Slots, parameters and the interface of the shader come from pass.toml (pass_file.hpp);
// the shader is compiled and checked when the graph is read, and again whenever the file changes.
// One that is broken then leaves the last good one in place, with its diagnostics (PassReports).
#pragma once

#include "render_graph/pass.hpp"

#include <memory>

namespace mote::passes {

std::unique_ptr<rg::Pass> make_fullscreen_pass();
std::unique_ptr<rg::Pass> make_compute_pass();

} // namespace mote::passes
