// SPDX-License-Identifier: MIT
// Rules for pipelines, on real SPIR-V but without a device.
#include "tests/gpu/rules.hpp"

namespace mote::gpu {
namespace {

const std::string vertex_text = R"(#version 450
layout(set = 0, binding = 0) uniform Frame { mat4 m; };
layout(location = 0) in vec3 position;
layout(location = 0) out vec2 uv;
layout(location = 1) flat out uint id;
void main() { gl_Position = m * vec4(position, 1); uv = position.xy; id = 7u; }
)";
const std::string fragment_text = R"(#version 450
layout(constant_id = 4) const float gain = 1.0;
layout(push_constant) uniform Push { vec4 tint; };
layout(location = 0) in vec2 uv;
layout(location = 1) flat in uint id;
layout(location = 0) out vec4 color;
void main() { color = tint * gain * float(id) + uv.xyxy; }
)";

// A pipeline whose parts can be replaced before check().
struct Case {
  DeviceFacts device = made_up_device();
  std::vector<BindGroupLayoutEntry> entries{{.binding = 0, .visibility = ShaderStage::Vertex, .type = BindingType::UniformBuffer}};
  LayoutFacts layout{"layout", {}, 16};
  Reflection vertex = reflect(spirv_of(ShaderStage::Vertex, vertex_text));
  Reflection fragment = reflect(spirv_of(ShaderStage::Fragment, fragment_text));
  std::optional<Reflection> geometry{};
  std::vector<VertexAttribute> attributes{{VertexFormat::Float32x3, 0, 0}};
  std::vector<ColorTargetState> targets{{.format = TextureFormat::RGBA16Float}};
  std::vector<SpecializationConstant> constants{};
  std::string entry_point{"main"};
  RenderPipelineDescriptor d{.label = "opaque"};

  void check() {
    layout.groups = {entries};
    const VertexBufferLayout buffers[] = {{12, VertexStepMode::Vertex, attributes}};
    d.vertex_buffers = buffers;
    d.targets = targets;
    const auto stage = [&](ShaderStage s, std::string_view field, const Reflection& r, const ProgrammableStage& p) {
      return check_stage(device, layout, s, field, field, r, p);
    };
    const StageFacts v = stage(ShaderStage::Vertex, "vertex", vertex, {.entry_point = entry_point});
    std::optional<StageFacts> g;
    if (geometry) g = stage(ShaderStage::Geometry, "geometry", *geometry, {});
    const StageFacts f = stage(ShaderStage::Fragment, "fragment", fragment, {.constants = constants});
    check_render_pipeline(device, d, v, g, f);
  }
  void broken(std::string_view code, std::string_view words) {
    expect_broken(code, words, [&] { check(); });
  }
};

TEST(PipelineRules, good) {
  expect_kept([] { Case().check(); });
}
TEST(PipelineRules, stages_and_layout) {
  {
    Case c;
    c.entry_point = "mian";
    c.broken("V-PIPE-001", "[ShaderModule \"vertex\"] has no entry point 'mian' of the Vertex stage; it has: 'main' (Vertex)");
  }
  {
    Case c;
    c.entries.clear();
    c.broken("V-PIPE-002", "(group 0, binding 0) of [ShaderModule \"vertex\"] is not in [PipelineLayout \"layout\"]");
  }
  {
    Case c;
    c.constants = {spec(5, 1.0f)};
    c.broken("V-PIPE-003", "constant 5 is set; [ShaderModule \"fragment\"] has: 4");
  }
  {
    Case c;
    c.entries[0].visibility = ShaderStage::Fragment;
    c.broken("V-PIPE-004", "read by the Vertex stage; the layout makes it visible to Fragment");
  }
  {
    Case c;
    c.entries[0].type = BindingType::StorageBuffer;
    c.broken("V-PIPE-005", "is UniformBuffer in the shader and StorageBuffer in the layout");
  }
  {
    Case c;
    c.entries[0].min_binding_size = 48;
    c.broken("V-PIPE-006", "is 64 bytes in the shader; the layout's min_binding_size is 48");
  }
  {
    Case c;
    c.layout.push_constant_size = 8;
    c.broken("V-PIPE-008", "16 bytes of push constants; [PipelineLayout \"layout\"] has 8");
  }
}
TEST(PipelineRules, texture_bindings) {
  Case c;
  c.fragment = reflect(spirv_of(ShaderStage::Fragment, R"(#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(set = 0, binding = 1) uniform utexture2D ids;
layout(location = 0) out vec4 color;
void main() { color = vec4(texelFetch(ids, ivec2(0), 0)); }
)"));
  c.entries.push_back({.binding = 1, .visibility = ShaderStage::Fragment, .type = BindingType::SampledTexture, .sample_type = SampleType::Uint});
  expect_kept([&] { c.check(); });
  c.entries[1].sample_type = SampleType::Float;
  c.broken("V-PIPE-007", "is sampled as Uint in the shader and as Float in the layout");
  c.entries[1].sample_type = SampleType::Uint;
  c.entries[1].view_dimension = TextureViewDimension::D3;
  c.broken("V-PIPE-007", "has dimension 2d in the shader and 3d in the layout");
}
TEST(PipelineRules, links) {
  Case c;
  c.vertex = reflect(spirv_of(ShaderStage::Vertex, R"(#version 450
layout(location = 0) in vec3 position;
layout(location = 0) out vec2 uv;
void main() { gl_Position = vec4(position, 1); uv = position.xy; }
)"));
  c.broken("V-PIPE-010", "reads 'id' at location 1, which the vertex stage of [ShaderModule \"vertex\"] does not write");
}
TEST(PipelineRules, vertex_buffers) {
  {
    Case c;
    c.attributes[0].location = 3;
    c.broken("V-PIPE-012", "reads 'position' at location 0");
  }
  {
    Case c;
    c.attributes[0].format = VertexFormat::Uint32x3;
    c.broken("V-PIPE-012", "uint32x3");
  }
  {
    Case c;
    c.attributes[0].offset = 4;
    c.broken("V-PIPE-011", "ends at byte 16; the stride of vertex buffer 0 is 12");
  }
}
TEST(PipelineRules, geometry) {
  Case c;
  c.device.features = Feature::GeometryShader;
  c.d.topology = Topology::PointList;
  c.geometry = reflect(spirv_of(ShaderStage::Geometry, R"(#version 450
layout(points) in;
layout(triangle_strip, max_vertices = 40) out;
layout(location = 0) out vec2 uv;
layout(location = 1) flat out uint id;
void main() { uv = vec2(0); id = 0u; gl_Position = gl_in[0].gl_Position; EmitVertex(); }
)"));
  c.broken("V-PIPE-014", "may write 40 vertices; [Device \"made up\"] allows 32");
  c.device.limits.max_geometry_output_vertices = 64;
  expect_kept([&] { c.check(); });
  c.device.limits.max_geometry_total_output_components = 279;
  c.broken("V-PIPE-014", "40 vertices of 7 components; [Device \"made up\"] allows 279");
  c.device.limits.max_geometry_total_output_components = 280;
  c.d.topology = Topology::TriangleList;
  c.broken("V-PIPE-013", "The topology is triangle_list; the geometry stage of [ShaderModule \"geometry\"] takes point_list");
  c.device.features = Feature::None;
  c.broken("V-FEAT-001", "Feature GeometryShader is not enabled");
}
TEST(PipelineRules, targets_and_depth) {
  {
    Case c;
    c.targets.assign(5, {.format = TextureFormat::RGBA8Unorm, .write_mask = ColorWrite::None});
    c.broken("V-PIPE-015", "5 color targets; [Device \"made up\"] allows 4");
  }
  {
    Case c;
    c.targets[0].format = TextureFormat::Depth32Float;
    c.broken("V-PIPE-016", "targets[0] has format depth32float");
  }
  {
    Case c;
    c.targets[0] = {.format = TextureFormat::R32Uint, .blend = BlendState{}};
    c.broken("V-PIPE-017", "r32uint");
    c.targets[0].blend.reset();
    c.broken("V-PIPE-018", "targets[0] has format r32uint; the fragment stage writes 'color' as another kind of number");
  }
  {
    Case c;
    c.targets.push_back({.format = TextureFormat::R32Uint});
    c.broken("V-PIPE-018", "no output at location 1");
    c.targets[1].write_mask = ColorWrite::None;
    expect_kept([&] { c.check(); });
  }
  {
    Case c;
    c.d.sample_count = 3;
    c.broken("V-PIPE-020", "is 3");
    c.d.sample_count = 1;
    c.d.topology = Topology::Undefined;
    c.broken("V-PIPE-009", "[RenderPipelineDescriptor \"opaque\"]");
    c.d.topology = Topology::LineList;
    c.targets.clear();
    c.broken("V-PIPE-021", "neither a color target nor depth");
    c.d.depth = DepthState{.format = TextureFormat::R32Float};
    c.broken("V-PIPE-022", "r32float");
    c.d.depth = DepthState{.compare = CompareFunction::Undefined};
    c.broken("V-PIPE-022", "Undefined");
    c.d.depth = DepthState{};
    c.d.depth_clamp = true;
    c.broken("V-FEAT-001", "depth_clamp is set but Feature DepthClamp");
  }
}
TEST(PipelineRules, compute) {
  const DeviceFacts device = made_up_device();
  const Reflection r = reflect(spirv_of(ShaderStage::Compute, "#version 450\nlayout(local_size_x = 64, local_size_y = 16) in;\nvoid main() {}\n"));
  const StageFacts stage = check_stage(device, {"l", {}, 0}, ShaderStage::Compute, "compute", "sort", r, {});
  expect_broken("V-PIPE-019", "[ShaderModule \"sort\"] is 64x16x1; [Device \"made up\"] allows 256x128x64 and 512 in all", [&] { check_compute(device, stage); });
}
TEST(PipelineRules, shader_features) {
  const Reflection r = reflect(spirv_of(ShaderStage::Compute, R"(#version 450
#extension GL_EXT_shader_explicit_arithmetic_types_float64 : require
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer B { double d; };
void main() { d = d * 2.0lf; }
)"));
  DeviceFacts device = made_up_device();
  expect_broken("V-FEAT-001", "ShaderFloat64", [&] { check_shader_features(device, r); });
  device.features = Feature::ShaderFloat64;
  expect_kept([&] { check_shader_features(device, r); });
}

} // namespace
} // namespace mote::gpu
