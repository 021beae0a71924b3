// SPDX-License-Identifier: MIT
// Timestamps and pipeline statistics.
#include "core/gpu/observe.hpp"
#include "tests/gpu/fixture.hpp"

namespace mote::gpu {
namespace {

class QueryTest : public DeviceTest {
protected:
  Buffer results(std::uint64_t count) {
    return device.create_buffer({.label = "results", .size = count * 8, .usage = BufferUsage::QueryResolve | BufferUsage::CopySrc});
  }
};

TEST_F(QueryTest, timestamps_grow) {
  const QuerySet set = device.create_query_set({.label = "times", .count = 4});
  const Buffer out = results(4);
  for (int round = 0; round < 2; ++round) { // the second round resets what the first wrote
    CommandEncoder encoder = device.create_command_encoder();
    encoder.write_timestamp(set, 0);
    encoder.begin_compute_pass({.timestamps = TimestampWrites{&set, 1, 2}}).end();
    encoder.write_timestamp(set, 3);
    encoder.resolve_query_set(set, 0, 4, out, 0);
    submit_and_wait(encoder);
    const auto t = values_of<std::uint64_t>(device.read_buffer(out));
    EXPECT_TRUE(std::is_sorted(t.begin(), t.end())) << t[0] << " " << t[1] << " " << t[2] << " " << t[3];
    EXPECT_GT(t[0], 0u);
  }
  EXPECT_GT(device.limits().timestamp_period_ns, 0.0f);
}

TEST_F(QueryTest, resolving_what_was_never_written_is_an_error) {
  const QuerySet set = device.create_query_set({.label = "times", .count = 2});
  const Buffer out = results(2);
  CommandEncoder encoder = device.create_command_encoder();
  encoder.write_timestamp(set, 0);
  encoder.resolve_query_set(set, 0, 2, out, 0);
  const Error error = expect_error(ErrorFilter::Validation, [&] { submit_and_wait(encoder); });
  EXPECT_EQ(error.code, "V-QRY-003");
  EXPECT_THAT(error.message, testing::HasSubstr("[0, 2) of [QuerySet \"times\"]"));
}

TEST_F(QueryTest, statistics_count_invocations) {
  const QuerySet set = device.create_query_set({.label = "statistics", .type = QueryType::PipelineStatistics, .count = 2});
  const Buffer out = results(8);
  const ShaderModule vertex = shader(ShaderStage::Vertex, fullscreen_vertex);
  const ShaderModule fragment = shader(ShaderStage::Fragment, "#version 450\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(1); }\n");
  const PipelineLayout layout = device.create_pipeline_layout({});
  const ColorTargetState targets[] = {{.format = TextureFormat::RGBA8Unorm}};
  RenderPipelineDescriptor d{.layout = &layout, .vertex = {.module = &vertex}};
  d.fragment = ProgrammableStage{.module = &fragment};
  d.targets = targets;
  const RenderPipeline p = device.create_render_pipeline(d);
  const Texture picture = target(TextureFormat::RGBA8Unorm, 16, 16);
  const TextureView view = picture.create_view();
  const ColorAttachment colors[] = {{.view = &view}};
  CommandEncoder encoder = device.create_command_encoder();
  RenderPass pass = encoder.begin_render_pass({.colors = colors});
  pass.set_pipeline(p);
  pass.begin_pipeline_statistics(set, 1);
  pass.draw(3, 2);
  pass.end_pipeline_statistics();
  pass.end();
  encoder.resolve_query_set(set, 1, 1, out, 0);
  submit_and_wait(encoder);
  PipelineStatistics s;
  const auto bytes = device.read_buffer(out);
  ASSERT_EQ(bytes.size(), sizeof s);
  std::memcpy(&s, bytes.data(), sizeof s);
  EXPECT_EQ(s.vertices, 6u);
  EXPECT_EQ(s.primitives, 2u);
  EXPECT_GE(s.vertex_invocations, 1u);
  EXPECT_GE(s.fragment_invocations, 256u);
}

TEST_F(QueryTest, an_encoder_counts_each_of_its_passes) {
  const QuerySet set = device.create_query_set({.label = "statistics", .type = QueryType::PipelineStatistics, .count = 3});
  const Buffer out = results(16);
  const ShaderModule vertex = shader(ShaderStage::Vertex, R"(#version 450
layout(location = 0) out vec3 smooth_v; layout(location = 1) flat out vec2 flat_v;
void main() { vec2 p = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4 - 1; smooth_v = p.xyx; flat_v = p; gl_Position = vec4(p, 0, 1); }
)");
  const ShaderModule fragment = shader(ShaderStage::Fragment, R"(#version 450
layout(location = 0) in vec3 smooth_v; layout(location = 1) flat in vec2 flat_v; layout(location = 0) out vec4 c;
void main() { c = vec4(smooth_v, flat_v.x + flat_v.y); }
)");
  const PipelineLayout layout = device.create_pipeline_layout({});
  const ColorTargetState targets[] = {{.format = TextureFormat::RGBA8Unorm}};
  RenderPipelineDescriptor d{.layout = &layout, .vertex = {.module = &vertex}};
  d.fragment = ProgrammableStage{.module = &fragment};
  d.targets = targets;
  const RenderPipeline p = device.create_render_pipeline(d);
  const Texture picture = target(TextureFormat::RGBA8Unorm, 16, 16);
  const TextureView view = picture.create_view();
  const ColorAttachment colors[] = {{.view = &view}};
  CommandEncoder encoder = device.create_command_encoder();
  const std::size_t first = command_count(encoder);
  encoder.begin_pipeline_statistics(set, 1);
  for (const std::uint32_t triangles : {1u, 2u, 1u}) { // the third finds the set full
    RenderPass pass = encoder.begin_render_pass({.colors = colors});
    pass.set_pipeline(p);
    pass.draw(3, triangles);
    pass.end();
  }
  EXPECT_EQ(counted_passes(encoder), 2u);
  encoder.end_pipeline_statistics();
  EXPECT_EQ(fragment_inputs(encoder, first).interpolated, 3u);
  EXPECT_EQ(fragment_inputs(encoder, first).flat, 2u);
  EXPECT_EQ(fragment_inputs(encoder, command_count(encoder)).flat, 0u);
  encoder.resolve_query_set(set, 1, 2, out, 0);
  submit_and_wait(encoder);
  const auto bytes = device.read_buffer(out);
  ASSERT_EQ(bytes.size(), 2 * sizeof(PipelineStatistics));
  for (std::uint64_t k = 0; k < 2; ++k) {
    PipelineStatistics s;
    std::memcpy(&s, bytes.data() + k * sizeof s, sizeof s);
    EXPECT_EQ(s.vertices, 3 * (k + 1));
    EXPECT_EQ(s.primitives, k + 1);
    EXPECT_GE(s.fragment_invocations, 256u);
  }
}

TEST_F(QueryTest, statistics_are_opened_once_and_closed) {
  const QuerySet set = device.create_query_set({.label = "statistics", .type = QueryType::PipelineStatistics, .count = 2});
  const auto code_of = [&](auto&& record) {
    return expect_error(ErrorFilter::Validation, [&] {
      CommandEncoder encoder = device.create_command_encoder("e");
      record(encoder);
      (void)encoder.finish();
    }).code;
  };
  EXPECT_EQ(code_of([&](CommandEncoder& e) { e.begin_pipeline_statistics(set, 0); }), "V-QRY-004");
  EXPECT_EQ(code_of([&](CommandEncoder& e) { e.end_pipeline_statistics(); }), "V-QRY-004");
  EXPECT_EQ(code_of([&](CommandEncoder& e) {
              e.begin_pipeline_statistics(set, 0);
              e.begin_pipeline_statistics(set, 1);
            }), "V-QRY-004");
  const Texture picture = target(TextureFormat::RGBA8Unorm, 16, 16);
  const TextureView view = picture.create_view();
  const ColorAttachment colors[] = {{.view = &view}};
  EXPECT_EQ(code_of([&](CommandEncoder& e) {
              e.begin_pipeline_statistics(set, 0);
              RenderPass pass = e.begin_render_pass({.colors = colors});
              pass.begin_pipeline_statistics(set, 1);
            }), "V-QRY-004");
}

} // namespace
} // namespace mote::gpu
