// SPDX-License-Identifier: MIT
// The smallest drawing: one triangle into a texture, read back, checked and written as a PPM.
//   gpu_example_triangle [out.ppm]
// Exit status 0 if the middle pixel has the color of the triangle and a corner that of the clear.
#include "core/gpu/gpu.hpp"
#include "core/gpu/shader_compiler.hpp"

#include <cstdio>
#include <cstring>

namespace gpu = mote::gpu;

const char* const vertex_text = R"(#version 450
layout(location = 0) out vec3 tint;
void main() {
  vec2 corners[3] = vec2[](vec2(0.0, -0.8), vec2(0.8, 0.8), vec2(-0.8, 0.8)); // y points down
  tint = vec3(gl_VertexIndex == 0, gl_VertexIndex == 1, gl_VertexIndex == 2);
  gl_Position = vec4(corners[gl_VertexIndex], 0.0, 1.0);
}
)";
const char* const fragment_text = R"(#version 450
layout(location = 0) in vec3 tint;
layout(location = 0) out vec4 color;
void main() { color = vec4(tint, 1.0); }
)";

constexpr std::uint32_t side = 128;

bool write_ppm(const char* path, const std::vector<std::byte>& rgba) {
  std::FILE* file = std::fopen(path, "wb");
  if (file == nullptr) return false;
  std::fprintf(file, "P6\n%u %u\n255\n", side, side);
  for (std::size_t i = 0; i < rgba.size(); i += 4) std::fwrite(&rgba[i], 1, 3, file);
  return std::fclose(file) == 0;
}

int main(int argc, char** argv) {
  gpu::Error error;
  const gpu::Instance instance = gpu::Instance::create({.application = "triangle"}, error);
  const gpu::Adapter adapter = instance.request_adapter({}, error);
  gpu::Device device = adapter.request_device({}, error);
  if (!device) {
    std::fprintf(stderr, "%s\n", gpu::to_string(error).c_str());
    return 1;
  }
  const auto compile = [&](gpu::ShaderStage stage, const char* name, const char* text) {
    const gpu::CompiledShader compiled = gpu::compile_glsl(stage, {name, text});
    return device.create_shader_module({.label = name, .spirv = compiled.spirv});
  };
  const gpu::ShaderModule vertex = compile(gpu::ShaderStage::Vertex, "triangle.vert", vertex_text);
  const gpu::ShaderModule fragment = compile(gpu::ShaderStage::Fragment, "triangle.frag", fragment_text);
  const gpu::PipelineLayout layout = device.create_pipeline_layout({});
  const gpu::ColorTargetState targets[] = {{.format = gpu::TextureFormat::RGBA8Unorm}};
  const gpu::RenderPipeline pipeline = device.create_render_pipeline({.label = "triangle",
                                                                      .layout = &layout,
                                                                      .vertex = {.module = &vertex},
                                                                      .fragment = gpu::ProgrammableStage{.module = &fragment},
                                                                      .targets = targets});

  const gpu::Texture picture = device.create_texture({.label = "picture",
                                                      .size = {side, side, 1},
                                                      .format = gpu::TextureFormat::RGBA8Unorm,
                                                      .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc});
  const gpu::TextureView view = picture.create_view();
  const gpu::ColorAttachment colors[] = {{.view = &view, .clear = {0, 0, 0, 1}}};
  gpu::CommandEncoder encoder = device.create_command_encoder("triangle");
  gpu::RenderPass pass = encoder.begin_render_pass({.label = "triangle", .colors = colors});
  pass.set_pipeline(pipeline);
  pass.draw(3);
  pass.end();
  device.queue().submit(encoder.finish());

  const auto rgba = device.read_texture(picture);
  const auto channel = [&](std::uint32_t x, std::uint32_t y, std::uint32_t c) { return static_cast<int>(rgba[(y * side + x) * 4 + c]); };
  const int sum = channel(64, 64, 0) + channel(64, 64, 1) + channel(64, 64, 2);
  std::printf("middle: %d %d %d, corner: %d\n", channel(64, 64, 0), channel(64, 64, 1), channel(64, 64, 2), channel(0, 0, 0));
  if (argc > 1 && !write_ppm(argv[1], rgba)) return 1;
  return sum >= 253 && sum <= 257 && channel(0, 0, 0) == 0 ? 0 : 1; // the three tints add up to white
}
