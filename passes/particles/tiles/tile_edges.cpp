// SPDX-License-Identifier: MIT
#include "passes/particles/tiles/tile_edges.hpp"

#include "passes/particles/user_type.hpp"
#include "passes/runtime_shaders.hpp"
#include "shaders/embedded.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

namespace mote::passes {
namespace {

constexpr std::uint32_t no_winner = 0xFFFFFFFFu, edge_groups = 256, blocks = 8; // winners.glsl, outlines.comp

} // namespace

TileEdges::TileEdges(gpu::Device device, const gpu::BindGroupLayout& frame) : device_(std::move(device)), frame_(frame) {
  const auto buffer = [](std::uint32_t binding, gpu::BindingType type) {
    return gpu::BindGroupLayoutEntry{.binding = binding, .visibility = gpu::ShaderStage::Compute, .type = type};
  };
  constexpr gpu::BindingType in = gpu::BindingType::ReadOnlyStorageBuffer, io = gpu::BindingType::StorageBuffer;
  const std::array entries{buffer(0, in), buffer(1, io), buffer(2, io), buffer(3, in), buffer(4, in), buffer(5, io), buffer(6, io)};
  layout_ = device_.create_bind_group_layout({.label = "tiles.edges", .entries = entries});
  const std::array<const gpu::BindGroupLayout*, 2> sets{&frame_, &layout_};
  pipelines_layout_ = device_.create_pipeline_layout({.label = "tiles.edges", .bind_group_layouts = sets, .push_constant_size = sizeof(StepBlock)});
}

void TileEdges::reserve(std::uint64_t pixels) {
  if (colors_ && colors_.size() >= pixels * 8) return;
  using Usage = gpu::BufferUsage;
  colors_ = listed_ = {};
  colors_ = device_.create_buffer({.label = "tiles.winner_colors", .size = pixels * 8, .usage = Usage::Storage});
  listed_ = device_.create_buffer({.label = "tiles.listed", .size = pixels * 4, .usage = Usage::Storage});
  if (arguments_) return;
  arguments_ = device_.create_buffer({.label = "tiles.edge_arguments", .size = 16, .usage = Usage::Storage | Usage::CopyDst | Usage::CopySrc});
  indirect_ = device_.create_buffer({.label = "tiles.edge_indirect", .size = 16, .usage = Usage::Indirect | Usage::CopyDst});
}

void TileEdges::clear(gpu::CommandEncoder& encoder, const gpu::Buffer& names) {
  encoder.clear_buffer(names, 0, 0, no_winner);
  encoder.clear_buffer(arguments_);
  encoder.clear_buffer(arguments_, 0, 4, edge_groups);
  encoder.clear_buffer(arguments_, 8, 4, 1);
}

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

void TileEdges::record(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame_group, StepBlock block, gpu::Color background, const CastKey& key, const Buffers& buffers,
                       const rg::PixelMap* map, const std::string& cache_directory) {
  block.material = glm::vec4(glm::dvec4(background.r, background.g, background.b, background.a));
  std::vector<gpu::BindGroupEntry> entries;
  for (const gpu::Buffer* b : {&buffers.names, &buffers.narrow, &buffers.wide, &buffers.payloads, &std::as_const(colors_), &std::as_const(listed_), &std::as_const(arguments_)})
    entries.push_back({.binding = static_cast<std::uint32_t>(entries.size()), .buffer = {b}});
  const gpu::BindGroup group = device_.create_bind_group({.label = "tiles.edges", .layout = &layout_, .entries = entries});
  const std::uint32_t columns = TileKernels::lanes(device_), rows = blocks * 64 / columns;
  auto begin = [&](gpu::ComputePass& pass, const gpu::ComputePipeline& pipeline) {
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, frame_group);
    pass.set_bind_group(1, group);
    pass.set_push_constants(0, std::as_bytes(std::span(&block, 1)));
  };
  if (!outlines_) {
    const std::string shader = fmt::format("tiles/outlines/{}", columns);
    const gpu::ShaderModule module = device_.create_shader_module({.label = shader, .spirv = shaders::spirv(shader)});
    outlines_ = device_.create_compute_pipeline({.label = shader, .layout = &pipelines_layout_, .compute = {.module = &module}});
  }
  gpu::ComputePass look = encoder.begin_compute_pass({.label = "tiles.outlines"});
  begin(look, outlines_);
  look.dispatch((block.width + columns - 1) / columns, (block.height + rows - 1) / rows);
  look.end();
  encoder.copy_buffer_to_buffer(arguments_, 0, indirect_, 0, 16);
  gpu::ComputePass blend = encoder.begin_compute_pass({.label = "tiles.edges"});
  begin(blend, pipeline(key, map, cache_directory));
  if (map && map->group) blend.set_bind_group(rg::PixelMap::set, map->group);
  blend.dispatch_indirect(indirect_, 0);
  blend.end();
}

} // namespace mote::passes
