// SPDX-License-Identifier: MIT
#include "passes/ocio_tonemap.hpp"

#include "core/color/display_transform.hpp"
#include "passes/frame.hpp"
#include "passes/runtime_shaders.hpp"
#include "shaders/embedded.hpp"

#include <array>
#include <cmath>
#include <optional>

namespace mote::passes {
namespace {

gpu::Texture upload_lut(gpu::Device& device, const DisplayLut& lut) {
  const bool rg = lut.format == DisplayLut::Format::RG32Float;
  gpu::Texture texture = device.create_texture(
      {.label = lut.name,
       .size = {lut.width, lut.height, lut.depth},
       .format = rg ? gpu::TextureFormat::RG32Float : gpu::TextureFormat::RGBA32Float,
       .usage = gpu::TextureUsage::Sampled | gpu::TextureUsage::CopyDst,
       .dimension = lut.volume ? gpu::TextureDimension::D3 : gpu::TextureDimension::D2});
  device.queue().write_texture({.texture = &texture}, std::as_bytes(std::span(lut.data)), lut.width * (rg ? 8 : 16), lut.height,
                               {lut.width, lut.height, lut.depth});
  return texture;
}

class OcioTonemap final : public rg::Pass {
public:
  void declare(std::vector<rg::Slot>& slots, rg::Params& params) override {
    slots.push_back({.name = "color", .access = rg::Access::Sampled, .summary = "scene-linear color in the working space"});
    slots.push_back({.name = "color", .access = rg::Access::ColorWrite, .summary = "display color",
                     .makes = rg::TextureSpec{.format = gpu::TextureFormat::RGBA8Unorm}, .covers = true, .copied_into = true});
    request_.display = params.string("display", "", "display of the color config; empty: its default");
    request_.view = params.string("view", "", "view transform of the display; empty: its default");
    request_.exposure = params.number("exposure", 0.0, {.min = -30, .max = 30}, "stops");
    request_.exact = params.boolean("exact", false, "OpenColorIO's arithmetic instead of baked curves");
    request_.loc = params.loc(params.has("view") ? "view" : "display");
  }

  void prepare(rg::PassContext& context) override {
    target_ = context.format("color");
    pipeline_ = {};
  }

  void update(rg::PassContext& context) override {
    if (!pipeline_) make_pipeline(context);
    if (group_ && generation_ == context.generation()) return;
    generation_ = context.generation();
    const gpu::TextureView scene = context.texture("color"); // the input: an input goes before an output of its name
    gpu::Device device = context.device();
    const std::array entries{gpu::BindGroupEntry{.binding = 0, .texture = &scene}};
    group_ = device.create_bind_group({.label = "display.scene", .layout = &scene_layout_, .entries = entries});
  }

  void record(rg::PassContext& context) override {
    gpu::RenderPass& pass = context.render_pass();
    pass.set_pipeline(pipeline_);
    pass.set_bind_group(0, group_);
    if (tables_.group) pass.set_bind_group(1, tables_.group);
    pass.draw(3);
  }

  const rg::PixelMap* pixel_map(rg::PassContext& context) override {
    if (!map_.glsl.empty()) return &map_;
    make_transform(context);
    gpu::Device device = context.device();
    const DisplayGlsl glsl = transform_->glsl({.function = "map_pixel", .set = rg::PixelMap::set, .first_binding = 0});
    tables_for_map_ = upload_tables(device, glsl, gpu::ShaderStage::Compute);
    map_.layout = tables_for_map_.layout;
    map_.group = tables_for_map_.group;
    map_.id = glsl.cache_id;
    map_.glsl = glsl.text;
    map_.apply = [transform = *transform_](gpu::Color c) {
      std::array<float, 4> v{static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), static_cast<float>(c.a)};
      transform.apply_baked(v);
      return gpu::Color{v[0], v[1], v[2], v[3]};
    };
    return &map_;
  }

private:
  // The tables of a transform on the device; empty for a transform that has none.
  struct Tables {
    gpu::BindGroupLayout layout{};
    gpu::BindGroup group{};
    std::vector<gpu::Texture> textures{};
    std::vector<gpu::Sampler> samplers{};
  };

  void make_transform(rg::PassContext& context) {
    if (transform_) return;
    const DisplaySettings& settings = context.frame().get<DisplaySettings>();
    DisplayRequest request = request_;
    if (request.display.empty()) request.display = settings.display;
    if (request.view.empty()) request.view = settings.view;
    request.exposure += settings.exposure;
    request.exact = request.exact || settings.exact;
    transform_ = make_display_transform(*settings.config, request);
    if (settings.describe) settings.describe(transform_->describe());
  }

  void make_pipeline(rg::PassContext& context) {
    make_transform(context);
    gpu::Device device = context.device();
    const DisplayGlsl glsl = transform_->glsl({.set = 1, .first_binding = 0});
    const std::array scene_entries{gpu::BindGroupLayoutEntry{.binding = 0,
                                                             .visibility = gpu::ShaderStage::Fragment,
                                                             .type = gpu::BindingType::SampledTexture,
                                                             .sample_type = gpu::SampleType::UnfilterableFloat}};
    scene_layout_ = device.create_bind_group_layout({.label = "display.scene", .entries = scene_entries});
    tables_ = upload_tables(device, glsl, gpu::ShaderStage::Fragment);
    std::vector<const gpu::BindGroupLayout*> layouts{&scene_layout_};
    if (tables_.layout) layouts.push_back(&tables_.layout);
    const gpu::PipelineLayout layout = device.create_pipeline_layout({.label = "display", .bind_group_layouts = layouts});

    const gpu::ShaderModule vertex = device.create_shader_module({.label = "post/fullscreen.vert", .spirv = shaders::spirv("post/fullscreen.vert")});
    const auto words = compile_shader("post/display.frag", {{"display_transform.glsl", glsl.text}}, context.frame().get<DisplaySettings>().cache_directory);
    const gpu::ShaderModule fragment = device.create_shader_module({.label = "post/display.frag", .spirv = words});
    const std::array targets{gpu::ColorTargetState{.format = target_}};
    gpu::RenderPipelineDescriptor descriptor{.label = "display"};
    descriptor.layout = &layout;
    descriptor.vertex = {.module = &vertex};
    descriptor.fragment = gpu::ProgrammableStage{.module = &fragment};
    descriptor.targets = targets;
    pipeline_ = device.create_render_pipeline(descriptor);
    group_ = {};
  }

  static Tables upload_tables(gpu::Device& device, const DisplayGlsl& glsl, gpu::ShaderStage stage) {
    Tables tables;
    std::vector<gpu::TextureView> views;
    std::vector<gpu::BindGroupLayoutEntry> layout_entries;
    for (const DisplayLut& lut : glsl.luts) {
      tables.textures.push_back(upload_lut(device, lut));
      views.push_back(tables.textures.back().create_view());
      const gpu::FilterMode filter = lut.linear ? gpu::FilterMode::Linear : gpu::FilterMode::Nearest;
      tables.samplers.push_back(device.create_sampler({.label = lut.name, .mag_filter = filter, .min_filter = filter}));
      layout_entries.push_back({.binding = lut.texture_binding,
                                .visibility = stage,
                                .type = gpu::BindingType::SampledTexture,
                                .sample_type = lut.linear ? gpu::SampleType::Float : gpu::SampleType::UnfilterableFloat,
                                .view_dimension = lut.volume ? gpu::TextureViewDimension::D3 : gpu::TextureViewDimension::D2});
      layout_entries.push_back({.binding = lut.sampler_binding, .visibility = stage, .type = gpu::BindingType::Sampler});
    }
    if (layout_entries.empty()) return tables;
    tables.layout = device.create_bind_group_layout({.label = "display.luts", .entries = layout_entries});
    std::vector<gpu::BindGroupEntry> entries;
    for (std::size_t i = 0; i < views.size(); ++i) {
      entries.push_back({.binding = glsl.luts[i].texture_binding, .texture = &views[i]});
      entries.push_back({.binding = glsl.luts[i].sampler_binding, .sampler = &tables.samplers[i]});
    }
    tables.group = device.create_bind_group({.label = "display.luts", .layout = &tables.layout, .entries = entries});
    return tables;
  }

  DisplayRequest request_;
  gpu::TextureFormat target_{};
  std::optional<DisplayTransform> transform_;
  gpu::BindGroupLayout scene_layout_;
  gpu::RenderPipeline pipeline_;
  gpu::BindGroup group_;
  std::uint64_t generation_{};
  Tables tables_, tables_for_map_;
  rg::PixelMap map_;
};

} // namespace

std::unique_ptr<rg::Pass> make_ocio_tonemap() { return std::make_unique<OcioTonemap>(); }

} // namespace mote::passes
