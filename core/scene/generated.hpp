// SPDX-License-Identifier: MIT
// Scenes by name, for measurements that others can repeat: seeded particles in the cube [-50,50]^3,
// one of three cameras, a head light, a white background. The numbers are those of the
// benchmark generator, float for float.
//
//   spheres:N:fit|fill|inside[:seed=S][:frame=K]       N: 1000, 1e5, 2.5e6, ... up to 1e8
//   crystal:N:...  touching spheres on a cubic lattice that fills the cube (a corner of it may be missing)
//   slab:N:...     touching spheres on four layers of a square lattice across the cube, seen from their face: nothing to hide
//   dust:N:...     uniform centers, all radii such that about half of what one looks through is covered
//   sticks:N:...   cylinders with uniform centers and directions, as long as the mean spacing and a fifth as thick
//   arrows:N:...   the same as arrows, with half that shaft
//
// fit sees the whole cube, fill stands so near that every pixel is hit, inside stands in the cloud and cuts at
// near = 1 (the others need no cut: nothing lies before their near plane or behind their far plane). Frame k
// turns the camera by 0.5 k degrees about the vertical. Colors: a palette of eight, by id modulo 8, sRGB-encoded.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/math/camera.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mote {

enum class GeneratedKind : std::uint8_t { Spheres, Crystal, Slab, Dust, Sticks, Arrows };
enum class GeneratedCamera : std::uint8_t { Fit, Fill, Inside };
struct GeneratedName {
  std::uint64_t count{};
  GeneratedCamera camera{GeneratedCamera::Fit};
  std::uint64_t seed{1};
  std::int64_t frame{0};
  GeneratedKind kind{GeneratedKind::Spheres};
};

// True when the word before the first ':' is one that generates ("spheres", "dust", ...).
bool is_generated_name(std::string_view name);
// Throws Failure (Usage, S019 or S020) for a name that cannot be understood or made.
GeneratedName parse_generated_name(std::string_view name);

struct GeneratedParticles { // every value is a float32
  std::vector<double> positions{}; // x y z of each
  std::vector<double> radii{};
  std::vector<double> ends{};      // x y z of the other end; sticks and arrows
};
std::string_view particle_type_of(GeneratedKind kind);
GeneratedParticles generate_spheres(std::uint64_t count, std::uint64_t seed);
GeneratedParticles generate(const GeneratedName& name); // of any kind

Camera generated_camera(const GeneratedName& name);

// The camera turned about its up axis through its target, counter-clockwise seen from above, by `degrees`.
Camera turned(const Camera& camera, double degrees);
constexpr double degrees_per_frame = 0.5; // of generated scenes and of `mote bench`

extern const std::array<std::array<double, 3>, 8> generated_palette; // sRGB-encoded, 0..1

} // namespace mote
