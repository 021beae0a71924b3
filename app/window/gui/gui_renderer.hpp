// SPDX-License-Identifier: MIT
// Draws what Dear ImGui laid out, with core/gpu: the letters and one further picture (a slot of the graph). Only gui_panels.cpp uses it.
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/math/camera.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

struct ImDrawData;

namespace mote::window {

class GuiRenderer {
public:
  static constexpr std::uintptr_t letters = 1, picture = 2; // ImTextureID

  explicit GuiRenderer(gpu::Device device) : device_(std::move(device)) {}
  void make_letters(); // from the present ImGui context; again after its fonts changed
  void set_picture(Size2d size, std::span<const std::uint8_t> rgba);
  void upload(const ImDrawData& data);                                            // outside a render pass
  void draw(gpu::RenderPass& pass, gpu::TextureFormat format, const ImDrawData& data);

private:
  gpu::BindGroup group_of(const char* label, Size2d size, std::span<const std::uint8_t> rgba);
  const gpu::RenderPipeline& pipeline(gpu::TextureFormat format);
  void reserve(gpu::Buffer& buffer, const char* label, std::uint64_t size, gpu::BufferUsage usage);

  gpu::Device device_;
  gpu::Sampler sampler_{};
  gpu::BindGroupLayout layout_{};
  gpu::PipelineLayout pipeline_layout_{};
  std::map<gpu::TextureFormat, gpu::RenderPipeline> pipelines_{};
  gpu::BindGroup letters_{}, picture_{};
  gpu::Buffer vertices_{}, indices_{};
};

} // namespace mote::window
