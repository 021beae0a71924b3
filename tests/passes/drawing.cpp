// SPDX-License-Identifier: MIT
#include "drawing.hpp"

#include "passes/builtin.hpp"
#include "render_graph/compile.hpp"

#include <glm/gtc/packing.hpp>

#include <cstring>

namespace mote::test {
namespace {

template <class T> std::vector<T> read(gpu::Device device, const gpu::Texture& texture) {
  const std::vector<std::byte> bytes = device.read_texture(texture);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

} // namespace

Drawing::Drawing(gpu::Device device, const passes::FrameOptions& options, bool every_aov)
    : device_(device), options_(options), every_aov_(every_aov), config_(ColorConfig::load()), store_(device) {
  rg::Registry registry;
  passes::register_builtin_passes(registry);
  rg::CompileOptions roots;
  if (every_aov)
    for (const char* source : {"opaque.color", "opaque.aov_depth", "opaque.aov_id", "opaque.aov_normal"}) roots.roots.push_back({source, {"test"}});
  auto graph = rg::compile_file(MOTE_SOURCE_DIR "/app/graphs/default.toml", registry, roots, {});
  EXPECT_TRUE(graph.plan) << to_string(graph.diagnostics);
  executor_ = std::make_unique<rg::Executor>(device_, *graph.plan, graph.passes);
  options_.chosen = [this](const passes::ExpansionReport& report) { choices_.push_back(report); };
}

Drawing::~Drawing() = default;

Picture Drawing::draw(const Scene& scene, const View& view) {
  choices_.clear();
  store_.upload(scene);
  const passes::DisplaySettings display{.config = &config_};
  rg::FrameInput frame;
  frame.set(&scene);
  frame.set(&view);
  frame.set(&options_);
  frame.set(&display);
  frame.set(static_cast<const passes::ParticleStore*>(&store_));
  device_.queue().wait(executor_->execute(frame, {view.size.width, view.size.height}));
  Picture picture;
  picture.size = view.size;
  picture.display = read<glm::u8vec4>(device_, executor_->output());
  if (!every_aov_) return picture;
  picture.depth = read<float>(device_, executor_->texture("opaque.aov_depth"));
  picture.id = read<std::uint32_t>(device_, executor_->texture("opaque.aov_id"));
  picture.normal = read<glm::vec4>(device_, executor_->texture("opaque.aov_normal"));
  for (const std::uint64_t half : read<std::uint64_t>(device_, executor_->texture("opaque.color"))) picture.color.push_back(glm::unpackHalf4x16(half));
  return picture;
}

Diagnostics Drawing::report() {
  Diagnostics out;
  executor_->report(out);
  return out;
}

bool Drawing::display_ran() {
  for (const rg::PassTiming& timing : executor_->timings(true))
    if (timing.name == "display") return timing.skipped.empty();
  return false;
}

namespace {
struct Bare {
  gpu::Instance instance;
  gpu::Device device;
};
Bare& bare() {
  static Bare* b = [] {
    auto made = new Bare; // for the life of the process, like the harness's
    gpu::Error error;
    made->instance = gpu::Instance::create({.validation = true}, error);
    made->device = made->instance.request_adapter({}, error).request_device({.fill_new_memory = true}, error);
    EXPECT_TRUE(made->device) << to_string(error);
    return made;
  }();
  return *b;
}
} // namespace

gpu::Device bare_device() { return bare().device; }
std::vector<std::string> bare_device_messages() { return bare().instance.validation_messages(); }

} // namespace mote::test
