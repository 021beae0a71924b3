// SPDX-License-Identifier: MIT
// The inputs for shadow maps that a drawing pass declares: "shadow", "shadow_2", ..., one a map; and the lights of the maps
// that are connected, in a frame.
#pragma once

#include "passes/shadows/surface_shading.hpp"
#include "render_graph/pass.hpp"

#include <string>
#include <vector>

namespace mote::passes {

class ShadowInputs {
public:
  void declare(std::vector<rg::Slot>& slots, rg::Params& params);
  [[nodiscard]] bool connected(const rg::PassContext& context) const; // any of them
  [[nodiscard]] std::vector<MappedLight> lights(const rg::PassContext& context) const;

private:
  std::vector<std::string> slots_{};
};

// Draws the maps that are in buffers as textures, for who reads those.
void draw_textures(std::vector<MappedLight>& lights, gpu::CommandEncoder& encoder, const MapInBuffers::Mark& mark);

} // namespace mote::passes
