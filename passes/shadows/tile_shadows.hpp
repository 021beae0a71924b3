// SPDX-License-Identifier: MIT
// Shadow maps as the tiles' cast kernel asks them when it shades at once what it has cast: bindings and constants of
// shaders/shadow/lit.glsl. What that cannot hold (maps that are not in buffers: of method `depth`, drawn by quads, of casters
// that are no spheres; more than four) is shaded later, by SurfaceShading.
#pragma once

#include "core/gpu/gpu.hpp"
#include "passes/shadows/shadow_masks.hpp"

#include <array>
#include <compare>
#include <vector>

namespace mote::passes {

class TileShadows {
public:
  static constexpr std::size_t most_maps = 4;
  struct Key { // what pipelines depend on
    static constexpr std::uint32_t no_light = 0xFFFFFFFFu;
    std::uint32_t maps{};
    std::array<std::uint32_t, most_maps> lights{no_light, no_light, no_light, no_light}; // of the scene, by map
    std::uint32_t orthographic{};                                                        // bit k: map k's
    std::uint32_t by_id{};                                                               // bit k: map k's casters lie by id
    auto operator<=>(const Key&) const = default;
  };

  explicit TileShadows(gpu::Device device);
  [[nodiscard]] static bool can_hold(const std::vector<MappedLight>& lights);
  // Before recording. `lights`: can_hold() them.
  void update(const std::vector<MappedLight>& lights, const View& camera);

  [[nodiscard]] const Key& key() const { return key_; }
  [[nodiscard]] const gpu::BindGroupLayout& layout() const { return layout_; }
  [[nodiscard]] const gpu::BindGroup& group() const { return group_; }

private:
  gpu::Device device_;
  Key key_;
  gpu::BindGroupLayout layout_;
  gpu::Buffer blocks_, none_; // none_: where a scene has fewer maps
  gpu::BindGroup group_;
};

} // namespace mote::passes
