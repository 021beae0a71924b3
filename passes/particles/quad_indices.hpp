// SPDX-License-Identifier: MIT
// The index buffer of the `vertex` expansion: quads as two triangles, vertex i of particle p being
// 4 p + i. One buffer serves every draw; it grows to the largest one, up to a bound beyond which a
// draw is made in parts with a base vertex.
#pragma once

#include "core/gpu/gpu.hpp"

#include <cstdint>

namespace mote::passes {

class QuadIndices {
public:
  // Particles that one draw_indexed may expand: 24 bytes of indices each.
  static constexpr std::uint32_t most_per_draw = 1u << 20;
  void reserve(gpu::Device& device, std::uint32_t particles); // before the pass opens
  // The particles [start, start + particles); what was reserved bounds `particles`, not `start`.
  void draw(gpu::RenderPass& pass, std::uint32_t particles, std::uint32_t start = 0) const;

private:
  gpu::Buffer buffer_;
};

} // namespace mote::passes
