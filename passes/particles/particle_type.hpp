// SPDX-License-Identifier: MIT
// The plugin interface of particle types, and their list. A type is a folder of shaders
// (shaders/particles/<name>/type.glsl: record, place, proxy, intersect), an intersector of the
// reference (core/reference) and one row of this list; docs/add-a-particle-type.md walks through it.
//
// What a type, an expansion and a phase cannot do together is a row of the support matrix that
// `mote graph --kinds` prints, and an error with a code (P001); never a silent fallback.
#pragma once

#include "passes/frame.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::passes {

enum class Phase : std::uint8_t { Opaque, Surface, Transparent, Shadow };
std::string_view to_string(Phase phase);

constexpr std::uint32_t most_payload_vec4s = 4; // a texel of a shadow map holds them

struct ParticleType {
  std::string name{};             // also the shader folder
  std::string summary{};
  std::uint32_t vec4s_per_record{};
  std::uint32_t vec4s_per_payload{}; // CASTER_VEC4S of its shader; at most most_payload_vec4s
  bool analytic_edges{};             // its shader's outline() is more than covered or not
  std::vector<Expansion> expansions{};
  std::vector<Phase> phases{};
  bool boxes{};                      // expand/box.geom draws it, too
};

std::span<const ParticleType> particle_types();
void add_particle_type(ParticleType type); // one from files (user_type.hpp); before anything holds a pointer into the list
const ParticleType* find_particle_type(std::string_view name);
std::uint32_t number_of(const ParticleType& type); // its place in the list
std::vector<std::string> particle_type_names();
bool supports(const ParticleType& type, Expansion expansion, Phase phase);

// "type  expansion  opaque  surface  shadow" rows for people.
std::string support_matrix();

} // namespace mote::passes
