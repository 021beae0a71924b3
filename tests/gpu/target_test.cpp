// SPDX-License-Identifier: MIT
// Render targets: clears of every kind of format, several targets, blending, multisampling,
// read-only depth that is sampled in the same pass.
#include "tests/gpu/fixture.hpp"

#include <cmath>
#include <limits>

namespace mote::gpu {
namespace {

using testing::Each;

class TargetTest : public DeviceTest {
protected:
  std::vector<std::byte> cleared(TextureFormat format, Color color) {
    const Texture t = target(format, 4, 4);
    const TextureView view = t.create_view();
    const ColorAttachment colors[] = {{.view = &view, .clear = color}};
    CommandEncoder encoder = device.create_command_encoder();
    encoder.begin_render_pass({.colors = colors}).end();
    submit_and_wait(encoder);
    return device.read_texture(t);
  }
};

TEST_F(TargetTest, clears) {
  EXPECT_THAT(values_of<std::uint32_t>(cleared(TextureFormat::RGBA8Unorm, {1, 0.5, 0, 1})), Each(0xFF0080FFu));
  EXPECT_THAT(values_of<std::uint32_t>(cleared(TextureFormat::R32Uint, {4294967295.0, 0, 0, 0})), Each(4294967295u));
  EXPECT_THAT(values_of<std::int32_t>(cleared(TextureFormat::R32Sint, {-2147483648.0, 0, 0, 0})), Each(std::numeric_limits<std::int32_t>::min()));
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THAT(values_of<float>(cleared(TextureFormat::R32Float, {inf, 0, 0, 0})), Each(std::numeric_limits<float>::infinity()));
  EXPECT_THAT(values_of<float>(cleared(TextureFormat::RGBA32Float, {-2.5, -2.5, -2.5, -2.5})), Each(-2.5f));
}

TEST_F(TargetTest, several_targets_of_different_formats) {
  const ShaderModule vertex = shader(ShaderStage::Vertex, fullscreen_vertex);
  const ShaderModule fragment = shader(ShaderStage::Fragment, R"(#version 450
layout(location = 0) out vec4 color;
layout(location = 1) out uint id;
layout(location = 2) out float distance;
void main() {
  if (gl_FragCoord.x < 2) discard;
  color = vec4(0.25); id = 42u; distance = 1.5;
}
)");
  const PipelineLayout layout = device.create_pipeline_layout({});
  const ColorTargetState targets[] = {{.format = TextureFormat::RGBA16Float}, {.format = TextureFormat::R32Uint}, {.format = TextureFormat::R32Float}};
  RenderPipelineDescriptor d{.label = "mrt", .layout = &layout, .vertex = {.module = &vertex}};
  d.fragment = ProgrammableStage{.module = &fragment};
  d.targets = targets;
  const RenderPipeline p = device.create_render_pipeline(d);
  const Texture t[] = {target(TextureFormat::RGBA16Float, 4, 1), target(TextureFormat::R32Uint, 4, 1), target(TextureFormat::R32Float, 4, 1)};
  const TextureView v[] = {t[0].create_view(), t[1].create_view(), t[2].create_view()};
  const ColorAttachment colors[] = {{.view = &v[0]},
                                    {.view = &v[1], .clear = {4294967295.0, 0, 0, 0}},
                                    {.view = &v[2], .clear = {std::numeric_limits<double>::infinity(), 0, 0, 0}}};
  CommandEncoder encoder = device.create_command_encoder();
  RenderPass pass = encoder.begin_render_pass({.colors = colors});
  pass.set_pipeline(p);
  pass.draw(3);
  pass.end();
  submit_and_wait(encoder);
  EXPECT_THAT(values_of<std::uint32_t>(device.read_texture(t[1])), testing::ElementsAre(4294967295u, 4294967295u, 42u, 42u));
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_THAT(values_of<float>(device.read_texture(t[2])), testing::ElementsAre(inf, inf, 1.5f, 1.5f));
  constexpr std::uint16_t quarter = 0x3400; // half of 0.25
  EXPECT_EQ(values_of<std::uint16_t>(device.read_texture(t[0]))[8], quarter);
}

TEST_F(TargetTest, premultiplied_blend_and_load) {
  const ShaderModule vertex = shader(ShaderStage::Vertex, fullscreen_vertex);
  const ShaderModule fragment = shader(ShaderStage::Fragment, R"(#version 450
layout(push_constant) uniform Push { vec4 color; };
layout(location = 0) out vec4 result;
void main() { result = color; }
)");
  const PipelineLayout layout = device.create_pipeline_layout({.push_constant_size = 16});
  const BlendComponent over{BlendFactor::One, BlendFactor::OneMinusSrcAlpha, BlendOperation::Add};
  const ColorTargetState targets[] = {{.format = TextureFormat::RGBA32Float, .blend = BlendState{over, over}}};
  RenderPipelineDescriptor d{.label = "blend", .layout = &layout, .vertex = {.module = &vertex}};
  d.fragment = ProgrammableStage{.module = &fragment};
  d.targets = targets;
  const RenderPipeline p = device.create_render_pipeline(d);
  const Texture t = target(TextureFormat::RGBA32Float, 2, 2);
  const TextureView view = t.create_view();
  CommandEncoder encoder = device.create_command_encoder();
  const auto layer = [&](LoadOp load, std::vector<float> color) {
    const ColorAttachment colors[] = {{.view = &view, .load = load, .clear = {0, 0, 1, 1}}};
    RenderPass pass = encoder.begin_render_pass({.colors = colors});
    pass.set_pipeline(p);
    pass.set_push_constants(0, bytes_of(color));
    pass.draw(3);
    pass.end();
  };
  layer(LoadOp::Clear, {0.5f, 0, 0, 0.5f});  // half red over blue
  layer(LoadOp::Load, {0, 0.25f, 0, 0.25f}); // then a quarter of green
  submit_and_wait(encoder);
  const auto values = values_of<float>(device.read_texture(t));
  EXPECT_FLOAT_EQ(values[0], 0.375f);
  EXPECT_FLOAT_EQ(values[1], 0.25f);
  EXPECT_FLOAT_EQ(values[2], 0.375f);
  EXPECT_FLOAT_EQ(values[3], 1.0f);
}

TEST_F(TargetTest, four_samples_are_resolved) {
  const ShaderModule vertex = shader(ShaderStage::Vertex, R"(#version 450
void main() { gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0, 0, 1) * vec4(1, 1, 1, 1) - vec4(0.75, 0, 0, 0); }
)");
  const ShaderModule fragment = shader(ShaderStage::Fragment, "#version 450\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(1); }\n");
  const PipelineLayout layout = device.create_pipeline_layout({});
  const ColorTargetState targets[] = {{.format = TextureFormat::RGBA8Unorm}};
  RenderPipelineDescriptor d{.label = "msaa", .layout = &layout, .vertex = {.module = &vertex}};
  d.fragment = ProgrammableStage{.module = &fragment};
  d.targets = targets;
  d.sample_count = 4;
  const RenderPipeline p = device.create_render_pipeline(d);
  const Texture many = device.create_texture({.label = "samples", .size = {4, 4, 1}, .format = TextureFormat::RGBA8Unorm, .usage = TextureUsage::RenderAttachment, .sample_count = 4});
  const Texture one = target(TextureFormat::RGBA8Unorm, 4, 4);
  const TextureView from = many.create_view(), to = one.create_view();
  const ColorAttachment colors[] = {{.view = &from, .resolve_target = &to, .store = StoreOp::Discard, .clear = {0, 0, 0, 0}}};
  CommandEncoder encoder = device.create_command_encoder();
  RenderPass pass = encoder.begin_render_pass({.colors = colors});
  pass.set_pipeline(p);
  pass.draw(3);
  pass.end();
  submit_and_wait(encoder);
  const auto pixels = values_of<std::uint32_t>(device.read_texture(one));
  EXPECT_EQ(pixels[0], 0xFFFFFFFFu);
  EXPECT_EQ(pixels[15], 0u);
  EXPECT_TRUE(std::any_of(pixels.begin(), pixels.end(), [](std::uint32_t v) { return v != 0 && v != 0xFFFFFFFFu; })) << "no pixel is partly covered";
}

TEST_F(TargetTest, depth_is_tested_read_only_and_sampled_in_one_pass) {
  const Texture depth = device.create_texture({.label = "depth", .size = {4, 4, 1}, .format = TextureFormat::Depth32Float,
                                               .usage = TextureUsage::RenderAttachment | TextureUsage::Sampled | TextureUsage::CopySrc});
  const TextureView depth_view = depth.create_view();
  const BindGroupLayoutEntry entry[] = {{.binding = 0, .visibility = ShaderStage::Fragment, .type = BindingType::SampledTexture, .sample_type = SampleType::Depth}};
  const BindGroupLayout group_layout = device.create_bind_group_layout({.label = "depth", .entries = entry});
  const BindGroupLayout* groups[] = {&group_layout};
  const PipelineLayout layout = device.create_pipeline_layout({.bind_group_layouts = groups});
  const ShaderModule vertex = shader(ShaderStage::Vertex, fullscreen_vertex); // depth 0.5
  const ShaderModule fragment = shader(ShaderStage::Fragment, R"(#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(set = 0, binding = 0) uniform texture2D depth;
layout(location = 0) out float result;
void main() { result = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r; }
)");
  const ColorTargetState targets[] = {{.format = TextureFormat::R32Float}};
  RenderPipelineDescriptor d{.label = "soft", .layout = &layout, .vertex = {.module = &vertex}};
  d.fragment = ProgrammableStage{.module = &fragment};
  d.targets = targets;
  d.depth = DepthState{.write = false};
  const RenderPipeline p = device.create_render_pipeline(d);
  const BindGroupEntry group_entry[] = {{.binding = 0, .texture = &depth_view}};
  const BindGroup group = device.create_bind_group({.label = "depth", .layout = &group_layout, .entries = group_entry});
  const Texture color = target(TextureFormat::R32Float, 4, 4);
  const TextureView color_view = color.create_view();
  CommandEncoder encoder = device.create_command_encoder();
  encoder.begin_render_pass({.depth = DepthAttachment{.view = &depth_view, .clear = 0.25f}}).end();
  const ColorAttachment colors[] = {{.view = &color_view}};
  RenderPass pass = encoder.begin_render_pass({.colors = colors, .depth = DepthAttachment{.view = &depth_view, .load = LoadOp::Load, .read_only = true}});
  pass.set_pipeline(p);
  pass.set_bind_group(0, group);
  pass.draw(3);
  pass.end();
  submit_and_wait(encoder);
  EXPECT_THAT(values_of<float>(device.read_texture(color)), Each(0.25f));
}

} // namespace
} // namespace mote::gpu
