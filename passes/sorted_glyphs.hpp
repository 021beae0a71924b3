// SPDX-License-Identifier: MIT
// The pass kind `sorted_glyphs`: transparent particles over what is there, in one order over all of
// them, by weighted sums, or exactly, surface by surface. See docs/graph-file.md for its words.
#pragma once

#include "render_graph/pass.hpp"

#include <memory>

namespace mote::passes {

std::unique_ptr<rg::Pass> make_sorted_glyphs();

} // namespace mote::passes
