// SPDX-License-Identifier: MIT
#include "passes/full_screen.hpp"

#include "passes/particles/user_type.hpp"
#include "shaders/embedded.hpp"

#include <stdexcept>
#include <string>

namespace mote::passes {

gpu::RenderPipeline full_screen_pipeline(gpu::Device& device, const FullScreen& d) {
  const auto words = particle_spirv(std::string(d.fragment));
  if (words.empty()) throw std::logic_error("no shipped shader '" + std::string(d.fragment) + "'");
  const gpu::ShaderModule vertex = device.create_shader_module({.label = "post/fullscreen.vert", .spirv = shaders::spirv("post/fullscreen.vert")});
  const gpu::ShaderModule fragment = device.create_shader_module({.label = d.fragment, .spirv = words});
  gpu::RenderPipelineDescriptor descriptor{.label = d.label};
  descriptor.layout = d.layout;
  descriptor.vertex = {.module = &vertex};
  descriptor.fragment = gpu::ProgrammableStage{.module = &fragment, .constants = d.constants};
  descriptor.targets = d.targets;
  return device.create_render_pipeline(descriptor);
}

} // namespace mote::passes
