// SPDX-License-Identifier: MIT
// How much of each mapped light reaches each pixel's surface: one full-screen pass a shadow map,
// from the textures of phase `surface` into one layer of an r8unorm array. Any number of lights.
// A map of casters is asked once for every particle type among them.
// Called by SurfaceShading.
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/scene/scene.hpp"
#include "passes/shadows/shadow_maps.hpp"

#include <glm/glm.hpp>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace mote::passes {

struct MappedLight {
  gpu::Texture map{};
  ShadowMapInfo info{};
  MapInBuffers* buffers{}; // null: it is in the texture
};

// How a light's space follows from the camera's; std140, as in shaders/shadow/receiver.glsl and lit.glsl.
struct ShadowBlock {
  std::array<glm::vec4, 3> light_from_view{};
  glm::vec4 offset{0}, map{0}, bias{0};
};
// Formed in double and rounded once, like all changes of space.
ShadowBlock shadow_block(const ShadowMapInfo& info, const View& camera);

class ShadowMasks {
public:
  // `frame_layout`: of set 0, the frame block (ParticlePipelines::frame_layout()).
  ShadowMasks(gpu::Device device, const gpu::BindGroupLayout& frame_layout);

  // Before recording: sizes the masks and uploads how each light's space follows from the camera's. At least one light.
  void update(const std::vector<MappedLight>& lights, const View& camera);
  // Draws all layers. `id` and `normal_t` as phase `surface` writes them.
  void record(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame, const gpu::TextureView& id, const gpu::TextureView& normal_t, bool orthographic);
  [[nodiscard]] const gpu::TextureView& masks() const { return all_; } // 2D array, one layer a light

private:
  struct Layer {
    gpu::TextureView target{};
    gpu::Buffer block{};
    gpu::BindGroup group{};
    gpu::Texture map{};
    bool ids{}, orthographic{};
    std::uint32_t pcf{};
    std::vector<std::string> types{};
  };
  struct Key {
    bool ids{}, orthographic{}, light_orthographic{};
    std::uint32_t pcf{};
    std::string type{}; // ids: of the casters
    bool further{};     // multiplied with what other types let through
    auto operator<=>(const Key&) const = default;
  };
  const gpu::RenderPipeline& pipeline(const Key& key);
  void draw(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame, const Layer& layer, const Key& key);

  gpu::Device device_;
  gpu::BindGroupLayout surface_layout_, ids_layout_, depth_layout_;
  gpu::PipelineLayout ids_pipeline_layout_, depth_pipeline_layout_;
  std::map<Key, gpu::RenderPipeline> pipelines_;
  gpu::Texture texture_;
  gpu::TextureView all_;
  std::vector<Layer> layers_;
  gpu::TextureView id_, normal_t_;
  gpu::BindGroup surface_;
};

} // namespace mote::passes
