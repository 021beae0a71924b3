// SPDX-License-Identifier: MIT
// A device for the executor's tests, passes made of functions, and the few shaders they need. Fresh
// memory holds loud values, so that what was never written shows.
#pragma once

#include "core/gpu/shader_compiler.hpp"
#include "render_graph/compile.hpp"
#include "render_graph/executor.hpp"

#include <gmock/gmock.h>

#include <cstring>
#include <functional>

namespace mote::rg::test {

struct Functions {
  std::function<void(std::vector<Slot>&, Params&)> declare{};
  std::function<void(PassContext&)> prepare{}, update{}, record{};
  std::function<gpu::Color(std::string_view, const FrameInput&)> clear{};
  std::function<std::string(const FrameInput&)> idle{};
  bool opens{};
};

class FunctionPass : public Pass {
public:
  explicit FunctionPass(Functions f) : f_(std::move(f)) {}
  void declare(std::vector<Slot>& slots, Params& params) override { f_.declare(slots, params); }
  void prepare(PassContext& context) override { if (f_.prepare) f_.prepare(context); }
  void update(PassContext& context) override { if (f_.update) f_.update(context); }
  void record(PassContext& context) override { if (f_.record) f_.record(context); }
  gpu::Color clear_value(std::string_view slot, const FrameInput& frame) override { return f_.clear ? f_.clear(slot, frame) : Pass::clear_value(slot, frame); }
  [[nodiscard]] std::string idle_reason(const FrameInput& frame) const override { return f_.idle ? f_.idle(frame) : std::string{}; }
  [[nodiscard]] bool opens_attachments() const override { return f_.opens; }

private:
  Functions f_;
};

inline void add(Registry& registry, const std::string& name, const Functions& functions) {
  registry.add({name, "", [functions]() -> std::unique_ptr<Pass> { return std::make_unique<FunctionPass>(functions); }});
}

inline TextureSpec texture(gpu::TextureFormat format, SizeSpec size = {}) { return {.format = format, .size = std::move(size)}; }

class GpuTest : public testing::Test {
protected:
  void SetUp() override {
    gpu::Error error;
    instance_ = gpu::Instance::create({}, error);
    const gpu::Adapter adapter = instance_ ? instance_.request_adapter({}, error) : gpu::Adapter{};
    if (!adapter) GTEST_SKIP() << "NO VULKAN DEVICE: " << to_string(error);
    device_ = adapter.request_device({.required_features = adapter.features() & gpu::Feature::TimestampQuery, .memory_budget = memory_budget_, .fill_new_memory = true}, error);
    ASSERT_TRUE(static_cast<bool>(device_)) << to_string(error);
    device_.on_uncaptured_error([](const gpu::Error& e) { ADD_FAILURE() << to_string(e); });
  }
  void TearDown() override {
    if (device_) device_.queue().wait_idle();
    if (instance_) {
      EXPECT_THAT(instance_.validation_messages(), testing::IsEmpty());
    }
  }

  std::unique_ptr<Executor> make(const Registry& registry, const std::string& toml, const CompileOptions& options = {}) {
    Diagnostics found;
    const GraphDesc desc = parse_graph("schema = 1\n" + toml, "g.toml", found);
    CompileResult result = compile(desc, registry, options, found);
    if (!result.plan) throw std::runtime_error(check_text(result));
    return std::make_unique<Executor>(device_, *result.plan, result.passes);
  }
  template <class T> std::vector<T> read(const gpu::Texture& texture) {
    const std::vector<std::byte> bytes = device_.read_texture(texture);
    std::vector<T> out(bytes.size() / sizeof(T));
    std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
    return out;
  }
  template <class T> std::vector<T> read(const gpu::Buffer& buffer) {
    const std::vector<std::byte> bytes = device_.read_buffer(buffer);
    std::vector<T> out(bytes.size() / sizeof(T));
    std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
    return out;
  }

  std::uint64_t memory_budget_{};
  gpu::Instance instance_{};
  gpu::Device device_{};
};

inline gpu::ShaderModule shader(gpu::Device device, gpu::ShaderStage stage, const std::string& body) {
  const auto compiled = gpu::compile_glsl(stage, {"test.glsl", "#version 450\n#extension GL_EXT_samplerless_texture_functions : require\n" + body});
  for (const auto& message : compiled.messages) ADD_FAILURE() << to_string(message);
  return device.create_shader_module({.label = "test", .spirv = compiled.spirv});
}

// A triangle over the whole target; `fragment` is its shader, `entries` the bindings of its one group.
struct FullScreen {
  gpu::BindGroupLayout group_layout{};
  gpu::PipelineLayout layout{};
  gpu::RenderPipeline pipeline{};

  FullScreen() = default;
  FullScreen(gpu::Device device, const std::string& fragment, gpu::ColorTargetState target, std::vector<gpu::BindGroupLayoutEntry> entries = {}, std::optional<gpu::DepthState> depth = {}) {
    group_layout = device.create_bind_group_layout({.label = "test", .entries = entries});
    const gpu::BindGroupLayout* groups[] = {&group_layout};
    layout = device.create_pipeline_layout({.label = "test", .bind_group_layouts = groups});
    const gpu::ShaderModule vert = shader(device, gpu::ShaderStage::Vertex,
                                          "void main() { gl_Position = vec4(vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4.0 - 1.0, 0.5, 1.0); }");
    const gpu::ShaderModule frag = shader(device, gpu::ShaderStage::Fragment, fragment);
    const gpu::ColorTargetState targets[] = {target};
    pipeline = device.create_render_pipeline({.label = "test", .layout = &layout, .vertex = {.module = &vert}, .fragment = gpu::ProgrammableStage{.module = &frag},
                                              .depth = depth, .targets = std::span(targets, target.format == gpu::TextureFormat::Undefined ? 0u : 1u)});
  }
  void draw(PassContext& context, std::vector<gpu::BindGroupEntry> entries = {}) const {
    const gpu::BindGroup group = context.device().create_bind_group({.label = "test", .layout = &group_layout, .entries = entries});
    context.render_pass().set_pipeline(pipeline);
    context.render_pass().set_bind_group(0, group);
    context.render_pass().draw(3);
  }
};

} // namespace mote::rg::test
