// SPDX-License-Identifier: MIT
// What the shadow maps of a frame were drawn from, by texture: `shadow_map` passes publish, drawing
// passes that take the texture as an input look it up. A texture alone does not say which light and
// view it belongs to. ParticleStore holds one; no device objects are kept alive by it.
//
// Texel of a map of method `ids`: rgba32uint, a few layers; an expansion of any kind may produce it.
//   layer 0  bits of the caster's first payload vec4 in the light's view space (sphere: center, radius)
//   layer 1  x: the caster's id; y: the number of its type; zw: nothing
//   layer 2+ the rest of the payload, of types that have more
// Tiles keep layer 0 and the ids of layer 1 in two buffers: ids by texel, tile by tile (work.glsl), payloads like them or by id.
// The caster is the nearest to the light at the texel's center. No caster: 0xFFFFFFFF in every word that is something.
// A map of method `depth` is a depth texture of n / z in the light's view (orthographic: z counts from
// the view's eye plane), 0 where nothing is.
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/math/camera.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
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

// A map of spheres that tiles have drawn and left in their buffers, since only passes read it that ask here: the texture
// of the graph is not touched then.
class MapInBuffers {
public:
  struct Buffers {
    gpu::Buffer casters{}, ids{};
    bool by_id{}; // casters lie by id, else by texel as ids do
  };
  using Mark = std::function<void(std::string_view stage)>;
  virtual ~MapInBuffers() = default;
  [[nodiscard]] virtual Buffers buffers() const = 0;
  // The same map drawn again, for who reads a texture.
  virtual gpu::Texture draw_texture(gpu::CommandEncoder& encoder, const Mark& mark) = 0;
};

class ShadowMaps {
public:
  // A number for the texture's map, from 0, the same as long as the texture lives.
  std::uint32_t number_of(const gpu::Texture& map);
  // `buffers`: where the map is instead; alive until the frame is recorded.
  void publish(const gpu::Texture& map, const ShadowMapInfo& info, MapInBuffers* buffers = nullptr);
  void withdraw(const gpu::Texture& map); // the light reaches nothing in this frame
  [[nodiscard]] const ShadowMapInfo* find(const gpu::Texture& map) const;
  [[nodiscard]] MapInBuffers* in_buffers(const gpu::Texture& map) const; // null: it is in its texture

private:
  struct Entry {
    std::weak_ptr<gpu::Texture::Impl> texture{};
    bool valid{};
    MapInBuffers* buffers{};
    ShadowMapInfo info{};
  };
  std::vector<Entry> entries_{};
};

} // namespace mote::passes
