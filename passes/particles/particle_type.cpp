// SPDX-License-Identifier: MIT
#include "passes/particles/particle_type.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace mote::passes {
namespace {

// One line a type.
const std::vector<Expansion> rectangles{Expansion::Vertex, Expansion::Geometry, Expansion::Compute}; // a point's square suits spheres only
const std::vector<Expansion> with_points{Expansion::Vertex, Expansion::Geometry, Expansion::Compute, Expansion::Point};
const std::vector<Phase> all_phases{Phase::Opaque, Phase::Surface, Phase::Transparent, Phase::Shadow};
constexpr std::size_t most_types = 256; // pointers into the list stay
std::vector<ParticleType> types{
    {"sphere", "center, radius", 1, 1, true, with_points, all_phases},
    {"capsule", "a segment and a radius: a cylinder with round ends", 2, 2, false, rectangles, all_phases},
    {"ellipsoid", "three axes of their own length and direction", 3, 4, false, rectangles, all_phases},
    {"box", "three axes of their own length and direction", 3, 4, false, rectangles, all_phases},
    {"superquadric", "three axes and two exponents (Barr): from octahedron over ellipsoid to box", 4, 4, false, rectangles, all_phases},
    {"cylinder", "a segment and two radii, flat or open ends", 3, 3, false, rectangles, all_phases, true},
    {"cone", "a segment and two radii (one may be 0), closed", 3, 3, false, rectangles, all_phases, true},
    {"arrow", "a segment, shaft and head as one solid", 3, 3, false, rectangles, all_phases},
    {"polyline", "a chain of segments and a radius, smooth at its joints", 4, 4, false, rectangles, all_phases},
};

constexpr std::array expansions{Expansion::Vertex, Expansion::Geometry, Expansion::Compute, Expansion::Point};
constexpr std::array phases{Phase::Opaque, Phase::Surface, Phase::Transparent, Phase::Shadow};

} // namespace

std::string_view to_string(Phase phase) {
  switch (phase) {
  case Phase::Opaque: return "opaque";
  case Phase::Transparent: return "transparent";
  case Phase::Surface: return "surface";
  case Phase::Shadow: return "shadow";
  }
  return "opaque";
}

void add_particle_type(ParticleType type) {
  types.reserve(most_types);
  if (types.size() < most_types) types.push_back(std::move(type));
}

std::span<const ParticleType> particle_types() { return types; }

const ParticleType* find_particle_type(std::string_view name) {
  const auto it = std::find_if(types.begin(), types.end(), [&](const ParticleType& t) { return t.name == name; });
  return it == types.end() ? nullptr : &*it;
}

std::uint32_t number_of(const ParticleType& type) { return static_cast<std::uint32_t>(&type - types.data()); }

std::vector<std::string> particle_type_names() {
  std::vector<std::string> names;
  for (const ParticleType& type : types) names.push_back(type.name);
  return names;
}

bool supports(const ParticleType& type, Expansion expansion, Phase phase) {
  // A tile keeps the nearest surface only; sprites are drawn apart from what does not fit them, so in no one order.
  if (expansion == Expansion::Compute && phase == Phase::Transparent) return false;
  if (expansion == Expansion::Point && phase != Phase::Opaque && phase != Phase::Surface) return false;
  return std::count(type.expansions.begin(), type.expansions.end(), expansion) > 0 &&
         std::count(type.phases.begin(), type.phases.end(), phase) > 0;
}

std::string support_matrix() {
  std::string out = fmt::format("{:<12}{:<12}", "type", "expansion");
  for (Phase phase : phases) out += fmt::format("{:<12}", to_string(phase));
  out += "\n";
  for (const ParticleType& type : types)
    for (Expansion expansion : expansions) {
      out += fmt::format("{:<12}{:<12}", type.name, to_string(expansion));
      for (Phase phase : phases) out += fmt::format("{:<12}", supports(type, expansion, phase) ? "yes" : "no");
      out += "\n";
    }
  return out;
}

} // namespace mote::passes
