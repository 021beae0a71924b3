// SPDX-License-Identifier: MIT
// What is read out of SPIR-V modules.
#include "tests/gpu/rules.hpp"

#include <fstream>

namespace mote::gpu {
namespace {

TEST(Reflection, bindings_and_their_kinds) {
  const Reflection r = reflect(spirv_of(ShaderStage::Compute, R"(#version 450
layout(local_size_x = 8, local_size_y = 4, local_size_z = 2) in;
layout(set = 0, binding = 0) uniform U { vec4 a[3]; };
layout(set = 0, binding = 1) readonly buffer R { uint count; vec4 list[]; };
layout(set = 0, binding = 2) buffer W { uint data[]; };
layout(set = 1, binding = 0) uniform texture3D volume;
layout(set = 1, binding = 1) uniform sampler linear;
layout(set = 1, binding = 5, rgba16f) uniform writeonly image2DArray picture;
layout(set = 1, binding = 6, r32ui) uniform readonly uimage2D ids;
void main() {
  data[0] = count + uint(a[1].x + list[0].x + texture(sampler3D(volume, linear), vec3(0)).x) + imageLoad(ids, ivec2(0)).x;
  imageStore(picture, ivec3(0), vec4(0));
}
)"));
  ASSERT_EQ(r.entry_points.size(), 1u);
  const ReflectedEntryPoint& e = r.entry_points[0];
  EXPECT_EQ(e.stage, ShaderStage::Compute);
  EXPECT_THAT(e.local_size, testing::ElementsAre(8u, 4u, 2u));
  ASSERT_EQ(e.bindings.size(), 7u);
  const BindingType types[] = {BindingType::UniformBuffer,  BindingType::ReadOnlyStorageBuffer, BindingType::StorageBuffer,         BindingType::SampledTexture,
                               BindingType::Sampler,        BindingType::StorageTexture,        BindingType::ReadOnlyStorageTexture};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(e.bindings[i].type, types[i]) << i;
  EXPECT_EQ(e.bindings[0].min_size, 48u);
  EXPECT_EQ(e.bindings[1].min_size, 32u); // padded count and one element
  EXPECT_EQ(e.bindings[3].dimension, TextureViewDimension::D3);
  EXPECT_EQ(e.bindings[5].binding, 5u);
  EXPECT_EQ(e.bindings[5].dimension, TextureViewDimension::D2Array);
  EXPECT_EQ(e.bindings[5].storage_format, TextureFormat::RGBA16Float);
  EXPECT_EQ(e.bindings[6].sample_type, SampleType::Uint);
}

TEST(Reflection, unused_bindings_do_not_count) {
  const Reflection r = reflect(spirv_of(ShaderStage::Compute, R"(#version 450
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer W { uint data[]; };
layout(set = 3, binding = 9) uniform U { vec4 unused; };
void main() { data[0] = 1; }
)"));
  ASSERT_EQ(r.entry_points[0].bindings.size(), 1u);
}

TEST(Reflection, locations_push_constants_and_specialization) {
  const Reflection r = reflect(spirv_of(ShaderStage::Fragment, R"(#version 450
layout(constant_id = 7) const int steps = 12;
layout(constant_id = 2) const bool fancy = true;
layout(push_constant) uniform Push { layout(offset = 16) vec3 a; float b; };
layout(location = 2) in vec3 normal;
layout(location = 0) flat in uint id;
layout(location = 0) out vec4 color;
layout(location = 1) out uint pick;
void main() { color = vec4(normal * a * b * float(steps), fancy ? 1 : 0); pick = id; gl_FragDepth = 0.5; }
)"));
  const ReflectedEntryPoint& e = r.entry_points[0];
  EXPECT_EQ(e.push_constant_size, 32u);
  EXPECT_TRUE(e.writes_depth);
  ASSERT_EQ(e.inputs.size(), 2u);
  EXPECT_EQ(e.inputs[0].kind, FormatKind::Uint);
  EXPECT_EQ(e.inputs[1].location, 2u);
  EXPECT_EQ(e.inputs[1].components, 3u);
  ASSERT_EQ(e.outputs.size(), 2u);
  EXPECT_EQ(e.outputs[1].kind, FormatKind::Uint);
  ASSERT_EQ(r.constants.size(), 2u);
  EXPECT_EQ(r.constants[0].id, 2u);
  EXPECT_EQ(r.constants[1].id, 7u);
  EXPECT_EQ(r.constants[1].bits, 12u);
}

TEST(Reflection, geometry_modes) {
  const Reflection r = reflect(spirv_of(ShaderStage::Geometry, R"(#version 450
layout(lines, invocations = 2) in;
layout(triangle_strip, max_vertices = 6) out;
layout(location = 3) in vec2 width[];
layout(location = 0) out vec4 tint;
void main() { tint = vec4(width[1], 0, 0); gl_Position = gl_in[1].gl_Position; EmitVertex(); }
)"));
  const ReflectedEntryPoint& e = r.entry_points[0];
  EXPECT_EQ(e.geometry.input, Topology::LineList);
  EXPECT_EQ(e.geometry.output, Topology::TriangleStrip);
  EXPECT_EQ(e.geometry.max_vertices, 6u);
  EXPECT_EQ(e.geometry.invocations, 2u);
  ASSERT_EQ(e.inputs.size(), 1u) << "the per-vertex array is one location";
  EXPECT_EQ(e.inputs[0].location, 3u);
  EXPECT_TRUE(has(r.features, Feature::GeometryShader));
}

TEST(Reflection, features_from_capabilities) {
  const Reflection r = reflect(spirv_of(ShaderStage::Compute, R"(#version 450
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#extension GL_KHR_shader_subgroup_ballot : require
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer B { uint64_t v; };
void main() { if (subgroupElect()) atomicMin(v, uint64_t(subgroupBallotBitCount(subgroupBallot(true)))); }
)"));
  EXPECT_EQ(r.features, Feature::ShaderInt64 | Feature::Int64Atomics | Feature::Subgroups);
}

TEST(Reflection, arrays_and_matrices_take_several_locations) {
  const Reflection r = reflect(spirv_of(ShaderStage::Vertex, R"(#version 450
layout(location = 1) out mat3 frame;
layout(location = 5) out float list[2];
void main() { frame = mat3(1); list[0] = list[1] = 0; gl_Position = vec4(0); }
)"));
  std::vector<std::uint32_t> locations;
  for (const auto& v : r.entry_points[0].outputs) locations.push_back(v.location);
  EXPECT_THAT(locations, testing::ElementsAre(1u, 2u, 3u, 5u, 6u));
}

TEST(Reflection, refusals) {
  expect_broken("V-SHDR-001", "0 words", [] { reflect({}); });
  const std::vector<std::uint32_t> noise(32, 0x12345678u);
  expect_broken("V-SHDR-001", "starts with 0x12345678", [&] { reflect(noise); });
  auto cut = spirv_of(ShaderStage::Compute, "#version 450\nlayout(local_size_x = 1) in;\nvoid main() {}\n");
  cut.resize(cut.size() - 2);
  expect_broken("V-SHDR-001", "not valid SPIR-V", [&] { reflect(cut); });
  const auto combined = spirv_of(ShaderStage::Fragment, R"(#version 450
layout(set = 1, binding = 2) uniform sampler2D picture;
layout(location = 0) out vec4 color;
void main() { color = texture(picture, vec2(0)); }
)");
  expect_broken("V-SHDR-003", "'picture' (group 1, binding 2) is a combined image sampler", [&] { reflect(combined); });
}

} // namespace
} // namespace mote::gpu
