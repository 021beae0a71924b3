// SPDX-License-Identifier: MIT
// Which particles a pass draws: of which types, and opaque ones, transparent ones or all. Read from the
// pass's `draw` list, whose items are particle types and the words opaque, transparent and all; used by
// the kinds that draw particles. A particle is opaque when its own alpha times its batch's is 1, and
// draws as nothing when that is 0 in a pass that blends.
#pragma once

#include "core/scene/scene.hpp"
#include "render_graph/params.hpp"

#include <string>
#include <vector>

namespace mote::passes {

enum class Opacity : std::uint8_t { Opaque, Transparent, All };

struct Selection {
  std::vector<std::string> types{}; // empty: all
  Opacity opacity{Opacity::All};
  // Whether any particle of the batch can be drawn; which of them is decided by their own alpha.
  [[nodiscard]] bool draws(const Batch& batch) const;
};

// G031 for a word that is neither a type nor one of the three.
Selection read_selection(rg::Params& params, Opacity fallback);

// Whether some particle of the batch has an alpha of its own below 1. Looks at every particle, once.
bool has_own_alpha(const Batch& batch);
// Whether a batch holds a particle that is not opaque.
bool may_be_transparent(const Batch& batch);

} // namespace mote::passes
