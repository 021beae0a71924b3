// SPDX-License-Identifier: MIT
#include "passes/shadows/surface_shading.hpp"

#include "core/base/diagnostic.hpp"
#include "passes/full_screen.hpp"
#include "passes/particles/frame_uniform.hpp"
#include "passes/particles/pipelines.hpp"
#include "passes/scratch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::passes {
namespace {

using gpu::TextureFormat;

constexpr std::size_t most_materials = 2048; // whole numbers that a half float holds

std::uint32_t model_of(const Material& m) {
  if (m.specular > 0.0 && m.model == ShadingModel::Phong) return 1;
  return m.specular > 0.0 && m.model == ShadingModel::BlinnPhong ? 2 : 0;
}

} // namespace

SurfaceShading::SurfaceShading(gpu::Device device, const gpu::BindGroupLayout& frame_layout, bool edges)
    : device_(std::move(device)), masks_(device_, frame_layout), edges_(edges) {
  const auto texture = [](std::uint32_t binding, gpu::SampleType type, gpu::TextureViewDimension dimension) {
    return gpu::BindGroupLayoutEntry{.binding = binding, .visibility = gpu::ShaderStage::Fragment, .type = gpu::BindingType::SampledTexture,
                                     .sample_type = type, .view_dimension = dimension};
  };
  using enum gpu::TextureViewDimension;
  const std::array entries{texture(0, gpu::SampleType::Uint, D2), texture(1, gpu::SampleType::UnfilterableFloat, D2),
                           texture(2, gpu::SampleType::UnfilterableFloat, D2), texture(3, gpu::SampleType::UnfilterableFloat, D2Array),
                           gpu::BindGroupLayoutEntry{.binding = 4, .visibility = gpu::ShaderStage::Fragment,
                                                     .type = gpu::BindingType::ReadOnlyStorageBuffer}};
  layout_ = device_.create_bind_group_layout({.label = "shade", .entries = entries});
  const std::array<const gpu::BindGroupLayout*, 2> layouts{&frame_layout, &layout_};
  pipeline_layout_ = device_.create_pipeline_layout({.label = "shade", .bind_group_layouts = layouts});
  make_scratch(device_, no_masks_, "shade.no_masks", {1, 1, 1}, TextureFormat::R8Unorm);
  no_masks_view_ = no_masks_.create_view({.dimension = D2Array});
  const std::array edge_entries{texture(0, gpu::SampleType::UnfilterableFloat, D2), texture(1, gpu::SampleType::UnfilterableFloat, D2)};
  edge_layout_ = device_.create_bind_group_layout({.label = "edges", .entries = edge_entries});
  const std::array<const gpu::BindGroupLayout*, 1> edge_layouts{&edge_layout_};
  edge_pipeline_layout_ = device_.create_pipeline_layout({.label = "edges", .bind_group_layouts = edge_layouts});
}

std::vector<TextureFormat> SurfaceShading::formats() const {
  std::vector<TextureFormat> all{TextureFormat::RGBA16Float, TextureFormat::R32Uint, TextureFormat::RGBA32Float};
  if (edges_) all.push_back(TextureFormat::RGBA16Float);
  return all;
}

std::vector<gpu::ColorAttachment> SurfaceShading::attachments() const {
  std::vector<gpu::ColorAttachment> all{{.view = &color_view_, .clear = {0, 0, 0, 0}},
                                        {.view = &id_view_, .clear = {4294967295.0, 0, 0, 0}},
                                        {.view = &normal_t_view_, .clear = {0, 0, 0, -1}}};
  if (edges_) all.push_back({.view = &edge_view_, .clear = {1, 0, 0, 0}});
  return all;
}

void SurfaceShading::update(const Scene& scene, const View& view, const std::vector<MappedLight>& lights) {
  const gpu::Extent3d size{view.size.width, view.size.height, 1};
  const std::vector<TextureFormat> wanted = formats();
  bool made = make_scratch(device_, color_, "surface.color", size, wanted[0]);
  made |= make_scratch(device_, id_, "surface.id", size, wanted[1]);
  made |= make_scratch(device_, normal_t_, "surface.normal_t", size, wanted[2]);
  if (made) {
    color_view_ = color_.create_view();
    id_view_ = id_.create_view();
    normal_t_view_ = normal_t_.create_view();
    group_ = {};
  }
  if (edges_ && (make_scratch(device_, edge_, "surface.edge", size, wanted[3]) | make_scratch(device_, picture_, "surface.picture", size, TextureFormat::RGBA16Float))) {
    edge_view_ = edge_.create_view();
    picture_view_ = picture_.create_view();
    const std::array entries{gpu::BindGroupEntry{.binding = 0, .texture = &picture_view_}, gpu::BindGroupEntry{.binding = 1, .texture = &edge_view_}};
    edge_group_ = device_.create_bind_group({.label = "edges", .layout = &edge_layout_, .entries = entries});
  }
  if (!lights.empty()) masks_.update(lights, view);
  make_tables(scene, lights);
  make_group();
  frame_key_ = {};
  frame_key_.light_count = static_cast<std::uint32_t>(std::min<std::size_t>(scene.lights.size(), max_lights));
  frame_key_.local_lights = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& l) {
    return l.kind == LightKind::Point || l.kind == LightKind::Spot;
  });
  frame_key_.orthographic = view.projection == Projection::Orthographic;
  frame_key_.masked = !lights.empty();
}

SurfaceShading::MaterialRow SurfaceShading::row_of(const Material& m) {
  return {glm::vec4(glm::dvec4(m.ambient, m.diffuse, m.specular, m.exponent)), glm::vec4(static_cast<float>(model_of(m)), 0, 0, 0)};
}

std::uint32_t SurfaceShading::material_of(const Batch& batch) const {
  return static_cast<std::uint32_t>(std::find(materials_.begin(), materials_.end(), row_of(batch.material)) - materials_.begin());
}

void SurfaceShading::make_tables(const Scene& scene, const std::vector<MappedLight>& lights) {
  std::vector<MaterialRow>& rows = materials_;
  rows.clear();
  models_.clear();
  for (const Batch& batch : scene.batches) {
    const Material& m = batch.material;
    if (material_of(batch) == rows.size()) rows.push_back(row_of(m));
    if (std::find(models_.begin(), models_.end(), model_of(m)) == models_.end()) models_.push_back(model_of(m));
  }
  if (rows.size() > most_materials)
    fail(Exit::Failed, "P016", {}, fmt::format("the scene has {} different materials; with shadow maps it can have {}", rows.size(), most_materials));
  if (rows.empty()) rows.emplace_back();
  std::array<std::int32_t, max_lights> mask_of_light;
  mask_of_light.fill(-1);
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].info.light < max_lights) mask_of_light[lights[i].info.light] = static_cast<std::int32_t>(i);
  const std::uint64_t bytes = sizeof mask_of_light + rows.size() * sizeof(MaterialRow);
  if (!tables_ || tables_.size() < bytes) {
    tables_ = device_.create_buffer({.label = "shade.tables", .size = bytes, .usage = gpu::BufferUsage::Storage | gpu::BufferUsage::CopyDst});
    group_ = {};
  }
  device_.queue().write_buffer(tables_, 0, std::as_bytes(std::span(mask_of_light)));
  device_.queue().write_buffer(tables_, sizeof mask_of_light, std::as_bytes(std::span(rows)));
}

void SurfaceShading::make_group() {
  const gpu::TextureView& masks = masks_.masks() ? masks_.masks() : no_masks_view_;
  if (group_ && bound_masks_ == masks) return;
  bound_masks_ = masks;
  const std::array<gpu::BindGroupEntry, 5> entries{{{.binding = 0, .texture = &id_view_},
                                                    {.binding = 1, .texture = &normal_t_view_},
                                                    {.binding = 2, .texture = &color_view_},
                                                    {.binding = 3, .texture = &bound_masks_},
                                                    {.binding = 4, .buffer = {&tables_}}}};
  group_ = device_.create_bind_group({.label = "shade", .layout = &layout_, .entries = entries});
}

const gpu::RenderPipeline& SurfaceShading::pipeline(const Key& key) {
  gpu::RenderPipeline& found = pipelines_[key];
  if (found) return found;
  const std::array constants{gpu::spec(0, key.orthographic), gpu::spec(1, key.light_count), gpu::spec(2, key.local_lights),
                             gpu::spec(3, key.specular_model), gpu::spec(16, key.masked)};
  std::vector<gpu::ColorTargetState> targets;
  for (const TextureFormat format : key.targets) targets.push_back({.format = format});
  found = full_screen_pipeline(device_, {.label = "shade", .layout = &pipeline_layout_, .fragment = fmt::format("shadow/shade.frag/aov{}", key.aovs),
                                         .constants = constants, .targets = targets});
  return found;
}

void SurfaceShading::make_edge_pipeline(TextureFormat target) {
  if (edge_pipeline_ && edge_target_ == target) return;
  edge_target_ = target;
  const std::array targets{gpu::ColorTargetState{.format = target}};
  edge_pipeline_ = full_screen_pipeline(device_, {.label = "edges", .layout = &edge_pipeline_layout_, .fragment = "post/edges.frag", .constants = {}, .targets = targets});
}

void SurfaceShading::shade(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame, std::span<const gpu::ColorAttachment> colors, std::uint32_t aovs) {
  Key key = frame_key_;
  key.aovs = aovs;
  for (const gpu::ColorAttachment& color : colors) key.targets.push_back(color.view->format());
  gpu::RenderPass pass = encoder.begin_render_pass({.label = "shade", .colors = colors});
  for (const std::uint32_t model : models_) {
    key.specular_model = model;
    pass.set_pipeline(pipeline(key));
    pass.set_bind_group(0, frame);
    pass.set_bind_group(1, group_);
    pass.draw(3);
  }
  pass.end();
}

void SurfaceShading::record(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame, std::vector<gpu::ColorAttachment> colors, std::uint32_t aovs) {
  if (frame_key_.masked) masks_.record(encoder, frame, id_view_, normal_t_view_, frame_key_.orthographic);
  if (!edges_) return shade(encoder, frame, colors, aovs);
  const std::array picture{gpu::ColorAttachment{.view = &picture_view_, .clear = colors.front().clear}};
  shade(encoder, frame, picture, 0);
  make_edge_pipeline(colors.front().view->format());
  const std::array blended{gpu::ColorAttachment{.view = colors.front().view, .load = gpu::LoadOp::DontCare}};
  gpu::RenderPass pass = encoder.begin_render_pass({.label = "edges", .colors = blended});
  pass.set_pipeline(edge_pipeline_);
  pass.set_bind_group(0, edge_group_);
  pass.draw(3);
  pass.end();
}

} // namespace mote::passes
