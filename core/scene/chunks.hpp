// SPDX-License-Identifier: MIT
// Particles as renderers hold them: runs of up to 64 in Morton order ("chunks"), each with a
// double-precision origin and a box; records are float32 and relative to that origin. One structure
// serves placement far from the origin, culling, sorting, picking and the reference's top level.
//
// A record is `vec4s_per_record` vec4s; the first is always (center relative to the chunk's origin,
// radius of a bounding sphere; for a sphere: its radius). Chunk c owns the records
// [64 c, 64 c + count); unused places hold radius 0 and draw as nothing.
#pragma once

#include "core/base/pages.hpp"
#include "core/math/camera.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace mote {

constexpr std::uint32_t chunk_capacity = 64;
constexpr std::uint32_t no_row = 0xFFFFFFFFu; // in ChunkSet::rows: an unused place

struct Chunk {
  glm::dvec3 origin{0};               // in the data set's own space
  glm::vec3 box_min{0}, box_max{0};   // relative to origin, radii included
  std::uint32_t count{};              // records in use, <= chunk_capacity
  float max_radius{};                 // of its particles' bounding spheres
};

struct ChunkSet {
  std::uint32_t vec4s_per_record{1};
  PageVector<glm::vec4> records{};    // chunks.size() * 64 * vec4s_per_record
  PageVector<std::uint32_t> rows{};   // per record: row in the file, or no_row
  PageVector<std::uint32_t> colors{}; // sRGB-encoded straight RGBA, 8 bits each, R lowest: one a record, or a palette; empty: the batch's color
  PageVector<std::uint8_t> color_indices{}; // per record: which of `colors`, a palette then, in ascending order; empty: no palette
  std::vector<Chunk> chunks{};
  Bounds bounds{};                    // of all particles with radii, data set space
  [[nodiscard]] std::uint64_t record_count() const { return chunks.size() * std::uint64_t{chunk_capacity}; }
  [[nodiscard]] bool paletted() const { return !color_indices.empty(); }
  // The color of a record in use, where records have their own.
  [[nodiscard]] std::uint32_t color_of(std::uint64_t record) const { return colors[paletted() ? color_indices[record] : record]; }
  [[nodiscard]] double alpha_of(std::uint64_t record) const { return colors.empty() ? 1.0 : (color_of(record) >> 24) / 255.0; }
  // The exact center of a record: what the renderer's float32 record means.
  [[nodiscard]] glm::dvec3 center(std::uint64_t record) const {
    return chunks[record / chunk_capacity].origin + glm::dvec3(records[record * vec4s_per_record]);
  }
};

// Particles of any type as arrays. Everything must be finite, radii > 0: the caller has left out (and counted) the rest.
struct ParticleArrays {
  std::uint32_t vec4s_per_record{1};
  std::span<const glm::dvec3> centers{};
  std::span<const double> radii{};         // of bounding balls, which hold the particle as its float32 record says it
  std::span<const double> finest{};        // the least measure of each: offsets must not be coarse against it; empty: the radii
  std::span<const glm::dvec3> half{};      // half extents of boxes around the centers; empty: the radii
  std::span<const glm::vec4> rest{};       // the records' vec4s behind the first, vec4s_per_record - 1 each
  std::span<const std::uint32_t> rows{};   // in the file
  std::span<const std::uint32_t> colors{}; // one each, as in ChunkSet::colors; may be empty
};
// Deterministic; uses all cores. Up to 256 different colors become a palette (core/scene/palette.hpp).
ChunkSet build_chunks(const ParticleArrays& particles);

// Spheres: records of one vec4.
ChunkSet build_spheres(std::span<const glm::dvec3> centers, std::span<const double> radii,
                       std::span<const std::uint32_t> rows, std::span<const std::uint32_t> colors);

} // namespace mote
