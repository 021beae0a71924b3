// SPDX-License-Identifier: MIT
// Particle types from files (core/scene/user_type.hpp) on the device: their place in the list of types, their shaders, compiled
// from type.glsl by the key that a shipped one would have (shaders/embedded.hpp) when they are first asked for, and kernels that ask
// type.glsl itself: how large particles are, and, compiled with double, where rays meet them. Types stay known until the program
// ends; a text that has changed is a type of its own. One thread.
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/scene/user_type.hpp"
#include "passes/runtime_shaders.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mote::passes {

// Makes the type known and names it (type.key). False after an error (P022, at the line of type.glsl).
bool take_type(UserType& type, const std::string& cache_directory, Diagnostics& diagnostics);

// SPIR-V by key, of shipped types and those from files. Empty: there is none. Throws Failure (P002).
std::span<const std::uint32_t> particle_spirv(const std::string& key);
// What #include "type.glsl" finds, and what that needs.
std::vector<MadeText> type_texts(const std::string& type);

// Records behind their first vec4. At most 1024 of them, evenly spread, are tried with rays.
std::vector<MeasuredParticle> measure(gpu::Device device, const UserType& type, std::span<const glm::vec4> records);

// The type as its own twin in double. Rays o + t d in the particle's axes, o near its center.
struct TwinRay {
  glm::dvec3 o{0}, d{0}, lengths{0};
  glm::dvec2 numbers{0};
};
struct TwinHit {
  bool met{};
  double t_in{}, t_out{};
  glm::dvec3 n_in{0}, n_out{0}; // unit, outward
};
// Needs Feature::ShaderFloat64.
std::vector<TwinHit> cast_in_double(gpu::Device device, const UserType& type, std::span<const TwinRay> rays);

} // namespace mote::passes
