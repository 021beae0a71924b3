// SPDX-License-Identifier: MIT
// The light that a surface sends to the eye, in double: the equation at the head of scene.hpp,
// word for word, and the exact sRGB decoding of particle colors. Called per pixel by the reference;
// shares nothing with the shaders. Colors are linear Rec.709, not clamped.
#pragma once

#include "core/reference/tracer.hpp"

#include <glm/glm.hpp>

#include <cstdint>

namespace mote::reference {

// IEC 61966-2-1: the piecewise curve, [0, 1] to [0, 1].
double srgb_to_linear(double encoded);

// The particle's own color, or its batch's.
glm::dvec3 particle_color(const World& world, const Placed& placed, std::uint32_t record);

// A surface that a ray meets.
struct SurfacePoint {
  const Placed& placed;
  std::uint32_t record{};
  std::uint64_t id{};
  Ray ray{}; // world axes, relative to the eye
  double t{};
  glm::dvec3 normal{0}; // turned to the eye
};
// Its scene-linear light. `shadows` as below.
glm::dvec3 shade_surface(const Tracer& tracer, const SurfacePoint& at, bool shadows);

// Light arriving from `light` at `position` (world axes, relative to the eye). `eye` in world space,
// `forward` the camera's axis (head lights).
struct Arriving {
  glm::dvec3 to_light{0}; // unit
  glm::dvec3 strength{0};
  double distance{}; // infinite for directional lights
};
Arriving arriving(const Light& light, const glm::dvec3& position, const glm::dvec3& eye,
                  const glm::dvec3& forward);

// S of the material's model for one light; n.l > 0.
double specular(const Material& material, const glm::dvec3& normal, const glm::dvec3& to_light,
                const glm::dvec3& to_eye);

// Scene-linear light of the sample, or the background; straight alpha. `shadows`: lights with shadows = true
// send nothing where another particle lies between (opaque particles only).
glm::dvec4 shade(const Tracer& tracer, const Sample& sample, const glm::dvec3& normal, bool shadows);

} // namespace mote::reference
