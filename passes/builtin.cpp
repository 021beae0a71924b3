// SPDX-License-Identifier: MIT
#include "passes/builtin.hpp"

#include "passes/ocio_tonemap.hpp"
#include "passes/opaque_impostors.hpp"

namespace mote::passes {

void register_builtin_passes(rg::Registry& registry) {
  registry.add({"opaque_impostors", "particles as exact surfaces, shaded, with depth and AOVs", make_opaque_impostors});
  registry.add({"ocio_tonemap", "the display transform, by OpenColorIO", make_ocio_tonemap});
}

} // namespace mote::passes
