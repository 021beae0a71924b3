// SPDX-License-Identifier: MIT
#include "passes/builtin.hpp"

#include "passes/file_pass/file_pass.hpp"
#include "passes/ocio_tonemap.hpp"
#include "passes/opaque_impostors.hpp"
#include "passes/sorted_glyphs.hpp"
#include "passes/shadow_map.hpp"

namespace mote::passes {

void register_builtin_passes(rg::Registry& registry) {
  registry.add({"opaque_impostors", "particles as exact surfaces, shaded, with depth and AOVs", make_opaque_impostors});
  registry.add({"sorted_glyphs", "transparent particles over what is there, in one order or order-independent", make_sorted_glyphs});
  registry.add({"shadow_map", "what a directional, spot or head light sees, for the passes that it lights", make_shadow_map});
  registry.add({"fullscreen", "a pass from a file: GLSL for each pixel, with a pass.toml", make_fullscreen_pass});
  registry.add({"compute", "a pass from a file: a GLSL compute shader, with a pass.toml", make_compute_pass});
  registry.add({"ocio_tonemap", "the display transform, by OpenColorIO", make_ocio_tonemap});
}

} // namespace mote::passes
