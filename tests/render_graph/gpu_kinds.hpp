// SPDX-License-Identifier: MIT
// Pass kinds for tests on a device: one clears, one adds to what it reads, one draws over, and a compute
// kind that runs one statement a record.
#pragma once

#include "gpu_fixture.hpp"

#include <fmt/format.h>

namespace mote::rg::test {

using gpu::TextureFormat;

inline const gpu::BindGroupLayoutEntry texture_entry{.binding = 0, .visibility = gpu::ShaderStage::Fragment, .type = gpu::BindingType::SampledTexture, .sample_type = gpu::SampleType::UnfilterableFloat};

inline Slot color_out(std::string name = "color", TextureFormat format = TextureFormat::R32Float) { return {.name = std::move(name), .access = Access::ColorWrite, .makes = texture(format)}; }

// fill: the clear color. add: source + 1 everywhere. paint: draws 100 over the left column.
inline Functions fill() {
  return {.declare = [](auto& slots, Params&) { slots.push_back(color_out()); }, .clear = [](auto, auto&) { return gpu::Color{5, 0, 0, 0}; }};
}
inline Functions add_one() {
  auto draw = std::make_shared<FullScreen>();
  Functions f;
  f.declare = [](auto& slots, Params&) {
    slots.push_back({.name = "source", .access = Access::Sampled});
    Slot out = color_out();
    out.makes = texture(TextureFormat::Undefined, {.kind = SizeSpec::Kind::Like, .like = "source"});
    out.covers = true;
    slots.push_back(out);
  };
  f.prepare = [draw](PassContext& c) {
    *draw = FullScreen(c.device(), "layout(set=0, binding=0) uniform texture2D source; layout(location=0) out float color;\nvoid main() { color = texelFetch(source, ivec2(gl_FragCoord.xy), 0).r + 1.0; }",
                       {.format = c.format("color")}, {texture_entry});
  };
  f.record = [draw](PassContext& c) {
    const gpu::TextureView source = c.texture("source");
    draw->draw(c, {{.binding = 0, .texture = &source}});
  };
  return f;
}
inline Functions paint() {
  auto draw = std::make_shared<FullScreen>();
  Functions f;
  f.declare = [](auto& slots, Params&) { slots.push_back({.name = "color", .access = Access::ColorReadWrite}); };
  f.prepare = [draw](PassContext& c) { *draw = FullScreen(c.device(), "layout(location=0) out float color;\nvoid main() { color = 100.0; }", {.format = c.format("color")}); };
  f.record = [draw](PassContext& c) {
    c.render_pass().set_scissor(0, 0, 1, c.view_size().height);
    draw->draw(c);
  };
  f.idle = [](const FrameInput& frame) { return frame.find<int>() ? std::string("told so") : std::string(); };
  return f;
}
inline Registry basics() {
  Registry r;
  add(r, "fill", fill());
  add(r, "add", add_one());
  add(r, "paint", paint());
  return r;
}
inline std::string pass(const std::string& name, const std::string& kind, const std::string& inputs = "") {
  return fmt::format("[[pass]]\nname = '{}'\nkind = '{}'\ninputs = {{ {} }}\n", name, kind, inputs);
}

// ---- buffers and compute -----------------------------------------------------------------------
struct Compute {
  gpu::BindGroupLayout group_layout{};
  gpu::PipelineLayout layout{};
  gpu::ComputePipeline pipeline{};
  void make(gpu::Device device, const std::string& statement) {
    const gpu::BindGroupLayoutEntry entry{.binding = 0, .visibility = gpu::ShaderStage::Compute, .type = gpu::BindingType::StorageBuffer};
    group_layout = device.create_bind_group_layout({.label = "test", .entries = std::span(&entry, 1)});
    const gpu::BindGroupLayout* groups[] = {&group_layout};
    layout = device.create_pipeline_layout({.label = "test", .bind_group_layouts = groups});
    const gpu::ShaderModule module = shader(device, gpu::ShaderStage::Compute, "layout(local_size_x=1) in; layout(set=0, binding=0) buffer B { uint data[]; };\nvoid main() { uint i = gl_GlobalInvocationID.x; " + statement + " }");
    pipeline = device.create_compute_pipeline({.label = "test", .layout = &layout, .compute = {.module = &module}});
  }
  void run(PassContext& context, const gpu::Buffer& buffer, std::uint32_t count) const {
    const gpu::BindGroupEntry entry{.binding = 0, .buffer = {.buffer = &buffer}};
    const gpu::BindGroup group = context.device().create_bind_group({.label = "test", .layout = &group_layout, .entries = std::span(&entry, 1)});
    gpu::ComputePass compute = context.encoder().begin_compute_pass({.label = "test"});
    compute.set_pipeline(pipeline);
    compute.set_bind_group(0, group);
    compute.dispatch(count);
    compute.end();
  }
};

inline Functions compute_kind(Slot slot, const std::string& statement, std::uint32_t count) {
  auto compute = std::make_shared<Compute>();
  const std::string name = slot.name;
  return {.declare = [slot](auto& slots, Params&) { slots.push_back(slot); },
          .prepare = [compute, statement](PassContext& c) { compute->make(c.device(), statement); },
          .record = [compute, name, count](PassContext& c) { compute->run(c, c.buffer(name), count); }};
}

} // namespace mote::rg::test
