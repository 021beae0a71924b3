// SPDX-License-Identifier: MIT
// Compute: dispatch, indirect dispatch, chained dispatches, storage images, optional number types.
#include "tests/gpu/fixture.hpp"

#include <numeric>

namespace mote::gpu {
namespace {

using testing::Each;

class DispatchTest : public DeviceTest {
protected:
  ComputePipeline compute(const std::string& glsl, std::span<const BindGroupLayoutEntry> entries, std::uint32_t push = 0) {
    module = shader(ShaderStage::Compute, glsl);
    group_layout = device.create_bind_group_layout({.label = "compute", .entries = entries});
    const BindGroupLayout* groups[] = {&group_layout};
    layout = device.create_pipeline_layout({.label = "compute", .bind_group_layouts = groups, .push_constant_size = push});
    return device.create_compute_pipeline({.label = "compute", .layout = &layout, .compute = {.module = &module}});
  }
  Buffer storage(std::string_view label, const std::vector<std::uint32_t>& values, BufferUsage more = BufferUsage::None) {
    return device.create_buffer({.label = label,
                                 .size = values.size() * 4,
                                 .usage = BufferUsage::Storage | BufferUsage::CopySrc | BufferUsage::CopyDst | more,
                                 .contents = bytes_of(values)});
  }
  ShaderModule module;
  BindGroupLayout group_layout;
  PipelineLayout layout;
};

const BindGroupLayoutEntry one_buffer[] = {{.binding = 0, .visibility = ShaderStage::Compute, .type = BindingType::StorageBuffer}};
const std::string add_one = R"(#version 450
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer Data { uint data[]; };
void main() { data[gl_GlobalInvocationID.x] += 1; }
)";

TEST_F(DispatchTest, two_dispatches_in_one_pass_see_each_other) {
  const ComputePipeline p = compute(add_one, one_buffer);
  ASSERT_TRUE(p);
  const Buffer data = storage("data", std::vector<std::uint32_t>(256, 40));
  const BindGroupEntry entries[] = {{.binding = 0, .buffer = {.buffer = &data}}};
  const BindGroup group = device.create_bind_group({.label = "data", .layout = &group_layout, .entries = entries});
  CommandEncoder encoder = device.create_command_encoder();
  ComputePass pass = encoder.begin_compute_pass({.label = "twice"});
  pass.set_pipeline(p);
  pass.set_bind_group(0, group);
  pass.dispatch(4);
  pass.dispatch(4);
  pass.end();
  submit_and_wait(encoder);
  EXPECT_THAT(values_of<std::uint32_t>(device.read_buffer(data)), Each(42u));
}

TEST_F(DispatchTest, indirect_arguments_may_come_from_a_dispatch) {
  const BindGroupLayoutEntry two[] = {{.binding = 0, .visibility = ShaderStage::Compute, .type = BindingType::StorageBuffer}};
  const ComputePipeline p = compute(R"(#version 450
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer Data { uint data[]; };
void main() { atomicAdd(data[0], 1); if (data[1] == 0) data[1] = 3; }
)", two);
  const Buffer arguments = storage("arguments", {0, 1, 1}, BufferUsage::Indirect);
  const Buffer data = storage("data", {0, 1});
  const BindGroupEntry first_entries[] = {{.binding = 0, .buffer = {.buffer = &arguments}}};
  const BindGroupEntry second_entries[] = {{.binding = 0, .buffer = {.buffer = &data}}};
  const BindGroup first = device.create_bind_group({.label = "first", .layout = &group_layout, .entries = first_entries});
  const BindGroup second = device.create_bind_group({.label = "second", .layout = &group_layout, .entries = second_entries});
  CommandEncoder encoder = device.create_command_encoder();
  ComputePass pass = encoder.begin_compute_pass();
  pass.set_pipeline(p);
  pass.set_bind_group(0, first);
  pass.dispatch(5); // arguments[0] becomes 5
  pass.set_bind_group(0, second);
  pass.dispatch_indirect(arguments, 0);
  pass.end();
  submit_and_wait(encoder);
  EXPECT_EQ(values_of<std::uint32_t>(device.read_buffer(data))[0], 5u);
}

TEST_F(DispatchTest, storage_image_is_written_and_sampled_later) {
  const BindGroupLayoutEntry image[] = {{.binding = 0,
                                         .visibility = ShaderStage::Compute,
                                         .type = BindingType::StorageTexture,
                                         .storage_format = TextureFormat::R32Uint}};
  const ComputePipeline p = compute(R"(#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, r32ui) uniform writeonly uimage2D picture;
void main() { imageStore(picture, ivec2(gl_GlobalInvocationID.xy), uvec4(gl_GlobalInvocationID.x + 16 * gl_GlobalInvocationID.y)); }
)", image);
  ASSERT_TRUE(p);
  const Texture picture = device.create_texture(
      {.label = "picture", .size = {16, 16, 1}, .format = TextureFormat::R32Uint, .usage = TextureUsage::Storage | TextureUsage::CopySrc});
  const TextureView view = picture.create_view();
  const BindGroupEntry entries[] = {{.binding = 0, .texture = &view}};
  const BindGroup group = device.create_bind_group({.label = "picture", .layout = &group_layout, .entries = entries});
  CommandEncoder encoder = device.create_command_encoder();
  ComputePass pass = encoder.begin_compute_pass();
  pass.set_pipeline(p);
  pass.set_bind_group(0, group);
  pass.dispatch(2, 2);
  pass.end();
  submit_and_wait(encoder);
  std::vector<std::uint32_t> expected(256);
  std::iota(expected.begin(), expected.end(), 0u);
  EXPECT_EQ(values_of<std::uint32_t>(device.read_texture(picture)), expected);
}

TEST_F(DispatchTest, push_constants_in_compute) {
  const ComputePipeline p = compute(R"(#version 450
layout(local_size_x = 4) in;
layout(push_constant) uniform Push { uint add, times; } push;
layout(set = 0, binding = 0) buffer Data { uint data[]; };
void main() { data[gl_GlobalInvocationID.x] = data[gl_GlobalInvocationID.x] * push.times + push.add; }
)", one_buffer, 8);
  const Buffer data = storage("data", {1, 2, 3, 4});
  const BindGroupEntry entries[] = {{.binding = 0, .buffer = {.buffer = &data}}};
  const BindGroup group = device.create_bind_group({.layout = &group_layout, .entries = entries});
  CommandEncoder encoder = device.create_command_encoder();
  ComputePass pass = encoder.begin_compute_pass();
  pass.set_pipeline(p);
  pass.set_bind_group(0, group);
  const std::vector<std::uint32_t> push{7, 10};
  pass.set_push_constants(0, bytes_of(push));
  pass.dispatch(1);
  pass.end();
  submit_and_wait(encoder);
  EXPECT_THAT(values_of<std::uint32_t>(device.read_buffer(data)), testing::ElementsAre(17u, 27u, 37u, 47u));
}

TEST_F(DispatchTest, groups_and_push_constants_stay_set_across_pipelines) {
  const std::string text = R"(#version 450
layout(local_size_x = 4) in;
layout(push_constant) uniform Push { uint add; } push;
layout(set = 0, binding = 0) buffer Data { uint data[]; };
void main() { data[gl_GlobalInvocationID.x] += push.add; }
)";
  const ComputePipeline first = compute(text, one_buffer, 4);
  const BindGroupLayout first_layout = group_layout;
  const ComputePipeline second = compute(text, one_buffer, 64); // another layout: Vulkan forgets what was bound
  const Buffer data = storage("data", {1, 2, 3, 4});
  const BindGroupEntry entries[] = {{.binding = 0, .buffer = {.buffer = &data}}};
  const BindGroup group = device.create_bind_group({.layout = &first_layout, .entries = entries});
  CommandEncoder encoder = device.create_command_encoder();
  ComputePass pass = encoder.begin_compute_pass();
  pass.set_bind_group(0, group); // before any pipeline
  const std::uint32_t ten = 10;
  pass.set_push_constants(0, bytes_of_value(ten));
  pass.set_pipeline(first);
  pass.dispatch(1);
  pass.set_pipeline(second);
  pass.dispatch(1);
  pass.end();
  submit_and_wait(encoder);
  EXPECT_THAT(values_of<std::uint32_t>(device.read_buffer(data)), testing::ElementsAre(21u, 22u, 23u, 24u));
}

TEST_F(DispatchTest, int64_atomics_and_subgroups_work_where_offered) {
  const Feature needed = Feature::Int64Atomics | Feature::ShaderInt64 | Feature::Subgroups;
  ASSERT_TRUE(has(all_features(), needed)) << "lavapipe offers these: " << to_string(all_features());
  const ComputePipeline p = compute(R"(#version 450
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#extension GL_KHR_shader_subgroup_arithmetic : require
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer Data { uint64_t least; uint sum; };
void main() {
  atomicMin(least, (uint64_t(gl_GlobalInvocationID.x + 5) << 40) | 3ul);
  uint part = subgroupAdd(gl_LocalInvocationIndex);
  if (subgroupElect()) atomicAdd(sum, part);
}
)", one_buffer);
  ASSERT_TRUE(p);
  const Buffer data = storage("data", {0xFFFFFFFFu, 0xFFFFFFFFu, 0, 0});
  const BindGroupEntry entries[] = {{.binding = 0, .buffer = {.buffer = &data}}};
  const BindGroup group = device.create_bind_group({.layout = &group_layout, .entries = entries});
  CommandEncoder encoder = device.create_command_encoder();
  ComputePass pass = encoder.begin_compute_pass();
  pass.set_pipeline(p);
  pass.set_bind_group(0, group);
  pass.dispatch(2);
  pass.end();
  submit_and_wait(encoder);
  const auto bytes = device.read_buffer(data);
  EXPECT_EQ(values_of<std::uint64_t>(bytes)[0], (std::uint64_t{5} << 40) | 3u);
  EXPECT_EQ(values_of<std::uint32_t>(bytes)[2], 2u * 63u * 64u / 2u);
}

} // namespace
} // namespace mote::gpu
