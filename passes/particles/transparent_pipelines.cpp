// SPDX-License-Identifier: MIT
#include "passes/particles/transparent_pipelines.hpp"

#include "passes/particles/frame_uniform.hpp"
#include "passes/particles/user_type.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <vector>

namespace mote::passes {
namespace {

using gpu::BlendFactor;

constexpr std::size_t most_pipelines = 256; // far above what scenes use; beyond it the cache starts anew

constexpr gpu::BlendComponent component(BlendFactor source, BlendFactor destination) {
  return {source, destination, gpu::BlendOperation::Add};
}

std::vector<gpu::ColorTargetState> targets_of(const TransparentKey& key) {
  std::vector<gpu::ColorTargetState> targets;
  for (const gpu::TextureFormat format : key.particle.targets) targets.push_back({.format = format});
  constexpr auto sum = component(BlendFactor::One, BlendFactor::One);
  constexpr auto product = component(BlendFactor::Zero, BlendFactor::OneMinusSrc);
  constexpr auto under = component(BlendFactor::OneMinusDstAlpha, BlendFactor::One);
  switch (key.layering) {
  case Layering::Sorted:
  case Layering::SortedDepth:
    targets.at(0).blend = key.straight ? unpack_blend(key.particle.states.blend) : key.under ? gpu::BlendState{under, under} : blend_over_premultiplied();
    break;
  case Layering::Weighted:
    targets.at(0).blend = gpu::BlendState{sum, sum};
    targets.at(1).blend = gpu::BlendState{product, product};
    break;
  case Layering::Exact: targets.at(0).write_mask = gpu::ColorWrite::None; break;
  }
  return targets;
}

std::optional<gpu::DepthState> depth_of(const TransparentKey& key) {
  const DrawStates& states = key.particle.states;
  if (key.layering == Layering::SortedDepth)
    return gpu::DepthState{.format = key.particle.depth, .write = states.depth_write, .compare = encoded(states.depth_test)};
  if (key.saturation) return gpu::DepthState{.format = gpu::TextureFormat::Depth32Float, .write = false, .compare = gpu::CompareFunction::Greater};
  return std::nullopt;
}

} // namespace

TransparentPipelines::TransparentPipelines(gpu::Device device, const gpu::BindGroupLayout& ordered) : device_(std::move(device)) {
  const bool geometry = gpu::has(device_.features(), gpu::Feature::GeometryShader);
  const std::array frame{gpu::BindGroupLayoutEntry{
      .binding = 0,
      .visibility = gpu::ShaderStage::Vertex | gpu::ShaderStage::Fragment | (geometry ? gpu::ShaderStage::Geometry : gpu::ShaderStage::None),
      .type = gpu::BindingType::UniformBuffer,
      .min_binding_size = sizeof(FrameBlock)}};
  frame_layout_ = device_.create_bind_group_layout({.label = "frame", .entries = frame});
  const std::array depth{gpu::BindGroupLayoutEntry{.binding = 0,
                                                   .visibility = gpu::ShaderStage::Fragment,
                                                   .type = gpu::BindingType::SampledTexture,
                                                   .sample_type = gpu::SampleType::UnfilterableFloat}};
  depth_layout_ = device_.create_bind_group_layout({.label = "transparent.depth", .entries = depth});
  std::array<gpu::BindGroupLayoutEntry, 3> lists;
  for (std::uint32_t i = 0; i < lists.size(); ++i)
    lists[i] = {.binding = i, .visibility = gpu::ShaderStage::Fragment, .type = gpu::BindingType::StorageBuffer};
  lists_layout_ = device_.create_bind_group_layout({.label = "transparent.lists", .entries = lists});
  const std::array<const gpu::BindGroupLayout*, 4> groups{&frame_layout_, &ordered, &depth_layout_, &lists_layout_};
  layout_ = device_.create_pipeline_layout(
      {.label = "transparent", .bind_group_layouts = std::span(groups).first(3), .push_constant_size = sizeof(TransparentBlock)});
  exact_layout_ = device_.create_pipeline_layout({.label = "transparent.exact", .bind_group_layouts = groups, .push_constant_size = sizeof(TransparentBlock)});
}

gpu::ShaderModule TransparentPipelines::module(const std::string& key) {
  gpu::ShaderModule& module = modules_[key];
  if (!module) {
    const auto words = particle_spirv(key);
    if (words.empty()) throw std::logic_error("no shipped shader '" + key + "'");
    module = device_.create_shader_module({.label = key, .spirv = words});
  }
  return module;
}

const gpu::RenderPipeline& TransparentPipelines::get(const TransparentKey& key) {
  if (auto it = pipelines_.find(key); it != pipelines_.end()) return it->second;
  if (pipelines_.size() >= most_pipelines) pipelines_.clear();

  const ParticlePipelineKey& particle = key.particle;
  const bool geometry = particle.expansion == Expansion::Geometry;
  const std::string folder = particle.type + (particle.affine ? "/affine" : "") + (particle.near_eye ? "/near" : "");
  const gpu::ShaderModule vertex = module(folder + (geometry ? "/ordered/geometry.vert" : "/ordered/vertex.vert"));
  const gpu::ShaderModule fragment = module(fmt::format("{}/transparent.frag/mode{}", folder, static_cast<int>(key.layering)));
  const gpu::ShaderModule geometry_module = geometry ? module(folder + "/ordered/geometry.geom") : gpu::ShaderModule();
  std::vector<gpu::SpecializationConstant> constants = particle_constants(particle);
  const std::vector<gpu::SpecializationConstant> expansion = constants;
  constants.push_back(gpu::spec(23, key.two_surfaces));
  constants.push_back(gpu::spec(24, static_cast<std::uint32_t>(particle.states.depth_test) - 1u));
  constants.push_back(gpu::spec(25, key.has_depth));
  constants.push_back(gpu::spec(26, key.straight));

  const std::vector<gpu::ColorTargetState> targets = targets_of(key);
  const std::string label = to_string(particle);
  gpu::RenderPipelineDescriptor descriptor{.label = label};
  descriptor.layout = key.layering == Layering::Exact ? &exact_layout_ : &layout_;
  descriptor.vertex = {.module = &vertex, .constants = expansion};
  if (geometry) descriptor.geometry = gpu::ProgrammableStage{.module = &geometry_module, .constants = expansion};
  descriptor.fragment = gpu::ProgrammableStage{.module = &fragment, .constants = constants};
  descriptor.topology = geometry ? gpu::Topology::PointList : gpu::Topology::TriangleList;
  descriptor.depth = depth_of(key);
  descriptor.targets = targets;
  return pipelines_.emplace(key, device_.create_render_pipeline(descriptor)).first->second;
}

} // namespace mote::passes
