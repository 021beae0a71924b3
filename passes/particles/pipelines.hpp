// SPDX-License-Identifier: MIT
// Render pipelines of particle draws: one for each combination that a scene needs, made when first
// asked for and kept. lavapipe has no real branches, so what differs between combinations is a
// specialization constant or a shader variant, never an `if` on a uniform. The cache is bounded and
// can be listed.
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/scene/scene.hpp"
#include "passes/particles/particle_type.hpp"
#include "passes/particles/steps.hpp"
#include "passes/states.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mote::passes {

// Bits of the AOV mask, in attachment order.
enum AovBits : std::uint32_t { aov_depth_bit = 1, aov_id_bit = 2, aov_normal_bit = 4 };

struct ParticlePipelineKey {
  std::string type{};
  Expansion expansion{Expansion::Vertex}; // never Auto
  Phase phase{Phase::Opaque};
  std::uint32_t aovs{};
  bool near_eye{}, affine{}; // as the draw says (ParticleDraw)
  bool orthographic{};
  std::uint32_t light_count{};
  bool local_lights{};
  std::uint32_t specular_model{}; // 0 none, 1 Phong, 2 Blinn-Phong
  bool per_particle_color{}, paletted{}; // its colors are indices of a palette
  bool head_light_only{};
  bool show_depth_violation{};
  bool opaque_only{}; // particles of alpha below 1 draw as nothing
  DrawStates states{};
  float proxy_slack{}; // pixels
  bool edges{};        // phase Surface: coverage, too; by tiles: layers (tiles/layers.glsl)
  bool box{};          // expansion Geometry: faces of a box in place of a rectangle
  std::uint32_t written{0xFFFFFFFF}; // targets from this one on are left alone
  Step step{Step::Depth};            // phase Opaque, without AOVs
  std::uint32_t type_number{};       // phase Shadow: what a map of casters says
  std::vector<gpu::TextureFormat> targets{};
  gpu::TextureFormat depth{};
  auto operator<=>(const ParticlePipelineKey&) const = default;
};
std::string to_string(const ParticlePipelineKey& key);

// What a batch of a scene needs; targets, aovs, phase and expansion are the pass's to fill in.
ParticlePipelineKey key_for(const Scene& scene, const View& view, const Batch& batch);

// The specialization constants that all stages of particle shaders know.
std::vector<gpu::SpecializationConstant> particle_constants(const ParticlePipelineKey& key);

// The same for all batches of a scene at once, as the tiles need it: the widest of what any of them needs. Phong and
// Blinn-Phong in one scene are beyond it: then `mixed` is set.
ParticlePipelineKey key_for_all(const Scene& scene, const View& view, bool& mixed);

// Takes lights and shading out of a key: for phases that do not shade.
void unlit(ParticlePipelineKey& key);

class ParticlePipelines {
public:
  // Sets: 0 the frame block, 1 the particles (ParticleStore::layout()).
  ParticlePipelines(gpu::Device device, const gpu::BindGroupLayout& particles);
  [[nodiscard]] const gpu::RenderPipeline& get(const ParticlePipelineKey& key);
  [[nodiscard]] const gpu::BindGroupLayout& frame_layout() const { return frame_layout_; }
  [[nodiscard]] std::vector<std::string> list() const;

private:
  gpu::ShaderModule module(const std::string& key);
  gpu::Device device_;
  gpu::BindGroupLayout frame_layout_;
  gpu::PipelineLayout layout_;
  std::map<std::string, gpu::ShaderModule> modules_;
  std::map<ParticlePipelineKey, gpu::RenderPipeline> pipelines_;
};

} // namespace mote::passes
