// SPDX-License-Identifier: MIT
// A scene ready to be drawn: values only, colors in the working space (linear Rec.709), angles in
// radians. The passes and the reference read the same Scene; scene_file.hpp makes one from a TOML
// file, particle files or a generated name.
//
// Light reaching the eye from a surface point with unit normal n (turned to the eye), unit vector v
// to the eye, particle color c, material (ka, kd, ks, e), and lights j with unit vector l_j to
// the light and strength L_j = color * intensity * attenuation * spot factor:
//
//   c * (ka * ambient + kd * sum_j L_j max(0, n.l_j)) + ks * sum_j L_j S_j,   S_j = 0 where n.l_j <= 0
//   phong        S = max(0, r.v)^e,  r = 2 (n.l) n - l          (Phong 1975)
//   blinn_phong  S = max(0, n.h)^e,  h = normalize(l + v)       (Blinn 1977)
//   lambert      S = 0
//
// with x^0 = 1. The result is scene-linear and not clamped.
#pragma once

#include "core/math/camera.hpp"
#include "core/scene/annotations.hpp"
#include "core/scene/chunks.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mote {

enum class ShadingModel : std::uint8_t { Lambert, Phong, BlinnPhong };
struct Material {
  ShadingModel model{ShadingModel::Phong};
  double ambient{1.0}, diffuse{1.0}, specular{0.0}; // each >= 0
  double exponent{32.0};                            // >= 0
  bool operator==(const Material&) const = default;
};

enum class LightKind : std::uint8_t { Directional, Point, Spot, Headlight };
// Headlight: directional along the camera's forward axis. Point and spot: attenuation
// 1 / (a.x + a.y d + a.z d^2) at distance d. Spot: 1 inside inner_angle, 0 outside outer_angle (both measured
// from the axis), smoothstep of the cosine between.
struct Light {
  std::string name{};
  LightKind kind{LightKind::Headlight};
  glm::dvec3 direction{0, 0, -1}; // world, of the light's travel, unit; directional and spot
  glm::dvec3 position{0};         // world; point and spot
  glm::dvec3 color{1};            // working space
  double intensity{1.0};
  glm::dvec3 attenuation{1, 0, 0};
  double inner_angle{0.0}, outer_angle{0.5}; // radians
  bool shadows{false};
};

struct Instance {
  glm::dmat4 world_from_data{1.0}; // affine
};

struct Batch {
  std::string name{};                     // for messages: the file
  std::string type{"sphere"};             // particle type
  std::shared_ptr<const ChunkSet> chunks{};
  std::vector<Instance> instances{};      // at least one
  Material material{};
  glm::dvec3 color{0.8};                  // working space; used when chunks->colors is empty
  double alpha{1.0};
  double density{};                       // above 0: absorption per length in place of alpha, which is then below 1 and else unused
  std::uint64_t id_base{};                // id of particle i of instance k: id_base + k * row_count + row
  std::uint64_t row_count{};              // rows in the file, skipped ones included
  std::uint32_t data{}, group{};          // which data set of the scene it is of, and which of its groups of rows with copies of their own
};

struct Scene {
  Camera camera{};
  glm::dvec4 background{1};      // working space, straight alpha
  glm::dvec3 ambient{0.2};       // color * intensity, working space
  std::vector<Light> lights{};
  std::vector<Batch> batches{};
  Bounds bounds{};               // of all instances, world
  Annotations annotations{};     // what is written over the picture; no pass looks at it
  [[nodiscard]] std::uint64_t particle_count() const; // instances times rows, skipped ones included
};

// The scale factor of a similarity (rotation or reflection, uniform scale, translation) within 1e-9 relative, or
// nullopt for any other matrix.
std::optional<double> similarity_scale(const glm::dmat4& m);

} // namespace mote
