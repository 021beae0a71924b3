// SPDX-License-Identifier: MIT
// Draws: triangle, geometry stage, indexed and indirect draws, vertex buffers, push and
// specialization constants, depth.
#include "tests/gpu/fixture.hpp"

#include <array>

namespace mote::gpu {
namespace {

using testing::Each;
using testing::ElementsAre;

constexpr std::uint32_t side = 8;

class DrawTest : public DeviceTest {
protected:
  struct Setup {
    std::span<const BindGroupLayout* const> groups{};
    std::uint32_t push{};
    std::span<const VertexBufferLayout> buffers{};
    Topology topology{Topology::TriangleList};
    std::optional<DepthState> depth{};
    std::span<const SpecializationConstant> constants{};
    TextureFormat format{TextureFormat::RGBA8Unorm};
    const ShaderModule* geometry{};
    std::optional<BlendState> blend{};
  };
  RenderPipeline pipeline(const ShaderModule& vertex, const ShaderModule& fragment, const Setup& s) {
    const PipelineLayout layout = device.create_pipeline_layout({.label = "draw", .bind_group_layouts = s.groups, .push_constant_size = s.push});
    const ColorTargetState targets[] = {{.format = s.format, .blend = s.blend}};
    RenderPipelineDescriptor d{.label = "draw", .layout = &layout, .vertex = {.module = &vertex}};
    d.fragment = ProgrammableStage{.module = &fragment, .constants = s.constants};
    if (s.geometry != nullptr) d.geometry = ProgrammableStage{.module = s.geometry};
    d.vertex_buffers = s.buffers;
    d.topology = s.topology;
    d.depth = s.depth;
    d.targets = targets;
    return device.create_render_pipeline(d);
  }
  template <class Body> std::vector<std::uint32_t> render(Body&& body) {
    const Texture picture = target(TextureFormat::RGBA8Unorm, side, side);
    const TextureView view = picture.create_view();
    const ColorAttachment colors[] = {{.view = &view, .clear = {0, 0, 0, 1}}};
    CommandEncoder encoder = device.create_command_encoder("draw");
    RenderPass pass = encoder.begin_render_pass({.label = "draw", .colors = colors});
    body(pass);
    pass.end();
    submit_and_wait(encoder);
    return values_of<std::uint32_t>(device.read_texture(picture));
  }
};

const std::string solid_fragment = R"(#version 450
layout(location = 0) out vec4 color;
layout(constant_id = 3) const float green = 0.0;
void main() { color = vec4(1.0, green, 0.0, 1.0); }
)";

constexpr std::uint32_t black = 0xFF000000u, red = 0xFF0000FFu, yellow = 0xFF00FFFFu;

TEST_F(DrawTest, triangle_covers_lower_left_half) {
  // Clip-space y points down: (-1,-1) is the top left corner, row 0 the top row.
  const ShaderModule vertex = shader(ShaderStage::Vertex, R"(#version 450
void main() {
  vec2 p[3] = vec2[](vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
  gl_Position = vec4(p[gl_VertexIndex], 0, 1);
}
)");
  const ShaderModule fragment = shader(ShaderStage::Fragment, solid_fragment);
  const RenderPipeline p = pipeline(vertex, fragment, {});
  ASSERT_TRUE(p);
  const auto pixels = render([&](RenderPass& pass) {
    pass.set_pipeline(p);
    pass.draw(3);
  });
  ASSERT_EQ(pixels.size(), side * side);
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      if (x == y) continue; // the edge itself runs through the pixel's center
      EXPECT_EQ(pixels[y * side + x], x < y ? red : black) << x << "," << y;
    }
  }
}

TEST_F(DrawTest, geometry_stage_turns_a_point_into_a_quad) {
  const ShaderModule vertex = shader(ShaderStage::Vertex, "#version 450\nvoid main() { gl_Position = vec4(0, 0, 0, 1); gl_PointSize = 1; }\n");
  const ShaderModule geometry = shader(ShaderStage::Geometry, R"(#version 450
layout(points) in;
layout(triangle_strip, max_vertices = 4) out;
void main() {
  for (int i = 0; i < 4; ++i) {
    gl_Position = gl_in[0].gl_Position + vec4((i & 1) - 0.5, (i >> 1) - 0.5, 0, 0);
    EmitVertex();
  }
}
)");
  const ShaderModule fragment = shader(ShaderStage::Fragment, solid_fragment);
  const RenderPipeline p = pipeline(vertex, fragment, {.topology = Topology::PointList, .geometry = &geometry});
  ASSERT_TRUE(p);
  const auto pixels = render([&](RenderPass& pass) {
    pass.set_pipeline(p);
    pass.draw(1);
  });
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const bool inside = x >= 2 && x < 6 && y >= 2 && y < 6;
      EXPECT_EQ(pixels[y * side + x], inside ? red : black) << x << "," << y;
    }
  }
}

TEST_F(DrawTest, specialization_constant_changes_the_color) {
  const ShaderModule vertex = shader(ShaderStage::Vertex, fullscreen_vertex);
  const ShaderModule fragment = shader(ShaderStage::Fragment, solid_fragment);
  const SpecializationConstant constants[] = {spec(3, 1.0f)};
  const RenderPipeline p = pipeline(vertex, fragment, {.constants = constants});
  const auto pixels = render([&](RenderPass& pass) {
    pass.set_pipeline(p);
    pass.draw(3);
  });
  EXPECT_THAT(pixels, Each(yellow));
}

TEST_F(DrawTest, push_constants_reach_the_fragment_stage_and_change_between_draws) {
  const ShaderModule vertex = shader(ShaderStage::Vertex, fullscreen_vertex);
  const ShaderModule fragment = shader(ShaderStage::Fragment, R"(#version 450
layout(push_constant) uniform Push { vec4 color; } push;
layout(location = 0) out vec4 color;
void main() { color = push.color; }
)");
  const RenderPipeline p = pipeline(vertex, fragment, {.push = 16});
  const std::array<float, 4> first{1, 0, 0, 1}, second{1, 1, 0, 1};
  const auto pixels = render([&](RenderPass& pass) {
    pass.set_pipeline(p);
    pass.set_push_constants(0, std::as_bytes(std::span(first)));
    pass.draw(3);
    pass.set_push_constants(4, bytes_of_value(second[1])); // green only; the rest stays
    pass.set_scissor(0, 0, side / 2, side);
    pass.draw(3);
  });
  for (std::uint32_t i = 0; i < pixels.size(); ++i) EXPECT_EQ(pixels[i], i % side < side / 2 ? yellow : red) << i;
}

// A strip of four quads, one per instance; instance i covers columns 2i and 2i + 1.
class StripTest : public DrawTest {
protected:
  void SetUp() override {
    DrawTest::SetUp();
    const std::vector<float> corner{0, -1, 0.5f, -1, 0, 1, 0.5f, 1};
    const std::vector<float> shift{-1, -0.5f, 0, 0.5f};
    const std::vector<std::uint16_t> index{0, 1, 2, 2, 1, 3};
    corners = device.create_buffer({.label = "corners", .size = 32, .usage = BufferUsage::Vertex, .contents = bytes_of(corner)});
    shifts = device.create_buffer({.label = "shifts", .size = 16, .usage = BufferUsage::Vertex, .contents = bytes_of(shift)});
    indices = device.create_buffer({.label = "indices", .size = 12, .usage = BufferUsage::Index, .contents = bytes_of(index)});
    vertex = shader(ShaderStage::Vertex, R"(#version 450
layout(location = 0) in vec2 corner;
layout(location = 1) in float shift;
void main() { gl_Position = vec4(corner.x + shift, corner.y, 0, 1); }
)");
    fragment = shader(ShaderStage::Fragment, solid_fragment);
    const VertexAttribute corner_attribute[] = {{VertexFormat::Float32x2, 0, 0}};
    const VertexAttribute shift_attribute[] = {{VertexFormat::Float32, 0, 1}};
    const VertexBufferLayout buffers[] = {{8, VertexStepMode::Vertex, corner_attribute}, {4, VertexStepMode::Instance, shift_attribute}};
    p = pipeline(vertex, fragment, {.buffers = buffers});
    ASSERT_TRUE(p);
  }
  void set(RenderPass& pass) {
    pass.set_pipeline(p);
    pass.set_vertex_buffer(0, corners);
    pass.set_vertex_buffer(1, shifts);
    pass.set_index_buffer(indices, IndexFormat::Uint16);
  }
  static std::vector<std::uint32_t> columns(std::uint32_t first, std::uint32_t end) {
    std::vector<std::uint32_t> pixels(side * side, black);
    for (std::uint32_t i = 0; i < pixels.size(); ++i) {
      if (i % side >= first && i % side < end) pixels[i] = red;
    }
    return pixels;
  }
  Buffer corners, shifts, indices;
  ShaderModule vertex, fragment;
  RenderPipeline p;
};

TEST_F(StripTest, indexed_and_instanced) {
  const auto pixels = render([&](RenderPass& pass) {
    set(pass);
    pass.draw_indexed(6, 2, 0, 0, 1);
  });
  EXPECT_EQ(pixels, columns(2, 6));
}

TEST_F(StripTest, indirect_draws_read_their_arguments_from_the_device) {
  const std::vector<std::uint32_t> arguments{6, 1, 0, 0, 3 /* indexed */, 3, 1, 0, 0 /* plain: half a quad */};
  const Buffer indirect = device.create_buffer(
      {.label = "arguments", .size = 36, .usage = BufferUsage::Indirect, .contents = bytes_of(arguments)});
  const auto pixels = render([&](RenderPass& pass) {
    set(pass);
    pass.draw_indexed_indirect(indirect, 0);
  });
  EXPECT_EQ(pixels, columns(6, 8));
  const auto half = render([&](RenderPass& pass) {
    set(pass);
    pass.draw_indirect(indirect, 20);
  });
  EXPECT_EQ(half[0], red);
  EXPECT_EQ(half[(side - 1) * side + 1], black);
}

TEST_F(DrawTest, reverse_z_keeps_the_nearest) {
  const ShaderModule vertex = shader(ShaderStage::Vertex, R"(#version 450
layout(push_constant) uniform Push { vec4 color; float depth; } push;
void main() {
  vec2 p = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  gl_Position = vec4(p, push.depth, 1.0);
}
)");
  const ShaderModule fragment = shader(ShaderStage::Fragment, R"(#version 450
layout(push_constant) uniform Push { vec4 color; float depth; } push;
layout(location = 0) out vec4 color;
void main() { color = push.color; }
)");
  const RenderPipeline p = pipeline(vertex, fragment, {.push = 20, .depth = DepthState{}});
  const Texture color = target(TextureFormat::RGBA8Unorm, side, side), depth = target(TextureFormat::Depth32Float, side, side);
  const TextureView color_view = color.create_view(), depth_view = depth.create_view();
  const ColorAttachment colors[] = {{.view = &color_view}};
  CommandEncoder encoder = device.create_command_encoder();
  RenderPass pass = encoder.begin_render_pass({.colors = colors, .depth = DepthAttachment{.view = &depth_view}});
  pass.set_pipeline(p);
  const auto layer = [&](float r, float g, float z) {
    const std::array<float, 5> push{r, g, 0, 1, z};
    pass.set_push_constants(0, std::as_bytes(std::span(push)));
    pass.draw(3);
  };
  layer(1, 0, 0.75f); // near
  layer(1, 1, 0.25f); // far: hidden
  pass.end();
  submit_and_wait(encoder);
  EXPECT_THAT(values_of<std::uint32_t>(device.read_texture(color)), Each(red));
  EXPECT_THAT(values_of<float>(device.read_texture(depth)), Each(0.75f));
}

} // namespace
} // namespace mote::gpu
