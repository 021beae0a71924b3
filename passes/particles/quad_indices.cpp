// SPDX-License-Identifier: MIT
#include "passes/particles/quad_indices.hpp"

#include <algorithm>
#include <vector>

namespace mote::passes {

void QuadIndices::reserve(gpu::Device& device, std::uint32_t particles) {
  const std::uint32_t wanted = std::min(particles, most_per_draw);
  if (wanted == 0 || (buffer_ && buffer_.size() >= std::uint64_t{wanted} * 24)) return;
  std::vector<std::uint32_t> indices(std::size_t{wanted} * 6);
  constexpr std::uint32_t corner[6] = {0, 1, 2, 2, 1, 3};
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(i / 6 * 4 + corner[i % 6]);
  buffer_ = device.create_buffer({.label = "particles.quad_indices",
                                  .size = indices.size() * 4,
                                  .usage = gpu::BufferUsage::Index,
                                  .contents = std::as_bytes(std::span<const std::uint32_t>(indices))});
}

void QuadIndices::draw(gpu::RenderPass& pass, std::uint32_t particles, std::uint32_t start) const {
  pass.set_index_buffer(buffer_, gpu::IndexFormat::Uint32);
  for (std::uint32_t first = 0; first < particles; first += most_per_draw)
    pass.draw_indexed(std::min(most_per_draw, particles - first) * 6, 1, 0, static_cast<std::int32_t>((start + first) * 4));
}

} // namespace mote::passes
