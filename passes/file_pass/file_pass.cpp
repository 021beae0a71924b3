// SPDX-License-Identifier: MIT
#include "passes/file_pass/file_pass.hpp"

#include "core/gpu/format.hpp"
#include "passes/file_pass/pass_file.hpp"
#include "passes/file_pass/shader_source.hpp"
#include "passes/frame.hpp"
#include "shaders/embedded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

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
    description_ = *description;
    file_ = parse_pass_file(description_, source_.description_path(), problems);
    for (const FileInput& input : file_.inputs)
      slots.push_back({.name = input.name, .access = rg::Access::Sampled, .summary = input.summary});
    for (const FileOutput& output : file_.outputs) {
      if (compute_ && std::any_of(file_.inputs.begin(), file_.inputs.end(), [&](const FileInput& i) { return i.name == output.name; }))
        problems.error("P011", {file_.file}, fmt::format("the output '{}' of a compute pass has the name of an input.", output.name));
      slots.push_back({.name = output.name, .access = compute_ ? rg::Access::StorageWrite : rg::Access::ColorWrite, .summary = output.summary,
                       .makes = rg::TextureSpec{.format = output.format, .size = {.factor = output.size}}});
    }
    values_ = read_values(file_, params);
    for (const FileParam& p : file_.params)
      if (params.has(p.name)) set_.insert(p.name);
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
    make_uniform(device);
    make_pipeline(device);
  }

  void make_uniform(gpu::Device& device) {
    group_ = {};
    uniform_ = device.create_buffer({.label = name_, .size = (values_.size() + 1) * 16, .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
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
  // Changed files are read and compiled anew; what is broken is reported, once, and the pipeline stays.
  void reload(rg::PassContext& context) {
    if (!source_.changed()) return;
    Diagnostics problems;
    PassFile file = file_;
    std::vector<ParamValue> values = values_;
    const std::string description = source_.description().value_or(description_);
    if (description != description_) redescribe(description, file, values, problems);
    CheckedShader next = source_.compile(file, compute_); // also notes the times of the files
    for (const Diagnostic& d : next.problems.list()) problems.add(d);
    const auto* reports = context.frame().find<PassReports>();
    for (const Diagnostic& d : problems.list())
      if (reports && reports->report) reports->report(d);
    if (problems.has_errors()) return;
    shader_ = std::move(next);
    gpu::Device device = context.device();
    if (description != description_) {
      description_ = description;
      file_ = std::move(file);
      values_ = std::move(values);
      make_uniform(device);
    }
    make_pipeline(device);
  }

  // Parameters may come, go and have other defaults; inputs and outputs are joined by the graph, which is read once.
  void redescribe(const std::string& text, PassFile& file, std::vector<ParamValue>& values, Diagnostics& problems) const {
    PassFile next = parse_pass_file(text, source_.description_path(), problems);
    if (problems.has_errors()) return;
    if (!same_slots(file, next))
      problems.error("P012", {next.file}, fmt::format("the inputs or outputs of the pass '{}' have changed: they count when the graph is read again.", name_));
    rg::Params none;
    std::vector<ParamValue> fresh = read_values(next, none);
    for (std::size_t i = 0; i < next.params.size(); ++i) { // what the graph file says stays
      if (!set_.contains(next.params[i].name)) continue;
      const auto before = std::find_if(file.params.begin(), file.params.end(), [&](const FileParam& p) { return p.name == next.params[i].name; });
      if (before != file.params.end() && before->type == next.params[i].type) fresh[i] = values[static_cast<std::size_t>(before - file.params.begin())];
    }
    for (const std::string& name : set_)
      if (std::none_of(next.params.begin(), next.params.end(), [&](const FileParam& p) { return p.name == name && same_type(file, p); }))
        problems.error("P012", {next.file}, fmt::format("the graph sets the parameter '{}', which has gone or has another type now.", name));
    if (problems.has_errors()) return;
    file = std::move(next);
    values = std::move(fresh);
  }
  static bool same_type(const PassFile& file, const FileParam& param) {
    return std::any_of(file.params.begin(), file.params.end(), [&](const FileParam& p) { return p.name == param.name && p.type == param.type; });
  }
  static bool same_slots(const PassFile& a, const PassFile& b) {
    const auto same_input = [](const FileInput& x, const FileInput& y) { return x.name == y.name && x.type == y.type; };
    const auto same_output = [](const FileOutput& x, const FileOutput& y) { return x.name == y.name && x.format == y.format && x.size == y.size; };
    return std::equal(a.inputs.begin(), a.inputs.end(), b.inputs.begin(), b.inputs.end(), same_input) &&
           std::equal(a.outputs.begin(), a.outputs.end(), b.outputs.begin(), b.outputs.end(), same_output);
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
  std::string description_; // text of file_
  PassFile file_;
  std::vector<ParamValue> values_;
  std::set<std::string> set_; // parameters that the graph gives
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
