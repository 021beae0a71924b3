// SPDX-License-Identifier: MIT
// Errors through the public calls: one failing call per group of rules, what becomes of the objects,
// and that follow-up errors keep silent. (Every single rule is tested without a device in gpu_unit.)
#include "tests/gpu/fixture.hpp"

#include <fmt/format.h>

namespace mote::gpu {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ErrorsTest : public DeviceTest {
protected:
  template <class Body> void expect(std::string_view code, std::string_view words, Body&& body) {
    const Error error = expect_error(ErrorFilter::Validation, std::forward<Body>(body));
    EXPECT_EQ(error.code, code) << error.message;
    EXPECT_THAT(error.message, HasSubstr(std::string(words)));
    EXPECT_FALSE(error.context.empty());
  }
  Buffer buffer(BufferUsage usage, std::uint64_t size = 256) { return device.create_buffer({.label = "b", .size = size, .usage = usage}); }
  RenderPass pass_on(CommandEncoder& encoder, const Texture& t) {
    const TextureView view = t.create_view();
    const ColorAttachment colors[] = {{.view = &view}};
    return encoder.begin_render_pass({.label = "pass", .colors = colors});
  }
  RenderPipeline plain_pipeline(std::uint32_t push = 0) {
    const ShaderModule vertex = shader(ShaderStage::Vertex, fullscreen_vertex, "full");
    const ShaderModule fragment = shader(ShaderStage::Fragment, push > 0 ? "#version 450\nlayout(push_constant) uniform P { vec4 p; };\nlayout(location = 0) out vec4 c;\nvoid main() { c = p; }\n"
                                                                         : "#version 450\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(1); }\n");
    const PipelineLayout layout = device.create_pipeline_layout({.label = "plain", .push_constant_size = push});
    const ColorTargetState targets[] = {{.format = TextureFormat::RGBA8Unorm}};
    RenderPipelineDescriptor d{.label = "plain", .layout = &layout, .vertex = {.module = &vertex}};
    d.fragment = ProgrammableStage{.module = &fragment};
    d.targets = targets;
    return device.create_render_pipeline(d);
  }
};

TEST_F(ErrorsTest, context_names_call_and_object) {
  const Error error = expect_error(ErrorFilter::Validation, [&] { static_cast<void>(device.create_buffer({.label = "empty", .usage = BufferUsage::Storage})); });
  EXPECT_EQ(error.code, "V-BUF-001");
  EXPECT_THAT(error.context, ElementsAre("While calling [Device \"test\"].create_buffer([BufferDescriptor \"empty\"])."));
}

TEST_F(ErrorsTest, objects_of_failed_calls_are_invalid_and_silent_later) {
  Texture bad;
  expect("V-TEX-004", "Undefined", [&] { bad = device.create_texture({.label = "bad", .size = {4, 4, 1}, .usage = TextureUsage::Sampled}); });
  EXPECT_FALSE(bad);
  // Everything below is caused by the texture: nothing more is said.
  const TextureView view = bad.create_view();
  EXPECT_FALSE(view);
  const ColorAttachment colors[] = {{.view = &view}};
  CommandEncoder encoder = device.create_command_encoder();
  RenderPass pass = encoder.begin_render_pass({.colors = colors});
  EXPECT_FALSE(pass);
  pass.draw(3);
  pass.end();
  const CommandBuffer commands = encoder.finish();
  EXPECT_FALSE(commands);
  device.queue().submit(commands);
}

TEST_F(ErrorsTest, empty_handles_are_named) {
  CommandEncoder encoder = device.create_command_encoder("e");
  expect("V-OBJ-001", "[Buffer] was never made", [&] { encoder.clear_buffer(Buffer{}); });
  expect("V-OBJ-001", "[PipelineLayout] is missing", [&] { static_cast<void>(device.create_compute_pipeline({.label = "c"})); });
}

TEST_F(ErrorsTest, objects_of_another_device) {
  Device other = make_device({.label = "other"});
  const Buffer foreign = other.create_buffer({.label = "foreign", .size = 16, .usage = BufferUsage::CopyDst});
  CommandEncoder encoder = device.create_command_encoder();
  expect("V-OBJ-002", "[Buffer \"foreign\"] belongs to [Device \"other\"], not to [Device \"test\"]", [&] { encoder.clear_buffer(foreign); });
}

TEST_F(ErrorsTest, view_sampler_queries_layouts) {
  const Texture t = target(TextureFormat::RGBA8Unorm, 4, 4);
  expect("V-VIEW-001", "which has 1", [&] { static_cast<void>(t.create_view({.base_mip_level = 1})); });
  expect("V-SAMP-002", "is 0", [&] { static_cast<void>(device.create_sampler({.max_anisotropy = 0})); });
  expect("V-QRY-001", "is 0", [&] { static_cast<void>(device.create_query_set({})); });
  const BindGroupLayoutEntry entry[] = {{.binding = 3}};
  expect("V-BGL-002", "binding 3", [&] { static_cast<void>(device.create_bind_group_layout({.entries = entry})); });
  expect("V-PLAY-002", "is 5", [&] { static_cast<void>(device.create_pipeline_layout({.push_constant_size = 5})); });
  const std::vector<std::uint32_t> noise(8, 1);
  expect("V-SHDR-001", "not SPIR-V", [&] { static_cast<void>(device.create_shader_module({.spirv = noise})); });
}

TEST_F(ErrorsTest, bind_groups) {
  const BindGroupLayoutEntry entry[] = {{.binding = 0, .visibility = ShaderStage::Compute, .type = BindingType::StorageBuffer}};
  const BindGroupLayout layout = device.create_bind_group_layout({.label = "one", .entries = entry});
  expect("V-BIND-001", "[BindGroupLayout \"one\"] has 1 bindings", [&] { static_cast<void>(device.create_bind_group({.label = "g", .layout = &layout})); });
  const Buffer uniform = buffer(BufferUsage::Uniform);
  const BindGroupEntry wrong[] = {{.binding = 0, .buffer = {.buffer = &uniform}}};
  const Error error = expect_error(ErrorFilter::Validation, [&] { static_cast<void>(device.create_bind_group({.label = "g", .layout = &layout, .entries = wrong})); });
  EXPECT_EQ(error.code, "V-BUF-008");
  EXPECT_THAT(error.context, ElementsAre("While validating entries[0], binding 0.", "While calling [Device \"test\"].create_bind_group([BindGroupDescriptor \"g\"])."));
}

TEST_F(ErrorsTest, a_buffer_larger_than_a_binding_can_be_made_but_not_bound_whole) {
  const std::uint64_t limit = device.limits().max_storage_buffer_binding_size;
  const Buffer large = buffer(BufferUsage::Storage, limit + 256);
  ASSERT_TRUE(large);
  const BindGroupLayoutEntry entry[] = {{.binding = 0, .visibility = ShaderStage::Compute, .type = BindingType::StorageBuffer}};
  const BindGroupLayout layout = device.create_bind_group_layout({.entries = entry});
  const auto bind = [&](std::uint64_t offset, std::uint64_t size) {
    const BindGroupEntry entries[] = {{.binding = 0, .buffer = {&large, offset, size}}};
    return device.create_bind_group({.layout = &layout, .entries = entries});
  };
  EXPECT_TRUE(bind(256, limit));
  expect("V-BIND-007", std::to_string(limit + 256) + " bytes of [Buffer \"b\"]", [&] { static_cast<void>(bind(0, 0)); });
}

TEST_F(ErrorsTest, pipelines) {
  const PipelineLayout layout = device.create_pipeline_layout({.label = "none"});
  const ShaderModule module = shader(ShaderStage::Compute, "#version 450\nlayout(local_size_x = 1) in;\nlayout(set = 0, binding = 0) buffer B { uint b; };\nvoid main() { b = 1; }\n", "sort");
  const Error error = expect_error(ErrorFilter::Validation, [&] { static_cast<void>(device.create_compute_pipeline({.label = "sort", .layout = &layout, .compute = {.module = &module}})); });
  EXPECT_EQ(error.code, "V-PIPE-002");
  EXPECT_THAT(error.context, ElementsAre("While validating the compute stage.", "While calling [Device \"test\"].create_compute_pipeline([ComputePipelineDescriptor \"sort\"])."));
}

TEST_F(ErrorsTest, geometry_stage_without_its_feature) {
  const std::string geometry_text = "#version 450\nlayout(points) in;\nlayout(points, max_vertices = 1) out;\nvoid main() {}\n";
  const ShaderModule borrowed = shader(ShaderStage::Geometry, geometry_text);
  device = make_device({.label = "plain"});
  const PipelineLayout layout = device.create_pipeline_layout({});
  RenderPipelineDescriptor d{.label = "quad", .layout = &layout};
  d.geometry = ProgrammableStage{.module = &borrowed};
  expect("V-FEAT-001", "RenderPipelineDescriptor.geometry is set but Feature GeometryShader is not enabled on [Device \"plain\"]", [&] { static_cast<void>(device.create_render_pipeline(d)); });
  expect("V-FEAT-001", "GeometryShader", [&] { static_cast<void>(shader(ShaderStage::Geometry, geometry_text)); });
}

TEST_F(ErrorsTest, encoder_states) {
  CommandEncoder encoder = device.create_command_encoder("e");
  const Texture t = target(TextureFormat::RGBA8Unorm, 4, 4);
  const Buffer b = buffer(BufferUsage::CopyDst);
  RenderPass pass = pass_on(encoder, t);
  expect("V-ENC-002", "[CommandEncoder \"e\"] is locked", [&] { encoder.clear_buffer(b); });
  pass.end();
  CommandEncoder second = device.create_command_encoder("f");
  const CommandBuffer commands = second.finish();
  expect("V-ENC-001", "[CommandEncoder \"f\"] has been finished already", [&] { second.clear_buffer(b); });
  device.queue().submit(commands);
  expect("V-SUB-001", "[CommandBuffer \"f\"] has been submitted already", [&] { device.queue().submit(commands); });
  CommandEncoder third = device.create_command_encoder("g");
  third.push_debug_group("open");
  expect("V-ENC-003", "1 open debug groups", [&] { static_cast<void>(third.finish()); });
}

TEST_F(ErrorsTest, pass_after_its_end) {
  CommandEncoder encoder = device.create_command_encoder();
  RenderPass pass = pass_on(encoder, target(TextureFormat::RGBA8Unorm, 4, 4));
  pass.end();
  expect("V-PASS-001", "[RenderPass \"pass\"] has ended already", [&] { pass.draw(3); });
}

TEST_F(ErrorsTest, draws) {
  const RenderPipeline p = plain_pipeline(16);
  const Texture t = target(TextureFormat::RGBA8Unorm, 4, 4), other = target(TextureFormat::R32Float, 4, 4);
  const auto in_pass = [&](const Texture& picture, auto&& body) { // each in an encoder of its own: the first error ends it
    CommandEncoder encoder = device.create_command_encoder();
    RenderPass pass = pass_on(encoder, picture);
    body(pass);
  };
  expect("V-DRAW-001", "no pipeline", [&] { in_pass(t, [](RenderPass& pass) { pass.draw(3); }); });
  expect("V-PASS-010", "targets[0] of [RenderPipeline \"plain\"] is rgba8unorm; colors[0] of the pass is r32float", [&] { in_pass(other, [&](RenderPass& pass) { pass.set_pipeline(p); }); });
  expect("V-DRAW-004", "16 bytes of push constants", [&] {
    in_pass(t, [&](RenderPass& pass) {
      pass.set_pipeline(p);
      pass.draw(3);
    });
  });
  const std::uint32_t most = std::min(256u, device.limits().max_push_constant_size); // 128 on Debian 12's lavapipe, 256 on Debian 13's
  expect("V-PUSH-001", fmt::format("[{}, {})", most - 4, most + 4), [&] {
    in_pass(t, [&](RenderPass& pass) { pass.set_push_constants(most - 4, std::as_bytes(std::span("1234567"))); });
  });
  expect("V-DRAW-009", "4x4", [&] { in_pass(t, [&](RenderPass& pass) { pass.set_scissor(1, 0, 4, 4); }); });
  expect("V-DRAW-008", "0x4", [&] { in_pass(t, [&](RenderPass& pass) { pass.set_viewport(0, 0, 0, 4); }); });
  expect("V-BUF-008", "As the vertex buffer, [Buffer \"b\"] needs usage Vertex; it has Index", [&] { in_pass(t, [&](RenderPass& pass) { pass.set_vertex_buffer(0, buffer(BufferUsage::Index)); }); });
}

TEST_F(ErrorsTest, dispatches_and_conflicting_uses) {
  const BindGroupLayoutEntry entry[] = {{.binding = 0, .visibility = ShaderStage::Compute, .type = BindingType::StorageBuffer},
                                        {.binding = 1, .visibility = ShaderStage::Compute, .type = BindingType::ReadOnlyStorageBuffer}};
  const BindGroupLayout layout = device.create_bind_group_layout({.label = "two", .entries = entry});
  const Buffer b = buffer(BufferUsage::Storage);
  const BindGroupEntry entries[] = {{.binding = 0, .buffer = {.buffer = &b}}, {.binding = 1, .buffer = {.buffer = &b}}};
  expect("V-USE-001", "[Buffer \"b\"] is used as StorageWrite and as StorageRead", [&] { static_cast<void>(device.create_bind_group({.layout = &layout, .entries = entries})); });
  CommandEncoder encoder = device.create_command_encoder();
  ComputePass pass = encoder.begin_compute_pass({.label = "c"});
  expect("V-DISP-001", "[ComputePass \"c\"] has no pipeline", [&] { pass.dispatch(1); });
}

TEST_F(ErrorsTest, attachment_that_is_also_sampled) {
  const Texture t = device.create_texture({.label = "loop", .size = {4, 4, 1}, .format = TextureFormat::RGBA8Unorm, .usage = TextureUsage::RenderAttachment | TextureUsage::Sampled});
  const TextureView view = t.create_view();
  const BindGroupLayoutEntry entry[] = {{.binding = 0, .visibility = ShaderStage::Fragment, .type = BindingType::SampledTexture}};
  const BindGroupLayout layout = device.create_bind_group_layout({.entries = entry});
  const BindGroupEntry entries[] = {{.binding = 0, .texture = &view}};
  const BindGroup group = device.create_bind_group({.layout = &layout, .entries = entries});
  CommandEncoder encoder = device.create_command_encoder();
  RenderPass pass = pass_on(encoder, t);
  expect("V-USE-001", "[Texture \"loop\"] is used as ColorAttachment and as Sampled", [&] { pass.set_bind_group(0, group); });
}

TEST_F(ErrorsTest, copies_and_writes) {
  const Buffer a = buffer(BufferUsage::CopySrc | BufferUsage::CopyDst);
  const auto copy = [&](auto&& body) {
    CommandEncoder encoder = device.create_command_encoder();
    body(encoder);
  };
  expect("V-COPY-001", "[Buffer \"b\"] is both", [&] { copy([&](CommandEncoder& e) { e.copy_buffer_to_buffer(a, 0, a, 128, 16); }); });
  expect("V-BUF-007", "[248, 264)", [&] { device.queue().write_buffer(a, 248, std::as_bytes(std::span("123456789abcdef"))); });
  const Texture t = target(TextureFormat::RGBA8Unorm, 4, 4);
  expect("V-TEX-009", "needs usage CopyDst", [&] { device.queue().write_texture({.texture = &t}, {}, 0, 0, {1, 1, 1}); });
  expect("V-COPY-005", "3x2x1", [&] { copy([&](CommandEncoder& e) { e.copy_texture_to_buffer({.texture = &t, .origin = {2, 0, 0}}, {.buffer = &a}, {3, 2, 1}); }); });
  expect("V-BUF-008", "needs usage CopySrc", [&] { static_cast<void>(device.read_buffer(buffer(BufferUsage::Storage))); });
}

TEST_F(ErrorsTest, scopes_nest_by_kind_and_popping_too_often_is_an_error) {
  device.push_error_scope(ErrorFilter::Validation);
  device.push_error_scope(ErrorFilter::OutOfMemory);
  static_cast<void>(device.create_buffer({}));
  EXPECT_FALSE(device.pop_error_scope());
  EXPECT_TRUE(device.pop_error_scope());
  std::string seen;
  device.on_uncaptured_error([&](const Error& e) { seen = e.code; });
  EXPECT_FALSE(device.pop_error_scope());
  EXPECT_EQ(seen, "V-DEV-001");
}

} // namespace
} // namespace mote::gpu
