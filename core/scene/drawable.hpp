// SPDX-License-Identifier: MIT
// What can be drawn of a frame: particles with all their values, those left out that have no place, no size or no shape, and how
// many of those there were. Between the rules of a scene and the chunks that renderers hold; private to core/scene.
#pragma once

#include "core/scene/glyphs.hpp"

#include <memory>
#include <vector>

namespace mote {

// Places in `centers` and the rest belong together.
struct Drawable {
  std::uint32_t vec4s_per_record{1};
  std::vector<glm::dvec3> centers{}, half{};
  std::vector<double> radii{}, finest{};
  std::vector<glm::vec4> rest{};
  std::vector<std::uint32_t> rows{}, colors{};
};

// Spheres of these radii.
Drawable choose(const FrameContext& context, std::vector<double> radii, std::vector<std::uint32_t> colors, Diagnostics& diagnostics);
// Particles of other types; `radii` for messages, may be empty.
Drawable choose(const FrameContext& context, Glyphs glyphs, const std::vector<double>& radii, std::vector<std::uint32_t> colors, Diagnostics& diagnostics);
// The particles that `rows` marks, in their order.
Drawable subset(const Drawable& all, const std::vector<bool>& rows);
std::shared_ptr<const ChunkSet> chunks_of(const Drawable& drawable);

constexpr double largest_coordinate = 1e30; // farther out, float32 in view space ends

} // namespace mote
