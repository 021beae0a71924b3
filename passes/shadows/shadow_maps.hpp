// SPDX-License-Identifier: MIT
// What the shadow maps of a frame were drawn from, by texture: `shadow_map` passes publish, drawing
// passes that take the texture as an input look it up. A texture alone does not say which light and
// view it belongs to. ParticleStore holds one; no device objects are kept alive by it.
//
// Texel of a map of method `ids`: rgba32uint, a few layers; an expansion of any kind may produce it.
//   layer 0  bits of the caster's first payload vec4 in the light's view space (sphere: center, radius)
//   layer 1  x: the caster's id; y: the number of its type; zw: nothing
//   layer 2+ the rest of the payload, of types that have more
// The caster is the nearest to the light at the texel's center. No caster: 0xFFFFFFFF in every word that is something.
// A map of method `depth` is a depth texture of n / z in the light's view (orthographic: z counts from
// the view's eye plane), 0 where nothing is.
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/math/camera.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace mote::passes {

struct ShadowMapInfo {
  std::size_t light{};        // of scene.lights
  View view{};                // the light's; its size is the map's
  bool ids{true};             // analytic test against stored casters; else compared depths
  double normal_offset{1.0};  // method depth: times the least offset that leaves no acne
  std::uint32_t pcf{1};       // method depth: (2 pcf + 1)^2 texels
  std::vector<std::string> types{}; // method ids: of the casters
};

class ShadowMaps {
public:
  // A number for the texture's map, from 0, the same as long as the texture lives.
  std::uint32_t number_of(const gpu::Texture& map);
  void publish(const gpu::Texture& map, const ShadowMapInfo& info);
  void withdraw(const gpu::Texture& map); // the light reaches nothing in this frame
  [[nodiscard]] const ShadowMapInfo* find(const gpu::Texture& map) const;

private:
  struct Entry {
    std::weak_ptr<gpu::Texture::Impl> texture{};
    bool valid{};
    ShadowMapInfo info{};
  };
  std::vector<Entry> entries_{};
};

} // namespace mote::passes
