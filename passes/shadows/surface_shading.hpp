// SPDX-License-Identifier: MIT
// Deferred shading of a drawing pass whose lights have shadow maps: particles leave their surfaces
// (phase `surface`: color, id, normal, depth) in textures of this object, shadow masks are formed, and
// each pixel is shaded once, whatever the depth complexity. A shadow test in the fragment stage would
// run for every hidden fragment: lavapipe has no branches and depth comes late.
//
//   shading.update(scene, view, lights);                       // before recording
//   begin_render_pass(shading.attachments(), depth) ...        // draw particles with Phase::Surface
//   shading.record(encoder, frame_group, targets);             // masks, then shading into the pass's own targets
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/scene/scene.hpp"
#include "passes/shadows/shadow_masks.hpp"

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace mote::passes {

class SurfaceShading {
public:
  // `edges`: coverage at outlines is kept, too, and blended after shading; then record() writes the color only.
  SurfaceShading(gpu::Device device, const gpu::BindGroupLayout& frame_layout, bool edges = false);

  // Throws Failure: G071, P016 (more materials than a surface can tell apart).
  void update(const Scene& scene, const View& view, const std::vector<MappedLight>& lights);
  [[nodiscard]] std::vector<gpu::TextureFormat> formats() const; // of attachments(), for the pipelines that draw surfaces
  [[nodiscard]] std::vector<gpu::ColorAttachment> attachments() const; // cleared to "nothing is here"
  [[nodiscard]] bool edges() const { return edges_; }
  // The same, for what tiles leave; all may be copied to.
  [[nodiscard]] const gpu::Texture& color() const { return color_; }
  [[nodiscard]] const gpu::Texture& id() const { return id_; }
  [[nodiscard]] const gpu::Texture& normal_t() const { return normal_t_; }
  // Number of a batch's material, for BatchBlock::material.x; of batches of the scene that was given to update().
  [[nodiscard]] std::uint32_t material_of(const Batch& batch) const;

  // `colors`: what is shaded into, in slot order (color, then the AOVs of the mask `aovs`); their load operations
  // say what stays where no surface is.
  void record(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame, std::vector<gpu::ColorAttachment> colors, std::uint32_t aovs);

private:
  struct MaterialRow { // two vec4, as in shaders/shadow/shade.frag
    glm::vec4 values{0}, model{0};
    bool operator==(const MaterialRow&) const = default;
  };
  static MaterialRow row_of(const Material& material);
  struct Key {
    std::uint32_t aovs{}, light_count{}, specular_model{};
    bool orthographic{}, local_lights{}, masked{};
    std::vector<gpu::TextureFormat> targets{};
    auto operator<=>(const Key&) const = default;
  };
  void make_tables(const Scene& scene, const std::vector<MappedLight>& lights);
  void make_group();
  void make_edge_pipeline(gpu::TextureFormat target);
  void shade(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame, std::span<const gpu::ColorAttachment> colors, std::uint32_t aovs);
  const gpu::RenderPipeline& pipeline(const Key& key);

  gpu::Device device_;
  ShadowMasks masks_;
  gpu::BindGroupLayout layout_;
  gpu::PipelineLayout pipeline_layout_;
  std::map<Key, gpu::RenderPipeline> pipelines_;
  gpu::Texture color_, id_, normal_t_, no_masks_;
  gpu::TextureView color_view_, id_view_, normal_t_view_, no_masks_view_;
  gpu::Buffer tables_;
  gpu::TextureView bound_masks_;
  gpu::BindGroup group_;
  std::vector<MaterialRow> materials_; // different ones of the scene
  std::vector<std::uint32_t> models_; // that the scene uses
  // Analytic edges: coverage, the shaded picture, and their pipeline.
  bool edges_;
  gpu::Texture edge_, picture_;
  gpu::TextureView edge_view_, picture_view_;
  gpu::BindGroupLayout edge_layout_;
  gpu::PipelineLayout edge_pipeline_layout_;
  gpu::RenderPipeline edge_pipeline_;
  gpu::TextureFormat edge_target_{};
  gpu::BindGroup edge_group_;
  Key frame_key_;                     // of this frame, without aovs, model and targets
};

} // namespace mote::passes
