// SPDX-License-Identifier: MIT
#include "app/library/frame_renderer.hpp"

#include "app/codes.hpp"
#include "app/library/device_costs.hpp"
#include "app/library/texels.hpp"
#include "core/image/exr.hpp"
#include "core/image/npy.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>

namespace mote::app {

FrameRenderer::FrameRenderer(DrawingDevice& device, ReadyGraph graph, const ColorConfig& config, const DisplayOptions& display,
                             passes::Expansion expansion, double frames, std::shared_ptr<passes::ParticleStore> store)
    : device_(device), graph_(std::move(graph)), store_(store ? std::move(store) : std::make_shared<passes::ParticleStore>(device.device())),
      executor_(device.device(), graph_.plan, graph_.passes) {
  costs_ = device_costs(device.info(), cache_directory(), report_);
  options_.expansion = expansion;
  options_.show_depth_violation = device.validated();
  options_.frames = frames;
  options_.costs = &costs_;
  options_.chosen = [this](const passes::ExpansionReport& report) { choices_.push_back(report); };
  reports_.report = [this](const Diagnostic& d) { report_.add(d); }; // a broken version of a shader is reported once, by its pass
  display_.config = &config;
  display_.display = display.display;
  display_.view = display.view;
  display_.exposure = display.exposure;
  display_.exact = display.exact;
  display_.cache_directory = cache_directory();
  display_.describe = [text = display_text_](const std::string& described) { *text = described; };
}

void FrameRenderer::count_work() {
  if (!executor_.set_counts(true)) report_.warning(code::no_counts, {"--stats"}, fmt::format("{} does not count what pipelines do", device_.info().name));
}

namespace {
// What the particles of a scene take on a device.
std::uint64_t particle_bytes(const Scene& scene) {
  std::set<const ChunkSet*> known;
  std::uint64_t bytes = 0;
  for (const Batch& batch : scene.batches)
    if (const ChunkSet& set = *batch.chunks; known.insert(&set).second)
      bytes += set.records.size() * sizeof(set.records[0]) + (set.rows.size() + set.colors.size()) * sizeof(set.rows[0]) + set.color_indices.size();
  return bytes;
}
} // namespace

void FrameRenderer::check_memory(const Scene& scene) {
  const std::uint64_t budget = device_.device().memory().budget, needed = particle_bytes(scene);
  if (budget != 0 && needed > budget)
    fail(Exit::Failed, code::over_memory, {"--memory"},
         fmt::format("the particles of the scene need {:.1f} MiB, pictures come on top; allowed are {:.1f} MiB", static_cast<double>(needed) / 1048576.0, static_cast<double>(budget) / 1048576.0));
}

void FrameRenderer::set_scene(const Scene& scene) {
  scene_ = &scene;
  check_memory(scene);
  store_->upload(scene);
  device_.check();
}

gpu::Submission FrameRenderer::draw(const View& view) {
  view_ = view;
  rg::FrameInput frame;
  frame.set(scene_);
  frame.set(&view_);
  frame.set(&options_);
  frame.set(&display_);
  frame.set(&reports_);
  frame.set(static_cast<const passes::ParticleStore*>(store_.get()));
  choices_.clear();
  const gpu::Submission submission = executor_.execute(frame, {view.size.width, view.size.height});
  name_choices();
  device_.check();
  return submission;
}

// Reports come in the order of the plan, one from each pass that ran.
void FrameRenderer::name_choices() {
  auto report = choices_.begin();
  for (std::size_t i = 0; i < plan().passes.size() && report != choices_.end(); ++i)
    if (plan().passes[i].kind == report->kind && executor_.last_choice().skipped[i].empty()) (report++)->pass = plan().passes[i].name;
}

void FrameRenderer::wait(gpu::Submission submission) {
  device_.device().queue().wait(submission);
  device_.check();
  Diagnostics said;
  executor_.report(said);
  for (const Diagnostic& d : said.list())
    if (!report_.has(d.code)) report_.add(d);
}

passes::Expansion FrameRenderer::expansion() const {
  return choices_.empty() ? options_.expansion : choices_.front().choice.expansion;
}

std::vector<float> FrameRenderer::read_floats(const std::string& source) {
  const gpu::Texture texture = executor_.texture(source);
  return to_floats(texture.format(), device_.device().read_texture(texture));
}

DrawnPicture FrameRenderer::read() {
  DrawnPicture picture;
  picture.size = view_.size;
  gpu::Device& device = device_.device();
  const gpu::Texture output = executor_.output();
  if (!output || texel_kind(output.format()).components != 4)
    fail(Exit::Failed, code::output_texture, {}, fmt::format("the graph's output '{}' is no picture of four channels", graph_.output));
  const std::vector<std::byte> bytes = device.read_texture(output);
  if (output.format() == gpu::TextureFormat::RGBA8Unorm) picture.rgba8 = texels_as<std::uint8_t>(bytes);
  else picture.display = to_floats(output.format(), bytes);
  if (!graph_.linear.empty()) picture.linear = read_floats(graph_.linear);
  for (const auto& [aov, source] : graph_.aovs) {
    const std::vector<std::byte> texels = device.read_texture(executor_.texture(source));
    if (aov == Aov::Depth) picture.depth = texels_as<float>(texels);
    if (aov == Aov::Id) picture.id = texels_as<std::uint32_t>(texels);
    if (aov == Aov::Normal) {
      const std::vector<float> four = texels_as<float>(texels);
      picture.normal.reserve(four.size() / 4 * 3);
      for (std::size_t i = 0; i + 3 < four.size(); i += 4) picture.normal.insert(picture.normal.end(), {four[i], four[i + 1], four[i + 2]});
    }
  }
  device_.check();
  return picture;
}

namespace {

void dump_exr(const std::string& path, const std::string& source, const gpu::Texture& texture, std::span<const std::byte> bytes) {
  const TexelKind kind = texel_kind(texture.format());
  const gpu::Extent3d size = texture.size();
  if (size.depth_or_layers != 1)
    fail(Exit::Failed, code::output_texture, {"--dump"}, fmt::format("'{}' has layers; an .exr holds none, a .npy does", source));
  const bool whole = kind.npy == "<u4" && kind.components == 1;
  const std::vector<float> floats = whole ? std::vector<float>{} : to_floats(texture.format(), bytes);
  const std::vector<std::uint32_t> uints = whole ? texels_as<std::uint32_t>(bytes) : std::vector<std::uint32_t>{};
  const std::array<const char*, 4> names{"R", "G", "B", "A"};
  std::vector<ExrPlane> planes;
  for (std::size_t k = 0; k < kind.components; ++k) {
    ExrPlane plane{.name = kind.components == 1 ? "Y" : names[k], .type = whole ? ExrType::Uint : ExrType::Float, .stride = kind.components};
    (whole ? void(plane.uints = uints.data()) : void(plane.floats = floats.data() + k));
    planes.push_back(plane);
  }
  write_exr(path, size.width, size.height, planes);
}

void dump_npy(const std::string& path, const gpu::Texture& texture, std::span<const std::byte> bytes) {
  const TexelKind kind = texel_kind(texture.format());
  const gpu::Extent3d size = texture.size();
  std::vector<std::size_t> shape{size.height, size.width};
  if (size.depth_or_layers != 1) shape.insert(shape.begin(), size.depth_or_layers);
  if (kind.components != 1) shape.push_back(kind.components);
  write_npy(path, kind.npy, shape, bytes);
}

} // namespace

void FrameRenderer::dump(const std::string& source, const std::string& path) {
  gpu::Device& device = device_.device();
  if (const gpu::Buffer buffer = executor_.buffer(source)) {
    if (file_kind(path) != FileKind::Npy)
      fail(Exit::Failed, code::output_texture, {"--dump"}, fmt::format("'{}' is a buffer; only a .npy holds it", source));
    const std::vector<std::byte> bytes = device.read_buffer(buffer);
    const std::array<std::size_t, 1> shape{bytes.size() / 4};
    write_npy(path, "<u4", shape, bytes);
    return;
  }
  const gpu::Texture texture = executor_.texture(source);
  if (!texture || texel_kind(texture.format()).components == 0)
    fail(Exit::Failed, code::output_texture, {"--dump"}, fmt::format("'{}' cannot be read back", source));
  const std::vector<std::byte> bytes = device.read_texture(texture);
  device_.check();
  if (file_kind(path) == FileKind::Exr) dump_exr(path, source, texture, bytes);
  else dump_npy(path, texture, bytes);
}

} // namespace mote::app
