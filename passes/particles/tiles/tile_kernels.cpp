// SPDX-License-Identifier: MIT
#include "passes/particles/tiles/tile_kernels.hpp"

#include "passes/particles/tiles/tile_blocks.hpp"
#include "passes/particles/user_type.hpp"
#include "passes/runtime_shaders.hpp"
#include "shaders/embedded.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace mote::passes {
namespace {

using Type = gpu::BindingType;

gpu::BindGroupLayout layout_of(gpu::Device& device, std::string_view label, std::span<const Type> types) {
  std::vector<gpu::BindGroupLayoutEntry> entries;
  for (const Type type : types)
    entries.push_back({.binding = static_cast<std::uint32_t>(entries.size()), .visibility = gpu::ShaderStage::Compute, .type = type});
  return device.create_bind_group_layout({.label = label, .entries = entries});
}

// With analytic edges pixels are met beyond their centers; a fiftieth is for rounding.
float reach_of(const ParticlePipelineKey& key) { return key.edges ? pixel_reach : 0.02f; }

constexpr Type in = Type::ReadOnlyStorageBuffer, io = Type::StorageBuffer;
constexpr std::array slice_types{in, in, in, in}; // chunk.glsl
constexpr std::array binning_types{in, in, io, io, io, io, io, io, io, io, io, io, io, io, io}; // binning.glsl, splat.comp
constexpr std::array cast_types{in, in, in, in, in, io, in, in, io, io, io, io, io, io, io, io}; // cast.comp
constexpr std::array splat_far_types{in, in, io};
constexpr std::array resolve_types{in, in, in, in, in, in, in, in, io, io, io, io, io, io, io, io}; // resolve_splats.comp

} // namespace

TileKernels::TileKernels(gpu::Device device, const gpu::BindGroupLayout& frame) : device_(std::move(device)), words_(gpu::has(device_.features(), gpu::Feature::ShaderInt64) ? "int64" : "int32"), frame_(frame) {
  slice_ = layout_of(device_, "tiles.slice", slice_types);
  binning_ = layout_of(device_, "tiles.binning", binning_types);
  cast_ = layout_of(device_, "tiles.cast", cast_types);
  resolve_ = layout_of(device_, "tiles.resolve", resolve_types);
  const std::array<const gpu::BindGroupLayout*, 3> binning{&frame, &slice_, &binning_};
  const std::array<const gpu::BindGroupLayout*, 2> casting{&frame, &cast_};
  splat_far_ = layout_of(device_, "tiles.splat_far", splat_far_types);
  const std::array<const gpu::BindGroupLayout*, 2> resolving{&frame, &resolve_};
  const std::array<const gpu::BindGroupLayout*, 2> reaching{&frame, &splat_far_};
  binning_pipelines_ = device_.create_pipeline_layout({.label = "tiles.binning", .bind_group_layouts = binning, .push_constant_size = sizeof(StepBlock)});
  cast_pipelines_ = device_.create_pipeline_layout({.label = "tiles.cast", .bind_group_layouts = casting, .push_constant_size = sizeof(StepBlock)});
  resolve_pipelines_ = device_.create_pipeline_layout({.label = "tiles.resolve", .bind_group_layouts = resolving, .push_constant_size = sizeof(StepBlock)});
  far_pipelines_ = device_.create_pipeline_layout({.label = "tiles.splat_far", .bind_group_layouts = reaching, .push_constant_size = sizeof(StepBlock)});
}

std::uint32_t TileKernels::lanes(const gpu::Device& device) {
  if (!gpu::has(device.features(), gpu::Feature::Subgroups)) return 0;
  for (const std::uint32_t lanes : {32u, 16u, 8u, 4u})
    if (lanes <= device.limits().min_subgroup_size) return lanes;
  return 0;
}

bool TileKernels::splats(const gpu::Device& device, const std::string& type) {
  const gpu::Feature needed = gpu::Feature::ShaderInt64 | gpu::Feature::Int64Atomics;
  return (device.features() & needed) == needed && !shaders::spirv(fmt::format("{}/tiles/splat/{}", type, lanes(device))).empty();
}

gpu::ComputePipeline TileKernels::make(const std::string& shader, const gpu::PipelineLayout& layout, std::span<const gpu::SpecializationConstant> constants,
                                       std::span<const std::uint32_t> words) {
  if (words.empty()) words = particle_spirv(shader);
  if (words.empty()) throw std::logic_error("no shipped shader '" + shader + "'");
  const gpu::ShaderModule module = device_.create_shader_module({.label = shader, .spirv = words});
  return device_.create_compute_pipeline({.label = shader, .layout = &layout, .compute = {.module = &module, .constants = constants}});
}

const gpu::ComputePipeline& TileKernels::kernel(const std::string& name) {
  gpu::ComputePipeline& pipeline = kernels_[name];
  if (!pipeline) pipeline = make(fmt::format("tiles/{}/{}", name, words_), binning_pipelines_, {});
  return pipeline;
}

const gpu::ComputePipeline& TileKernels::place(const PlaceKey& how) {
  if (auto it = places_.find(how); it != places_.end()) return it->second;
  const ParticlePipelineKey& key = how.drawing;
  const std::array constants{gpu::spec(0, key.orthographic), gpu::spec(4, key.per_particle_color), gpu::spec(7, key.proxy_slack), gpu::spec(9, key.paletted), gpu::spec(11, (key.aovs & aov_id_bit) != 0),
                             gpu::spec(12, how.untested), gpu::spec(17, how.first_slice), gpu::spec(21, reach_of(key)), gpu::spec(22, how.by_id)};
  const std::string shader = fmt::format("{}/tiles/place/{}/{}", key.type, lanes(device_), words_);
  return places_.emplace(how, make(shader, binning_pipelines_, constants)).first->second;
}

const gpu::ComputePipeline& TileKernels::sift(const ParticlePipelineKey& key) {
  if (auto it = sifts_.find(key); it != sifts_.end()) return it->second;
  const std::array constants{gpu::spec(0, key.orthographic), gpu::spec(7, key.proxy_slack), gpu::spec(21, reach_of(key))};
  return sifts_.emplace(key, make(fmt::format("{}/tiles/sift/{}/{}", key.type, lanes(device_), words_), binning_pipelines_, constants)).first->second;
}

const gpu::ComputePipeline& TileKernels::splat(const ParticlePipelineKey& key, std::uint32_t side) {
  if (auto it = splats_.find({key, side}); it != splats_.end()) return it->second;
  const std::array constants{gpu::spec(0, key.orthographic), gpu::spec(7, key.proxy_slack), gpu::spec(19, side)};
  return splats_.emplace(std::pair(key, side), make(fmt::format("{}/tiles/splat/{}", key.type, lanes(device_)), binning_pipelines_, constants)).first->second;
}

const gpu::ComputePipeline& TileKernels::splat_far(bool orthographic, bool alone) {
  gpu::ComputePipeline& pipeline = splat_fars_[{orthographic, alone}];
  const std::array constants{gpu::spec(0, orthographic), gpu::spec(20, alone)};
  if (!pipeline) pipeline = make(fmt::format("tiles/splat_far/{}", lanes(device_)), far_pipelines_, constants);
  return pipeline;
}

const gpu::ComputePipeline& TileKernels::shading(const CastKey& key, const Besides& besides, Shading what) {
  if (auto it = shadings_.find({key, what}); it != shadings_.end()) return it->second;
  const ParticlePipelineKey& d = key.drawing;
  const TileShadows::Key& s = key.shadows;
  const bool cast = what == Shading::Cast;
  std::vector<gpu::SpecializationConstant> constants{
      gpu::spec(0, d.orthographic), gpu::spec(1, d.light_count), gpu::spec(2, d.local_lights), gpu::spec(3, d.specular_model),
      gpu::spec(5, d.show_depth_violation), gpu::spec(6, d.head_light_only), gpu::spec(10, d.aovs),
      gpu::spec(13, key.one_material), gpu::spec(14, key.color_words), gpu::spec(15, key.want_depth), gpu::spec(16, key.display_only),
      gpu::spec(7, d.proxy_slack), gpu::spec(8, d.type_number), gpu::spec(18, static_cast<std::uint32_t>(d.phase))};
  if (key.keep_layers) constants.push_back(gpu::spec(21, true));
  if (key.by_id) constants.push_back(gpu::spec(22, true));
  if (!cast) constants.insert(constants.end(), {gpu::spec(4, d.per_particle_color), gpu::spec(9, d.paletted), gpu::spec(20, what == Shading::SplatsAlone)});
  if (besides.shadows) {
    for (std::uint32_t k = 0; k < s.lights.size(); ++k) constants.push_back(gpu::spec(31 + k, s.lights[k]));
    constants.insert(constants.end(), {gpu::spec(30, s.maps), gpu::spec(35, s.orthographic), gpu::spec(36, s.by_id)});
  }
  const std::string shader = cast ? fmt::format("{}/tiles/{}/{}/{}", d.type, d.edges ? "edges" : "cast", lanes(device_), words_) : fmt::format("{}/tiles/resolve_splats/{}", d.type, lanes(device_));
  const auto keep = [&](gpu::ComputePipeline pipeline) -> const gpu::ComputePipeline& { return shadings_.emplace(std::pair(key, what), std::move(pipeline)).first->second; };
  if (!besides.map && !besides.shadows) return keep(make(shader, cast ? cast_pipelines_ : resolve_pipelines_, constants));

  std::vector<gpu::ShaderDefine> defines{{"TILES", "1"}, {"LANES", std::to_string(lanes(device_))}, {words_ == "int64" ? "INT64" : "INT32", "1"}};
  if (d.edges) defines.push_back({"ANALYTIC_EDGES", "1"});
  std::vector<MadeText> made = type_texts(d.type);
  std::vector<const gpu::BindGroupLayout*> sets{&frame_, cast ? &cast_ : &resolve_};
  if (besides.map) {
    defines.push_back({"PIXEL_MAP", "1"});
    made.push_back({"pixel_map.glsl", besides.map->glsl});
    if (besides.map->layout) sets.push_back(&besides.map->layout);
  }
  if (besides.shadows) {
    defines.push_back({"SHADOW_SET", std::to_string(besides.shadow_set())});
    sets.push_back(&besides.shadows->layout());
  }
  const auto words = compile_shader(cast ? "particles/tiles/cast.comp" : "particles/tiles/resolve_splats.comp", made, besides.cache_directory, defines);
  const gpu::PipelineLayout layout = device_.create_pipeline_layout({.label = "tiles.besides", .bind_group_layouts = sets, .push_constant_size = sizeof(StepBlock)});
  return keep(make(shader, layout, constants, words));
}

} // namespace mote::passes
