// SPDX-License-Identifier: MIT
#include "passes/file_pass/file_pass.hpp"

#include "core/gpu/format.hpp"
#include "passes/file_pass/pass_file.hpp"
#include "passes/file_pass/shader_source.hpp"
#include "passes/frame.hpp"
#include "shaders/embedded.hpp"

#include <fmt/format.h>

namespace mote::passes {
namespace {

gpu::SampleType sample_type(gpu::TextureFormat format) {
  switch (gpu::format_info(format).kind) {
  case gpu::FormatKind::Depth: return gpu::SampleType::Depth;
  case gpu::FormatKind::Uint: return gpu::SampleType::Uint;
  case gpu::FormatKind::Sint: return gpu::SampleType::Sint;
  default: return gpu::SampleType::UnfilterableFloat;
  }
}
char kind_letter(gpu::TextureFormat format) {
  const gpu::FormatKind kind = gpu::format_info(format).kind;
  return kind == gpu::FormatKind::Uint ? 'u' : kind == gpu::FormatKind::Sint ? 'i' : 't';
}
gpu::TextureViewDimension dimension_of(const std::string& type) {
  if (type.ends_with("array")) return gpu::TextureViewDimension::D2Array;
  return type.ends_with("3d") ? gpu::TextureViewDimension::D3 : gpu::TextureViewDimension::D2;
}

class FilePass final : public rg::Pass {
public:
  explicit FilePass(bool compute) : compute_(compute) {}

  void declare(std::vector<rg::Slot>& slots, rg::Params& params) override {
    const std::string word = params.string("shader", "", "GLSL file with a pass.toml beside it, or the name of a shipped pass");
    loc_ = params.loc("shader");
    name_ = params.pass();
    if (word.empty()) return params.require("shader");
    source_ = ShaderSource::locate(word, params.path("shader", ""));
    const auto description = source_.description();
    for (const auto& [there, path] : {std::pair(source_.exists(), source_.path()), std::pair(description.has_value(), source_.description_path())})
      if (!there)
        params.error("P010", "shader", fmt::format("is \"{}\", but '{}' cannot be read.", word, path),
                     {"shipped passes: " + list_of(ShaderSource::shipped()) + ".", did_you_mean(word, ShaderSource::shipped())});
    if (!description || !source_.exists()) return;
    Diagnostics problems;
    file_ = parse_pass_file(*description, source_.description_path(), problems);
    for (const FileInput& input : file_.inputs)
      slots.push_back({.name = input.name, .access = rg::Access::Sampled, .summary = input.summary});
    for (const FileOutput& output : file_.outputs) {
      if (compute_ && std::any_of(file_.inputs.begin(), file_.inputs.end(), [&](const FileInput& i) { return i.name == output.name; }))
        problems.error("P011", {file_.file}, fmt::format("the output '{}' of a compute pass has the name of an input.", output.name));
      slots.push_back({.name = output.name, .access = compute_ ? rg::Access::StorageWrite : rg::Access::ColorWrite, .summary = output.summary,
                       .makes = rg::TextureSpec{.format = output.format, .size = {.factor = output.size}}});
    }
    values_ = read_values(file_, params);
    if (!problems.has_errors()) {
      shader_ = source_.compile(file_, compute_);
      for (const Diagnostic& d : shader_.problems.list()) problems.add(d);
    }
    for (const Diagnostic& d : problems.list()) params.error_at(d.code, d.loc, d.text, d.hints);
  }

  void prepare(rg::PassContext& context) override {
    std::vector<gpu::BindGroupLayoutEntry> entries;
    const gpu::ShaderStage stage = compute_ ? gpu::ShaderStage::Compute : gpu::ShaderStage::Fragment;
    for (const FileInput& input : file_.inputs) {
      const gpu::TextureFormat format = context.texture(input.name).format();
      const char wanted = input.type[0] == 'u' || input.type[0] == 'i' ? input.type[0] : 't';
      if (kind_letter(format) != wanted)
        fail(Exit::BadInput, "P014", loc_, fmt::format("pass '{}' input '{}' is a {}, but {} declares a {}.", name_, input.name, gpu::to_string(format), file_.file, input.type));
      entries.push_back({.binding = static_cast<std::uint32_t>(entries.size()), .visibility = stage, .type = gpu::BindingType::SampledTexture,
                         .sample_type = sample_type(format), .view_dimension = dimension_of(input.type)});
    }
    targets_.clear();
    for (const FileOutput& output : file_.outputs) {
      const gpu::TextureFormat format = context.format(output.name);
      targets_.push_back({.format = format});
      if (compute_ && format != output.format)
        fail(Exit::BadInput, "P014", loc_, fmt::format("pass '{}' output '{}' is made as {}, but {} declares {}.", name_, output.name, gpu::to_string(format), file_.file, gpu::to_string(output.format)));
      if (compute_)
        entries.push_back({.binding = static_cast<std::uint32_t>(entries.size()), .visibility = stage, .type = gpu::BindingType::StorageTexture, .storage_format = format});
    }
    entries.push_back({.binding = static_cast<std::uint32_t>(entries.size()), .visibility = stage, .type = gpu::BindingType::UniformBuffer});
    gpu::Device device = context.device();
    layout_ = device.create_bind_group_layout({.label = name_, .entries = entries});
    const std::array<const gpu::BindGroupLayout*, 1> layouts{&layout_};
    pipeline_layout_ = device.create_pipeline_layout({.label = name_, .bind_group_layouts = layouts});
    uniform_ = device.create_buffer({.label = name_, .size = (values_.size() + 1) * 16, .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
    make_pipeline(device);
  }

  void update(rg::PassContext& context) override {
    reload(context);
    const auto [width, height] = context.view_size();
    context.device().queue().write_buffer(uniform_, 0, uniform_bytes(file_, values_, static_cast<float>(width), static_cast<float>(height)));
    if (group_ && generation_ == context.generation()) return;
    generation_ = context.generation();
    make_group(context);
  }

  void record(rg::PassContext& context) override {
    if (!compute_) {
      gpu::RenderPass& pass = context.render_pass();
      pass.set_pipeline(draw_);
      pass.set_bind_group(0, group_);
      return pass.draw(3);
    }
    update(context);
    const gpu::Extent3d size = context.whole_texture(file_.outputs.front().name).size();
    gpu::ComputePass pass = context.encoder().begin_compute_pass({.label = name_});
    pass.set_pipeline(dispatch_);
    pass.set_bind_group(0, group_);
    const auto groups = [&](std::uint32_t texels, std::size_t axis) { return (texels + shader_.local_size[axis] - 1) / std::max(shader_.local_size[axis], 1u); };
    pass.dispatch(groups(size.width, 0), groups(size.height, 1));
    pass.end();
  }

private:
  // A changed file is compiled anew; a broken one is reported, once, and the pipeline stays.
  void reload(rg::PassContext& context) {
    if (!source_.changed()) return;
    CheckedShader next = source_.compile(file_, compute_);
    const auto* reports = context.frame().find<PassReports>();
    for (const Diagnostic& d : next.problems.list())
      if (reports && reports->report) reports->report(d);
    if (next.spirv.empty()) return;
    shader_ = std::move(next);
    gpu::Device device = context.device();
    make_pipeline(device);
  }

  void make_pipeline(gpu::Device& device) {
    const gpu::ShaderModule module = device.create_shader_module({.label = source_.path(), .spirv = shader_.spirv});
    if (compute_) {
      dispatch_ = device.create_compute_pipeline({.label = name_, .layout = &pipeline_layout_, .compute = {.module = &module}});
      return;
    }
    const gpu::ShaderModule vertex = device.create_shader_module({.label = "post/fullscreen.vert", .spirv = shaders::spirv("post/fullscreen.vert")});
    gpu::RenderPipelineDescriptor descriptor{.label = name_};
    descriptor.layout = &pipeline_layout_;
    descriptor.vertex = {.module = &vertex};
    descriptor.fragment = gpu::ProgrammableStage{.module = &module};
    descriptor.targets = targets_;
    draw_ = device.create_render_pipeline(descriptor);
  }

  void make_group(rg::PassContext& context) {
    std::vector<gpu::TextureView> views;
    for (const FileInput& input : file_.inputs) views.push_back(context.texture(input.name));
    if (compute_)
      for (const FileOutput& output : file_.outputs) views.push_back(context.texture(output.name));
    std::vector<gpu::BindGroupEntry> entries;
    for (const gpu::TextureView& view : views) entries.push_back({.binding = static_cast<std::uint32_t>(entries.size()), .texture = &view});
    entries.push_back({.binding = static_cast<std::uint32_t>(entries.size()), .buffer = {&uniform_}});
    group_ = context.device().create_bind_group({.label = name_, .layout = &layout_, .entries = entries});
  }

  bool compute_;
  SourceLoc loc_;
  std::string name_;
  ShaderSource source_;
  PassFile file_;
  std::vector<ParamValue> values_;
  CheckedShader shader_;
  std::vector<gpu::ColorTargetState> targets_;
  gpu::BindGroupLayout layout_;
  gpu::PipelineLayout pipeline_layout_;
  gpu::RenderPipeline draw_;
  gpu::ComputePipeline dispatch_;
  gpu::Buffer uniform_;
  gpu::BindGroup group_;
  std::uint64_t generation_{};
};

} // namespace

std::unique_ptr<rg::Pass> make_fullscreen_pass() { return std::make_unique<FilePass>(false); }
std::unique_ptr<rg::Pass> make_compute_pass() { return std::make_unique<FilePass>(true); }

} // namespace mote::passes
