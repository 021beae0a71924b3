// SPDX-License-Identifier: MIT
// The reference picture: what a view of a scene shows, computed in double precision on the CPU,
// sharing no code with the shaders. `mote compare`, `mote chart` and the tests hold the GPU's
// pictures against it. One sample per pixel at view.sample_offset. Transparent particles are in the
// colors, every surface in its place along the ray (layers.hpp); all else shows opaque ones only.
//
// It draws no panels, filters nothing and knows no color management: colors are scene-linear.
#pragma once

#include "core/math/camera.hpp"
#include "core/reference/world.hpp"
#include "core/scene/scene.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace mote {

constexpr std::uint32_t reference_no_id = 0xFFFFFFFFu;

// Row-major, row 0 on top; every array holds width * height values, or none where it was not asked for.
struct ReferencePicture {
  Size2d size{};
  std::vector<double> depth{};           // along the view axis; +inf where nothing is
  std::vector<std::uint32_t> id{};       // reference_no_id where nothing is
  std::vector<glm::dvec3> normal{};      // world, unit, turned to the eye; (0, 0, 0) where nothing is
  std::vector<float> projected_radius{}; // with the normals: of the particle seen, pixels; 0 where nothing is
  std::vector<glm::dvec4> color{};       // scene-linear, straight alpha; the background where nothing is
  std::vector<std::uint8_t> ambiguous{}; // 1: float32 rounding may decide what is seen (tracer.hpp)
  std::vector<std::uint8_t> layers_ambiguous{}; // where there are transparent particles: the same for what they show
  std::uint64_t transparent{};           // particles that only the colors show
  double build_seconds{}, trace_seconds{};
};

struct ReferenceOptions {
  unsigned threads{0}; // 0: all cores
  bool ids{true};      // more than 2^32 - 2 particles: Failure R003
  bool ambiguity{true};
  bool normals{true};
  bool colors{true};
  bool shadows{true}; // of lights that have them
  bool two_surfaces{true}; // of transparent particles (contracts, "Transparency"); else one layer each
};

// Several views of one scene: build the world once. Throws Failure R003.
ReferencePicture render_reference(const reference::World& world, const View& view,
                                  const ReferenceOptions& options = {});
// Throws Failure R001 (unknown particle type), R002 (singular instance matrix), R003.
ReferencePicture render_reference(const Scene& scene, const View& view, const ReferenceOptions& options = {});

// The average color over the unit square around each sample (the pixel, for an offset of 0.5), from n x n
// samples at the centers of its n x n cells. width * height values, straight alpha.
std::vector<glm::dvec4> render_reference_area(const reference::World& world, const View& view, unsigned n,
                                              const ReferenceOptions& options = {});

} // namespace mote
