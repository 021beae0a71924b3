// SPDX-License-Identifier: MIT
// Radius and color of every row of a frame, by the rules of realize.hpp. Private to core/scene.
#pragma once

#include "core/data/dataset.hpp"
#include "core/scene/scene_file.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace mote {

// The file that a frame came from, for messages about its contents.
struct FrameOrigin {
  SourceLoc contents{};  // the particle file
  std::string name{};
};

// One radius per row as the rules give it: may be zero, negative or NaN, which the caller sorts out. Empty after an error.
std::vector<double> particle_radii(const data::Frame& frame, const RadiusDesc& rule, const FrameOrigin& origin,
                                   Diagnostics& diagnostics);

// One color per row as ChunkSet holds it (sRGB-encoded RGBA, R lowest), or none when all rows share `constant`.
struct ParticleColors {
  std::vector<std::uint32_t> packed{};
  glm::dvec3 constant{0.8}; // working space
};
ParticleColors particle_colors(const data::Frame& frame, const ColorDesc& rule, bool generated, const FrameOrigin& origin,
                               Diagnostics& diagnostics);

} // namespace mote
