// SPDX-License-Identifier: MIT
// Which chunks a view may see, and where they are in its view space: pure, no device. Double
// precision; the result is rounded to float once.
#pragma once

#include "core/math/principal_axes.hpp"
#include "core/scene/scene.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace mote::passes {

// As shaders read it: the origin's float bits and the chunk's index in its slice.
struct PlacedChunk {
  glm::uvec4 bits{0};
};

// A chunk is left out only if its box lies wholly behind the eye (or near) plane or beyond one side of the image
// (or the far cut).
class ViewCuller {
public:
  explicit ViewCuller(const View& view);
  // How far a box reaches towards each plane, per half extent along each data axis.
  using Reaches = std::array<glm::dvec3, 6>;
  [[nodiscard]] Reaches reaches(const glm::dmat3& view_from_data) const;
  // Box center, and half extents along data axes with the reaches of its instance.
  [[nodiscard]] bool may_see(const glm::dvec3& center_view, const Reaches& reaches, const glm::dvec3& half) const;

private:
  glm::dvec3 planes_[6]{};   // inward normals, view space
  double offsets_[6]{};      // inside where dot(normal, p) + offset >= 0
  std::size_t count_{};
};

// The center and bounding ball of a particle near the eye, placed in double; what shaders with NEAR_EYE begin with. Where the
// placement is no similarity, the radius is the record's and the power that of the eye where the ellipsoid is the unit sphere.
struct NearPayload {
  glm::vec4 center_radius{0}; // view space
  glm::vec4 rest_power{0};    // xyz: what rounding took from the center; w: |center|^2 - radius^2
  glm::vec4 power_rest{0};    // x: what rounding took from that power; yzw: from the vector
  glm::vec4 vector_size{0};   // the record's second vec4 in own space (own_space.glsl), as if it were a vector and a length
};

// What a view may see of some chunks. A chunk is near when the eye is closer to its box than twice the box's half
// diagonal (under a transform that is no similarity: to a ball around it, which never says less): there the rounding of
// chunk-relative placement (6e-8 of the chunk's extent) would show in the depth, so its particles are placed one by one.
// Few chunks can be near, whatever the scene.
struct PlacedChunks {
  std::vector<PlacedChunk> far{}, near{};
  std::vector<PlacedChunk> sprites{};  // far ones that the `point` expansion may draw, where it was asked for
  std::vector<NearPayload> payloads{}; // 64 for each near chunk, in order
};

// Where the box of a chunk is in view space: the chunk's origin, the box's center and axis-aligned half extents.
struct PlacedBox {
  glm::dvec3 origin{0}, center{0}, extent{0};
  double distance{}; // from the eye, world units; 0: inside
  bool near{};       // to the eye: see PlacedChunks
};

// Places the chunks of one instance, one by one.
class ChunkPlacer {
public:
  ChunkPlacer(const Instance& instance, const View& view, const ViewCuller& culler);
  // False: the view cannot see it.
  bool place(const Chunk& chunk, PlacedBox& out) const;
  // Appends a placed chunk for the raster expansions; `in_slice` is its index for the shaders.
  void add(const ChunkSet& set, std::uint64_t chunk, std::uint64_t in_slice, const PlacedBox& box, PlacedChunks& out) const;
  [[nodiscard]] bool similar() const { return similar_; } // else spheres become ellipsoids
  [[nodiscard]] double scale() const { return scale_; }   // of lengths, by a similarity
  // A record's center in view space, formed in double and rounded once, and its radius.
  [[nodiscard]] glm::vec4 in_view(const ChunkSet& set, std::uint64_t record, const PlacedBox& box) const;

private:
  void add_near(const ChunkSet& set, std::uint64_t chunk, const glm::dvec3& origin, std::vector<NearPayload>& out) const;
  const ViewCuller& culler_;
  glm::dmat3 instance_linear_, linear_, rotation_;
  glm::dvec3 translation_, eye_; // eye: in data space
  glm::dmat3 reach_{};           // absolute values of linear_
  ViewCuller::Reaches plane_reaches_{};
  double scale_{1};
  bool similar_{true};
  PrincipalAxes axes_{};         // of anything but a similarity
  glm::dmat3 own_from_data_{};   // turns (a similarity: and scales) a record's vectors: own_space.glsl
};

class SpriteRule; // sprites.hpp

// Appends the chunks [first, first + count) of an instance that the view may see; indices count from `first`.
void place_chunks(const ChunkSet& set, std::uint64_t first, std::uint64_t count, const Instance& instance,
                  const View& view, const ViewCuller& culler, PlacedChunks& out, const SpriteRule* sprites = nullptr);

} // namespace mote::passes
