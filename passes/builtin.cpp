// SPDX-License-Identifier: MIT
#include "passes/builtin.hpp"

#include "passes/ocio_tonemap.hpp"
#include "passes/opaque_impostors.hpp"
#include "passes/sorted_glyphs.hpp"

namespace mote::passes {

void register_builtin_passes(rg::Registry& registry) {
  registry.add({"opaque_impostors", "particles as exact surfaces, shaded, with depth and AOVs", make_opaque_impostors});
  registry.add({"sorted_glyphs", "transparent particles over what is there, in one order or order-independent", make_sorted_glyphs});
  registry.add({"ocio_tonemap", "the display transform, by OpenColorIO", make_ocio_tonemap});
}

} // namespace mote::passes
