// SPDX-License-Identifier: MIT
#include "passes/particles/pipelines.hpp"

#include "core/base/diagnostic.hpp"
#include "passes/particles/frame_uniform.hpp"
#include "passes/particles/particle_store.hpp"
#include "passes/particles/user_type.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace mote::passes {
namespace {
constexpr std::size_t most_pipelines = 256; // far above what scenes use; beyond it the cache starts anew

std::string fragment_of(const ParticlePipelineKey& key) {
  if (key.phase == Phase::Surface) return key.edges ? "surface.frag/edges" : "surface.frag";
  if (key.phase == Phase::Shadow) return key.targets.empty() ? "shadow.frag/depth" : "shadow.frag/ids";
  if (key.step != Step::Depth) return "steps.frag";
  return fmt::format("opaque.frag/aov{}", key.aovs);
}
}

std::string to_string(const ParticlePipelineKey& k) {
  return fmt::format("{}{}{} / {} / {} aov={} {} lights={}{} specular={}{}", k.type, k.affine ? " affine" : "", k.near_eye ? " near" : "", to_string(k.expansion), to_string(k.phase), k.aovs,
                     k.orthographic ? "orthographic" : "perspective", k.light_count, k.local_lights ? " local" : "",
                     k.specular_model, k.paletted ? " palette" : k.per_particle_color ? " colors" : "") + (k.head_light_only ? " head light" : "") + (k.step != Step::Depth ? " " + to_string(k.step) : "") + (k.box ? " box" : "");
}

ParticlePipelineKey key_for(const Scene& scene, const View& view, const Batch& batch) {
  ParticlePipelineKey key;
  key.type = batch.type;
  key.orthographic = view.projection == Projection::Orthographic;
  key.light_count = static_cast<std::uint32_t>(std::min<std::size_t>(scene.lights.size(), max_lights));
  key.local_lights = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& l) {
    return l.kind == LightKind::Point || l.kind == LightKind::Spot;
  });
  const Material& m = batch.material;
  if (m.specular > 0.0 && m.model == ShadingModel::Phong) key.specular_model = 1;
  if (m.specular > 0.0 && m.model == ShadingModel::BlinnPhong) key.specular_model = 2;
  key.per_particle_color = !batch.chunks->colors.empty();
  key.paletted = batch.chunks->paletted();
  key.head_light_only = key.specular_model == 0 && scene.lights.size() == 1 && scene.lights[0].kind == LightKind::Headlight;
  return key;
}

std::vector<gpu::SpecializationConstant> particle_constants(const ParticlePipelineKey& key) {
  return {gpu::spec(0, key.orthographic),       gpu::spec(1, key.light_count),
          gpu::spec(2, key.local_lights),       gpu::spec(3, key.specular_model),
          gpu::spec(4, key.per_particle_color), gpu::spec(5, key.show_depth_violation),
          gpu::spec(6, key.head_light_only),    gpu::spec(20, key.opaque_only),
          gpu::spec(21, key.states.blend != 0), gpu::spec(22, static_cast<std::uint32_t>(key.states.cull)), gpu::spec(7, key.proxy_slack),
          gpu::spec(8, key.type_number)};
}

ParticlePipelineKey key_for_all(const Scene& scene, const View& view, bool& mixed) {
  ParticlePipelineKey all = key_for(scene, view, scene.batches.front());
  all.paletted = false;
  mixed = false;
  for (const Batch& batch : scene.batches) {
    const ParticlePipelineKey own = key_for(scene, view, batch);
    mixed = mixed || (all.specular_model != 0 && own.specular_model != 0 && all.specular_model != own.specular_model);
    all.specular_model = std::max(all.specular_model, own.specular_model);
    all.per_particle_color = all.per_particle_color || own.per_particle_color;
    all.head_light_only = all.head_light_only && own.head_light_only;
  }
  return all;
}

void unlit(ParticlePipelineKey& key) {
  key.light_count = key.specular_model = 0;
  key.local_lights = key.head_light_only = false;
}

ParticlePipelines::ParticlePipelines(gpu::Device device, const gpu::BindGroupLayout& particles) : device_(std::move(device)) {
  const bool geometry = gpu::has(device_.features(), gpu::Feature::GeometryShader);
  const std::array entries{gpu::BindGroupLayoutEntry{
      .binding = 0,
      .visibility = gpu::ShaderStage::Vertex | gpu::ShaderStage::Fragment | gpu::ShaderStage::Compute | (geometry ? gpu::ShaderStage::Geometry : gpu::ShaderStage::None),
      .type = gpu::BindingType::UniformBuffer,
      .min_binding_size = sizeof(FrameBlock)}};
  frame_layout_ = device_.create_bind_group_layout({.label = "frame", .entries = entries});
  const std::array<const gpu::BindGroupLayout*, 2> layouts{&frame_layout_, &particles};
  layout_ = device_.create_pipeline_layout({.label = "particles", .bind_group_layouts = layouts, .push_constant_size = sizeof(BatchBlock)});
}

gpu::ShaderModule ParticlePipelines::module(const std::string& key) {
  gpu::ShaderModule& module = modules_[key];
  if (!module) {
    const auto words = particle_spirv(key);
    if (words.empty()) throw std::logic_error("no shipped shader '" + key + "'");
    module = device_.create_shader_module({.label = key, .spirv = words});
  }
  return module;
}

const gpu::RenderPipeline& ParticlePipelines::get(const ParticlePipelineKey& key) {
  if (auto it = pipelines_.find(key); it != pipelines_.end()) return it->second;
  if (pipelines_.size() >= most_pipelines) pipelines_.clear();

  const bool geometry = key.expansion == Expansion::Geometry;
  const bool point = key.expansion == Expansion::Point;
  const std::string folder = key.type + (key.affine ? "/affine" : "") + (key.near_eye ? "/near" : "");
  const gpu::ShaderModule vertex =
      module(folder + (key.box ? "/box.vert" : geometry ? "/geometry.vert" : point ? "/point.vert" : key.step == Step::Points ? "/fixed.vert" : "/vertex.vert"));
  const gpu::ShaderModule fragment = module(folder + "/" + fragment_of(key));
  const gpu::ShaderModule geometry_module = geometry ? module(folder + (key.box ? "/box.geom" : "/geometry.geom")) : gpu::ShaderModule();
  const std::vector<gpu::SpecializationConstant> constants = particle_constants(key);
  std::vector<gpu::SpecializationConstant> vertex_constants = constants, fragment_constants = constants;
  vertex_constants.push_back(gpu::spec(9, key.paletted)); // every expansion loads its particle there
  if (key.step != Step::Depth) fragment_constants.push_back(gpu::spec(27, static_cast<std::uint32_t>(key.step)));
  std::vector<gpu::ColorTargetState> targets;
  for (const gpu::TextureFormat format : key.targets)
    targets.push_back({.format = format, .write_mask = targets.size() < key.written ? gpu::ColorWrite::All : gpu::ColorWrite::None});
  if (!targets.empty()) targets[0].blend = unpack_blend(key.states.blend); // the AOVs behind it never blend

  gpu::RenderPipelineDescriptor descriptor{.label = "particles"};
  const std::string label = to_string(key);
  descriptor.label = label;
  descriptor.layout = &layout_;
  descriptor.vertex = {.module = &vertex, .constants = vertex_constants};
  if (geometry) descriptor.geometry = gpu::ProgrammableStage{.module = &geometry_module, .constants = constants};
  descriptor.fragment = gpu::ProgrammableStage{.module = &fragment, .constants = fragment_constants};
  descriptor.topology = geometry || point ? gpu::Topology::PointList : gpu::Topology::TriangleList;
  descriptor.depth = gpu::DepthState{.format = key.depth, .write = key.states.depth_write, .compare = encoded(key.states.depth_test)};
  descriptor.targets = targets;
  return pipelines_.emplace(key, device_.create_render_pipeline(descriptor)).first->second;
}

std::vector<std::string> ParticlePipelines::list() const {
  std::vector<std::string> names;
  for (const auto& [key, pipeline] : pipelines_) names.push_back(to_string(key));
  return names;
}

} // namespace mote::passes
