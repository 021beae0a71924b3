// SPDX-License-Identifier: MIT
#include "app/window/gui/gui_renderer.hpp"

#include "shaders/embedded.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace mote::window {

gpu::BindGroup GuiRenderer::group_of(const char* label, Size2d size, std::span<const std::uint8_t> rgba) {
  if (!layout_) {
    sampler_ = device_.create_sampler({.label = "panels", .mag_filter = gpu::FilterMode::Linear, .min_filter = gpu::FilterMode::Linear});
    const std::array entries{gpu::BindGroupLayoutEntry{.binding = 0, .visibility = gpu::ShaderStage::Fragment, .type = gpu::BindingType::SampledTexture},
                             gpu::BindGroupLayoutEntry{.binding = 1, .visibility = gpu::ShaderStage::Fragment, .type = gpu::BindingType::Sampler}};
    layout_ = device_.create_bind_group_layout({.label = "panels", .entries = entries});
    const std::array<const gpu::BindGroupLayout*, 1> layouts{&layout_};
    pipeline_layout_ = device_.create_pipeline_layout({.label = "panels", .bind_group_layouts = layouts, .push_constant_size = 8});
  }
  const gpu::Texture texture = device_.create_texture({.label = label, .size = {size.width, size.height, 1}, .format = gpu::TextureFormat::RGBA8Unorm,
                                                       .usage = gpu::TextureUsage::CopyDst | gpu::TextureUsage::Sampled});
  device_.queue().write_texture({.texture = &texture}, std::as_bytes(rgba), size.width * 4, size.height, {size.width, size.height, 1});
  const gpu::TextureView view = texture.create_view();
  const std::array entries{gpu::BindGroupEntry{.binding = 0, .texture = &view}, gpu::BindGroupEntry{.binding = 1, .sampler = &sampler_}};
  return device_.create_bind_group({.label = label, .layout = &layout_, .entries = entries});
}

void GuiRenderer::make_letters() {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  fonts.GetTexDataAsRGBA32(&pixels, &width, &height);
  letters_ = group_of("letters", {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)}, {pixels, static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4});
  fonts.SetTexID(reinterpret_cast<ImTextureID>(letters));
}

void GuiRenderer::set_picture(Size2d size, std::span<const std::uint8_t> rgba) { picture_ = group_of("slot", size, rgba); }

const gpu::RenderPipeline& GuiRenderer::pipeline(gpu::TextureFormat format) {
  gpu::RenderPipeline& made = pipelines_[format];
  if (made) return made;
  const gpu::ShaderModule vertex = device_.create_shader_module({.label = "window/gui.vert", .spirv = shaders::spirv("window/gui.vert")});
  const gpu::ShaderModule fragment = device_.create_shader_module({.label = "window/gui.frag", .spirv = shaders::spirv("window/gui.frag")});
  const std::array attributes{gpu::VertexAttribute{gpu::VertexFormat::Float32x2, offsetof(ImDrawVert, pos), 0}, gpu::VertexAttribute{gpu::VertexFormat::Float32x2, offsetof(ImDrawVert, uv), 1},
                              gpu::VertexAttribute{gpu::VertexFormat::Unorm8x4, offsetof(ImDrawVert, col), 2}};
  const std::array buffers{gpu::VertexBufferLayout{.stride = sizeof(ImDrawVert), .attributes = attributes}};
  const gpu::BlendComponent over{gpu::BlendFactor::SrcAlpha, gpu::BlendFactor::OneMinusSrcAlpha}, keep{gpu::BlendFactor::Zero, gpu::BlendFactor::One};
  const std::array targets{gpu::ColorTargetState{.format = format, .blend = gpu::BlendState{over, keep}}};
  gpu::RenderPipelineDescriptor d{.label = "panels", .layout = &pipeline_layout_};
  d.vertex = {.module = &vertex};
  d.fragment = gpu::ProgrammableStage{.module = &fragment};
  d.vertex_buffers = buffers;
  d.targets = targets;
  return made = device_.create_render_pipeline(d);
}

void GuiRenderer::reserve(gpu::Buffer& buffer, const char* label, std::uint64_t size, gpu::BufferUsage usage) {
  if (buffer && buffer.size() >= size) return;
  buffer = device_.create_buffer({.label = label, .size = std::max<std::uint64_t>(65536, size * 2), .usage = usage | gpu::BufferUsage::CopyDst});
}

void GuiRenderer::upload(const ImDrawData& data) {
  if (data.TotalVtxCount == 0) return;
  std::vector<std::byte> vertices(static_cast<std::size_t>(data.TotalVtxCount) * sizeof(ImDrawVert));
  std::vector<std::byte> indices((static_cast<std::size_t>(data.TotalIdxCount) * sizeof(ImDrawIdx) + 3) / 4 * 4);
  std::byte *vertex = vertices.data(), *index = indices.data();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    const std::size_t vertex_bytes = static_cast<std::size_t>(list.VtxBuffer.Size) * sizeof(ImDrawVert), index_bytes = static_cast<std::size_t>(list.IdxBuffer.Size) * sizeof(ImDrawIdx);
    std::memcpy(vertex, list.VtxBuffer.Data, vertex_bytes);
    std::memcpy(index, list.IdxBuffer.Data, index_bytes);
    vertex += vertex_bytes;
    index += index_bytes;
  }
  reserve(vertices_, "panels.vertices", vertices.size(), gpu::BufferUsage::Vertex);
  reserve(indices_, "panels.indices", indices.size(), gpu::BufferUsage::Index);
  device_.queue().write_buffer(vertices_, 0, vertices);
  device_.queue().write_buffer(indices_, 0, indices);
}

void GuiRenderer::draw(gpu::RenderPass& pass, gpu::TextureFormat format, const ImDrawData& data) {
  if (data.TotalVtxCount == 0 || data.DisplaySize.x < 1.0f || data.DisplaySize.y < 1.0f) return;
  pass.set_pipeline(pipeline(format));
  const std::array block{2.0f / data.DisplaySize.x, 2.0f / data.DisplaySize.y};
  pass.set_push_constants(0, std::as_bytes(std::span(block)));
  pass.set_vertex_buffer(0, vertices_);
  pass.set_index_buffer(indices_, sizeof(ImDrawIdx) == 2 ? gpu::IndexFormat::Uint16 : gpu::IndexFormat::Uint32);
  std::uint32_t first_index = 0;
  std::int32_t first_vertex = 0;
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const float left = std::max(command.ClipRect.x, 0.0f), top = std::max(command.ClipRect.y, 0.0f);
      const float right = std::min(command.ClipRect.z, data.DisplaySize.x), bottom = std::min(command.ClipRect.w, data.DisplaySize.y);
      if (command.UserCallback != nullptr || command.ElemCount == 0 || right - left < 1.0f || bottom - top < 1.0f) continue;
      const bool is_picture = reinterpret_cast<std::uintptr_t>(command.GetTexID()) == picture && picture_;
      pass.set_bind_group(0, is_picture ? picture_ : letters_);
      pass.set_scissor(static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(top), static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(bottom - top));
      pass.draw_indexed(command.ElemCount, 1, first_index + command.IdxOffset, first_vertex + static_cast<std::int32_t>(command.VtxOffset));
    }
    first_index += static_cast<std::uint32_t>(list.IdxBuffer.Size);
    first_vertex += list.VtxBuffer.Size;
  }
}

} // namespace mote::window
