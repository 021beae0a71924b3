// SPDX-License-Identifier: MIT
// A particle type that a user brings: a folder with type.toml (name, attributes) and type.glsl (the surface, in a scalar `real`).
// A scene names folders in `particle_types`. Here is what the CPU needs of one: which columns become numbers of the
// record. What only the shader can say (how large a particle is) is asked through `measure`, which app/library/user_types.hpp sets
// and passes/particles/user_type.hpp answers; without it nothing of the type can be realized. Reads two files, knows no device.
//
// Records are those of shaders/particles/oriented.glsl: a quaternion, up to three lengths (which placements scale), up to two
// other numbers.
#pragma once

#include "core/base/diagnostic.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote {

struct UserAttribute {
  std::string name{};                // a column, unless the scene names another one
  bool length{true};                 // in data units; else a plain number
  std::optional<double> otherwise{}; // where there is no column
};

// What the shader says of one particle.
struct MeasuredParticle {
  glm::vec3 half{0};         // half extents of its box, along its own axes; not positive or not finite: no shape
  std::uint32_t rays{};      // that were tried; 0: only the box was asked for
  std::uint32_t nan{};       // of them, hit() gave NaN
  std::uint32_t disagree{};  // hit() and inside() say different things
  std::uint32_t outside{};   // inside() says that points beyond bound() belong to it
};

struct UserType {
  std::string name{}, summary{};
  std::string key{};                       // Batch::type: the name, or one of its own where another text had the name before
  std::filesystem::path folder{};
  std::string glsl{};                      // type.glsl
  std::vector<UserAttribute> attributes{}; // lengths first
  SourceLoc loc{};                         // where the scene names it
  // Records behind their first vec4, three vec4s each. Empty: nobody can.
  std::function<std::vector<MeasuredParticle>(std::span<const glm::vec4>)> measure{};
  [[nodiscard]] std::string shader() const { return (folder / "type.glsl").string(); }
};

constexpr std::size_t most_user_lengths = 3, most_user_numbers = 2;
constexpr std::uint32_t user_record_vec4s = 4;

// Null after an error (S063, S003...S007).
std::shared_ptr<UserType> read_user_type(const std::filesystem::path& folder, const SourceLoc& loc, Diagnostics& diagnostics);

} // namespace mote
