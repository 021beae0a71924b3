// SPDX-License-Identifier: MIT
#include "graph_test.hpp"

#include "core/color/color_config.hpp"
#include "passes/builtin.hpp"
#include "render_graph/executor.hpp"

#include <glm/gtc/packing.hpp>

#include <cstring>

namespace mote::test {
namespace {

std::vector<glm::vec4> texels_of(gpu::Device device, const gpu::Texture& texture) {
  const std::vector<std::byte> bytes = device.read_texture(texture);
  std::vector<glm::vec4> out;
  if (texture.format() == gpu::TextureFormat::RGBA32Float) {
    out.resize(bytes.size() / sizeof(glm::vec4));
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
  }
  EXPECT_EQ(texture.format(), gpu::TextureFormat::RGBA16Float);
  std::vector<std::uint64_t> halves(bytes.size() / 8);
  std::memcpy(halves.data(), bytes.data(), bytes.size());
  for (const std::uint64_t half : halves) out.push_back(glm::unpackHalf4x16(half));
  return out;
}

const rg::Registry& kinds() {
  static const rg::Registry registry = [] {
    rg::Registry made;
    passes::register_builtin_passes(made);
    return made;
  }();
  return registry;
}

} // namespace

Diagnostics GraphTest::check_graph(const std::string& graph) {
  Diagnostics diagnostics;
  const rg::GraphDesc desc = rg::parse_graph(graph, "test.toml", diagnostics);
  if (diagnostics.has_errors()) return diagnostics;
  return rg::compile(desc, kinds(), {}, diagnostics).diagnostics;
}

Colors GraphTest::draw_graph(const Scene& scene, const View& view, const std::string& graph, const std::string& source,
                             const passes::FrameOptions& options) {
  Diagnostics diagnostics;
  const rg::GraphDesc desc = rg::parse_graph(graph, "test.toml", diagnostics);
  rg::CompileOptions roots;
  roots.roots.push_back({source, {"test"}});
  rg::CompileResult compiled = rg::compile(desc, kinds(), roots, diagnostics);
  EXPECT_TRUE(compiled.plan) << to_string(compiled.diagnostics);
  if (!compiled.plan) return {};
  static const ColorConfig config = ColorConfig::load();
  passes::ParticleStore store(device());
  store.upload(scene);
  const passes::DisplaySettings display{.config = &config};
  rg::FrameInput frame;
  frame.set(&scene);
  frame.set(&view);
  frame.set(&options);
  frame.set(&display);
  frame.set(static_cast<const passes::ParticleStore*>(&store));
  rg::Executor executor(device(), *compiled.plan, compiled.passes);
  device().queue().wait(executor.execute(frame, {view.size.width, view.size.height}));
  Colors colors{view.size, texels_of(device(), executor.texture(source)), {}, {}};
  executor.report(colors.report);
  for (std::size_t i = 0; i < executor.plan().passes.size(); ++i)
    if (executor.last_choice().skipped[i].empty()) colors.ran.push_back(executor.plan().passes[i].name);
  return colors;
}

Scene join(const std::vector<Scene>& scenes) {
  Scene out = scenes.front();
  for (std::size_t i = 1; i < scenes.size(); ++i)
    for (Batch batch : scenes[i].batches) {
      batch.id_base = out.particle_count();
      out.batches.push_back(std::move(batch));
    }
  for (const Scene& scene : scenes) out.bounds.add(scene.bounds);
  return out;
}

Scene flat_sphere(glm::dvec4 center_radius, glm::dvec3 color, double alpha) {
  Scene scene = scene_of({center_radius});
  scene.lights.clear();
  scene.ambient = glm::dvec3(1);
  scene.batches[0].color = color;
  scene.batches[0].alpha = alpha;
  return scene;
}

} // namespace mote::test
