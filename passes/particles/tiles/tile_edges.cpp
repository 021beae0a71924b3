// SPDX-License-Identifier: MIT
#include "passes/particles/tiles/tile_edges.hpp"

#include "passes/particles/user_type.hpp"
#include "passes/runtime_shaders.hpp"

#include <fmt/format.h>

#include <array>

namespace mote::passes {
namespace {

constexpr std::uint64_t words_of_winner = 6; // winners.glsl
constexpr std::uint32_t no_winner = 0xFFFFFFFFu;

} // namespace

TileEdges::TileEdges(gpu::Device device, const gpu::BindGroupLayout& frame) : device_(std::move(device)), frame_(frame) {
  const auto buffer = [](std::uint32_t binding, gpu::BindingType type) {
    return gpu::BindGroupLayoutEntry{.binding = binding, .visibility = gpu::ShaderStage::Compute, .type = type};
  };
  const std::array entries{buffer(0, gpu::BindingType::ReadOnlyStorageBuffer), buffer(1, gpu::BindingType::StorageBuffer), buffer(2, gpu::BindingType::StorageBuffer)};
  layout_ = device_.create_bind_group_layout({.label = "tiles.edges", .entries = entries});
  const std::array<const gpu::BindGroupLayout*, 2> sets{&frame_, &layout_};
  pipelines_layout_ = device_.create_pipeline_layout({.label = "tiles.edges", .bind_group_layouts = sets, .push_constant_size = sizeof(StepBlock)});
}

void TileEdges::reserve(std::uint64_t pixels) {
  const std::uint64_t bytes = pixels * words_of_winner * 4;
  if (winners_ && winners_.size() >= bytes) return;
  winners_ = {};
  winners_ = device_.create_buffer({.label = "tiles.winners", .size = bytes, .usage = gpu::BufferUsage::Storage | gpu::BufferUsage::CopyDst});
}

void TileEdges::clear(gpu::CommandEncoder& encoder, std::uint64_t pixels) { encoder.clear_buffer(winners_, 0, pixels * 8, no_winner); }

const gpu::ComputePipeline& TileEdges::pipeline(const CastKey& key, const rg::PixelMap* map, const std::string& cache_directory) {
  gpu::ComputePipeline& found = pipelines_[key];
  if (found) return found;
  const std::uint32_t lanes = TileKernels::lanes(device_);
  const bool pairs = gpu::has(device_.features(), gpu::Feature::ShaderInt64);
  const std::array constants{gpu::spec(0, key.drawing.orthographic), gpu::spec(14, key.color_words)};
  const std::string shader = fmt::format("{}/tiles/edges/{}/{}", key.drawing.type, lanes, pairs ? "int64" : "int32");
  std::vector<std::uint32_t> words;
  gpu::PipelineLayout with_map;
  if (map) {
    const std::array<gpu::ShaderDefine, 4> defines{{{"TILES", "1"}, {"LANES", std::to_string(lanes)}, {pairs ? "INT64" : "INT32", "1"}, {"PIXEL_MAP", "1"}}};
    std::vector<MadeText> made = type_texts(key.drawing.type);
    made.push_back({"pixel_map.glsl", map->glsl});
    words = compile_shader("particles/tiles/edges.comp", made, cache_directory, defines);
    std::vector<const gpu::BindGroupLayout*> sets{&frame_, &layout_};
    if (map->layout) sets.push_back(&map->layout);
    with_map = device_.create_pipeline_layout({.label = "tiles.edges", .bind_group_layouts = sets, .push_constant_size = sizeof(StepBlock)});
  } else {
    const std::span<const std::uint32_t> shipped = particle_spirv(shader);
    words.assign(shipped.begin(), shipped.end());
  }
  const gpu::ShaderModule module = device_.create_shader_module({.label = shader, .spirv = words});
  found = device_.create_compute_pipeline({.label = shader, .layout = map ? &with_map : &pipelines_layout_, .compute = {.module = &module, .constants = constants}});
  return found;
}

void TileEdges::record(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame_group, StepBlock block, gpu::Color background, const CastKey& key, const Into& into,
                       const rg::PixelMap* map, const std::string& cache_directory) {
  block.material = glm::vec4(glm::dvec4(background.r, background.g, background.b, background.a));
  const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {&winners_}}, gpu::BindGroupEntry{.binding = 1, .buffer = {&into.narrow}},
                           gpu::BindGroupEntry{.binding = 2, .buffer = {&into.wide}}};
  const std::uint32_t columns = TileKernels::lanes(device_), rows = 64 / columns;
  gpu::ComputePass pass = encoder.begin_compute_pass({.label = "tiles.edges"});
  pass.set_pipeline(pipeline(key, map, cache_directory));
  pass.set_bind_group(0, frame_group);
  pass.set_bind_group(1, device_.create_bind_group({.label = "tiles.edges", .layout = &layout_, .entries = entries}));
  if (map && map->group) pass.set_bind_group(rg::PixelMap::set, map->group);
  pass.set_push_constants(0, std::as_bytes(std::span(&block, 1)));
  pass.dispatch((block.width + columns - 1) / columns, (block.height + rows - 1) / rows);
  pass.end();
}

} // namespace mote::passes
