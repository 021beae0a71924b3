// SPDX-License-Identifier: MIT
#include "drawing.hpp"

#include "passes/builtin.hpp"
#include "render_graph/compile.hpp"

#include <glm/gtc/packing.hpp>

#include <cstring>
#include <random>

namespace mote::test {
namespace {

template <class T> std::vector<T> read(gpu::Device device, const gpu::Texture& texture) {
  const std::vector<std::byte> bytes = device.read_texture(texture);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

} // namespace

Drawing::Drawing(gpu::Device device, const passes::FrameOptions& options, bool every_aov, std::uint64_t largest_binding, const std::vector<std::string>& settings)
    : device_(device), options_(options), every_aov_(every_aov), config_(ColorConfig::load()), store_(device, largest_binding ? largest_binding : device.limits().max_storage_buffer_binding_size) {
  rg::Registry registry;
  passes::register_builtin_passes(registry);
  rg::CompileOptions roots;
  if (every_aov)
    for (const char* source : {"opaque.color", "opaque.aov_depth", "opaque.aov_id", "opaque.aov_normal"}) roots.roots.push_back({source, {"test"}});
  auto graph = rg::compile_file(MOTE_SOURCE_DIR "/app/graphs/default.toml", registry, roots, settings);
  EXPECT_TRUE(graph.plan) << to_string(graph.diagnostics);
  executor_ = std::make_unique<rg::Executor>(device_, *graph.plan, graph.passes);
  executor_->set_stage_times(true);
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

bool Drawing::stage_ran(std::string_view stage) {
  for (const rg::PassTiming& timing : executor_->timings(true))
    if (timing.name == "opaque")
      return std::any_of(timing.stages.begin(), timing.stages.end(), [&](const auto& s) { return s.name == stage; });
  return false;
}

Scene cloud_scene(std::uint32_t count, double radius, std::uint32_t seed, double half) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-half, half);
  std::vector<glm::dvec4> spheres;
  for (std::uint32_t i = 0; i < count; ++i) spheres.emplace_back(u(random), u(random), u(random), radius * (1.0 + 0.05 * u(random) / half));
  return scene_of(spheres);
}

// Ids equal but for pixels on the edge of a particle, where the two may round differently: at most 1 in 10 000.
void expect_same(const Picture& tiles, const Picture& vertex, const std::string& what) {
  ASSERT_EQ(tiles.id.size(), vertex.id.size()) << what;
  std::size_t different = 0, color = 0, depth = 0, hits = 0;
  for (std::size_t i = 0; i < vertex.id.size(); ++i) {
    hits += vertex.id[i] != 0xFFFFFFFFu;
    if (tiles.id[i] != vertex.id[i]) {
      ++different;
      continue;
    }
    if (vertex.id[i] == 0xFFFFFFFFu) {
      ASSERT_EQ(tiles.depth[i], vertex.depth[i]) << what;
    } else {
      depth += std::abs(tiles.depth[i] - vertex.depth[i]) > 5e-7f * vertex.depth[i];
    }
    const glm::vec4 c = glm::abs(tiles.color[i] - vertex.color[i]);
    color += std::max({c.r, c.g, c.b}) > 2.0f / 255.0f;
  }
  EXPECT_LE(different, vertex.id.size() / 10000) << what << ", of " << hits << " pixels hit";
  EXPECT_LE(depth, vertex.id.size() / 1000) << what;
  EXPECT_LE(color, vertex.id.size() / 1000) << what;
}

namespace {
struct Bare {
  gpu::Instance instance;
  gpu::Device device;
};
Bare* make_bare(gpu::Feature features) { // for the life of the process, like the harness's
  auto made = new Bare;
  gpu::Error error;
  made->instance = gpu::Instance::create({.validation = true}, error);
  made->device = made->instance.request_adapter({}, error).request_device({.required_features = features, .fill_new_memory = true}, error);
  EXPECT_TRUE(made->device) << to_string(error);
  return made;
}
Bare& bare() {
  static Bare* b = make_bare(gpu::Feature::None);
  return *b;
}
} // namespace

gpu::Device plain_subgroup_device() {
  static Bare* b = make_bare(gpu::Feature::Subgroups);
  return b->device;
}
gpu::Device bare_device() { return bare().device; }
std::vector<std::string> bare_device_messages() { return bare().instance.validation_messages(); }

} // namespace mote::test
