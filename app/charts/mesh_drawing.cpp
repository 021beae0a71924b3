// SPDX-License-Identifier: MIT
#include "app/charts/mesh_drawing.hpp"

#include "passes/runtime_shaders.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>

namespace mote::app {
namespace {

using gpu::BufferUsage, gpu::TextureFormat, gpu::TextureUsage;

gpu::ShaderModule shader(gpu::Device& device, const char* path) {
  const std::vector<std::uint32_t> spirv = passes::compile_shader(path, {}, cache_directory());
  return device.create_shader_module({.label = path, .spirv = spirv});
}

struct Pipeline {
  gpu::BindGroupLayout group_layout{};
  gpu::RenderPipeline pipeline{};
};
Pipeline make_pipeline(gpu::Device& device) {
  Pipeline out;
  constexpr auto visible = gpu::ShaderStage::Vertex;
  const std::array places{gpu::BindGroupLayoutEntry{.binding = 0, .visibility = visible, .type = gpu::BindingType::ReadOnlyStorageBuffer},
                          gpu::BindGroupLayoutEntry{.binding = 1, .visibility = visible, .type = gpu::BindingType::ReadOnlyStorageBuffer}};
  out.group_layout = device.create_bind_group_layout({.label = "mesh", .entries = places});
  const std::array layouts{static_cast<const gpu::BindGroupLayout*>(&out.group_layout)};
  const gpu::PipelineLayout layout = device.create_pipeline_layout({.label = "mesh", .bind_group_layouts = layouts, .push_constant_size = 16});
  const gpu::ShaderModule vertex = shader(device, "charts/mesh.vert"), fragment = shader(device, "charts/mesh.frag");
  const std::array targets{gpu::ColorTargetState{.format = TextureFormat::RGBA16Float}, gpu::ColorTargetState{.format = TextureFormat::R32Uint}};
  out.pipeline = device.create_render_pipeline({.label = "mesh",
                                                .layout = &layout,
                                                .vertex = {.module = &vertex},
                                                .fragment = gpu::ProgrammableStage{.module = &fragment},
                                                .depth = gpu::DepthState{},
                                                .targets = targets});
  return out;
}

} // namespace

DrawnMesh draw_meshes(DrawingDevice& drawing, std::span<const glm::vec4> spheres, const Icosphere& mesh, const View& view) {
  gpu::Device& device = drawing.device();
  std::vector<glm::vec4> corners;
  for (const glm::dvec3& p : mesh.corners) corners.emplace_back(glm::vec3(p), 0.0f);
  auto buffer = [&](const char* label, std::span<const std::byte> bytes, BufferUsage usage) {
    return device.create_buffer({.label = label, .size = bytes.size(), .usage = usage, .contents = bytes});
  };
  const gpu::Buffer placed = buffer("spheres", std::as_bytes(spheres), BufferUsage::Storage);
  const gpu::Buffer unit = buffer("corners", std::as_bytes(std::span(corners)), BufferUsage::Storage);
  const gpu::Buffer indices = buffer("triangles", std::as_bytes(std::span(mesh.triangles)), BufferUsage::Index);
  const Pipeline made = make_pipeline(device);
  const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {.buffer = &placed}}, gpu::BindGroupEntry{.binding = 1, .buffer = {.buffer = &unit}}};
  const gpu::BindGroup group = device.create_bind_group({.label = "mesh", .layout = &made.group_layout, .entries = entries});
  const gpu::Extent3d size{view.size.width, view.size.height, 1};
  auto texture = [&](const char* label, TextureFormat format) {
    return device.create_texture({.label = label, .size = size, .format = format, .usage = TextureUsage::RenderAttachment | TextureUsage::CopySrc});
  };
  const gpu::Texture color = texture("color", TextureFormat::RGBA16Float), id = texture("id", TextureFormat::R32Uint), depth = texture("depth", TextureFormat::Depth32Float);
  const gpu::TextureView color_view = color.create_view(), id_view = id.create_view(), depth_view = depth.create_view();
  const std::array colors{gpu::ColorAttachment{.view = &color_view}, gpu::ColorAttachment{.view = &id_view, .clear = {4294967295.0, 0, 0, 0}}};
  const std::array<float, 4> push{static_cast<float>(2.0 * view.focal / view.size.width), static_cast<float>(2.0 * view.focal / view.size.height), static_cast<float>(view.depth_near), 0.0f};
  DrawnMesh out{.size = view.size, .index = {}, .milliseconds = INFINITY};
  for (int k = 0; k < 4; ++k) {
    gpu::CommandEncoder encoder = device.create_command_encoder("mesh");
    gpu::RenderPass pass = encoder.begin_render_pass({.label = "mesh", .colors = colors, .depth = gpu::DepthAttachment{.view = &depth_view}});
    pass.set_pipeline(made.pipeline);
    pass.set_bind_group(0, group);
    pass.set_push_constants(0, std::as_bytes(std::span(push)));
    pass.set_index_buffer(indices, gpu::IndexFormat::Uint32);
    pass.draw_indexed(static_cast<std::uint32_t>(mesh.triangles.size()), static_cast<std::uint32_t>(spheres.size()));
    pass.end();
    const gpu::CommandBuffer commands = encoder.finish();
    gpu::Queue queue = device.queue();
    const auto start = std::chrono::steady_clock::now();
    queue.wait(queue.submit(commands));
    if (k > 0) out.milliseconds = std::min(out.milliseconds, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  const std::vector<std::byte> bytes = device.read_texture(id);
  drawing.check();
  out.index.resize(bytes.size() / 4);
  std::memcpy(out.index.data(), bytes.data(), bytes.size());
  return out;
}

} // namespace mote::app
