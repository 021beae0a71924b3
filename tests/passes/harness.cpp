// SPDX-License-Identifier: MIT
#include "harness.hpp"

#include "core/reference/reference.hpp"
#include "passes/builtin.hpp"
#include "render_graph/compile.hpp"
#include "render_graph/executor.hpp"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

namespace mote::test {
namespace {

struct World {
  gpu::Instance instance;
  gpu::Device device;
  ColorConfig config = ColorConfig::load();
  std::vector<std::string> uncaptured;
};

World& world() {
  static World* w = [] {
    auto made = new World;
    gpu::Error error;
    made->instance = gpu::Instance::create({.validation = true}, error);
    EXPECT_TRUE(made->instance) << to_string(error);
    const gpu::Adapter adapter = made->instance.request_adapter({}, error);
    EXPECT_TRUE(adapter) << to_string(error);
    const gpu::Feature wanted = gpu::Feature::GeometryShader | gpu::Feature::TimestampQuery | gpu::Feature::Subgroups | gpu::Feature::ShaderInt64 |
                                gpu::Feature::Int64Atomics | gpu::Feature::ShaderFloat64; // the last for twins
    made->device = adapter.request_device({.required_features = wanted & adapter.features(), .fill_new_memory = true}, error);
    EXPECT_TRUE(made->device) << to_string(error);
    made->device.on_uncaptured_error([made](const gpu::Error& e) { made->uncaptured.push_back(to_string(e)); });
    return made;
  }();
  return *w;
}

template <class T> std::vector<T> read(gpu::Device device, const gpu::Texture& texture) {
  const std::vector<std::byte> bytes = device.read_texture(texture);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

double percentile(std::vector<double>& values, double p) {
  if (values.empty()) return 0.0;
  const auto k = static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

} // namespace

void GpuTest::SetUp() { ASSERT_TRUE(world().device); }

void GpuTest::TearDown() {
  EXPECT_TRUE(world().uncaptured.empty()) << world().uncaptured.front();
  const auto messages = world().instance.validation_messages();
  EXPECT_TRUE(messages.empty()) << messages.front();
}

gpu::Device GpuTest::device() { return world().device; }

Picture GpuTest::draw(const Scene& scene, const View& view, const passes::FrameOptions& options, const std::vector<std::string>& settings) {
  rg::Registry registry;
  passes::register_builtin_passes(registry);
  rg::CompileOptions roots;
  for (const char* source : {"opaque.color", "opaque.aov_depth", "opaque.aov_id", "opaque.aov_normal"})
    roots.roots.push_back({source, {"test"}});
  const auto graph = rg::compile_file(MOTE_SOURCE_DIR "/app/graphs/" + graph_ + ".toml", registry, roots, settings);
  EXPECT_TRUE(graph.plan) << to_string(graph.diagnostics);
  if (!graph.plan) return {};

  passes::ParticleStore store(device());
  store.upload(scene);
  const passes::DisplaySettings display{.config = &world().config};
  rg::FrameInput frame;
  frame.set(&scene);
  frame.set(&view);
  frame.set(&options);
  frame.set(&display);
  frame.set(static_cast<const passes::ParticleStore*>(&store));
  rg::Executor executor(device(), *graph.plan, graph.passes);
  executor.execute(frame, {view.size.width, view.size.height});

  Picture picture;
  picture.size = view.size;
  picture.depth = read<float>(device(), executor.texture("opaque.aov_depth"));
  picture.id = read<std::uint32_t>(device(), executor.texture("opaque.aov_id"));
  picture.normal = read<glm::vec4>(device(), executor.texture("opaque.aov_normal"));
  for (const std::uint64_t half : read<std::uint64_t>(device(), executor.texture("opaque.color")))
    picture.color.push_back(glm::unpackHalf4x16(half));
  picture.display = read<glm::u8vec4>(device(), executor.output());
  return picture;
}

namespace {
// Where both show the same particle, the surfaces are the same: depth within 4 ulp, color within a half float's step.
void expect_same_surfaces(const Picture& a, const Picture& b) {
  for (std::size_t i = 0; i < a.id.size(); ++i) {
    if (a.id[i] != b.id[i] || a.id[i] == 0xFFFFFFFFu) continue;
    ASSERT_LE(std::abs(a.depth[i] - b.depth[i]), 4 * 1.2e-7f * b.depth[i]) << "pixel " << i;
    ASSERT_LE(glm::length(a.color[i] - b.color[i]), 2e-3f) << "pixel " << i;
  }
}
} // namespace

Picture GpuTest::check(const Scene& scene, const View& view, const Bars& bars) {
  using passes::Expansion;
  const Picture vertex = draw(scene, view, {.expansion = Expansion::Vertex});
  const Picture geometry = draw(scene, view, {.expansion = Expansion::Geometry});
  EXPECT_EQ(vertex.id, geometry.id);
  EXPECT_EQ(vertex.depth, geometry.depth);
  EXPECT_EQ(vertex.normal, geometry.normal);
  EXPECT_EQ(vertex.display, geometry.display);
  const bool points = std::all_of(scene.batches.begin(), scene.batches.end(), [](const Batch& batch) { return batch.type == "sphere"; });
  const Picture point = points ? draw(scene, view, {.expansion = Expansion::Point}) : vertex;
  EXPECT_EQ(vertex.id, point.id);
  EXPECT_EQ(vertex.depth, point.depth);
  EXPECT_EQ(vertex.normal, point.normal);
  EXPECT_EQ(vertex.display, point.display);
  expect_equals_reference(vertex, scene, view, bars);
  // FC-29: with the alarm on, not one fragment is magenta.
  const Picture alarm = draw(scene, view, {.expansion = Expansion::Vertex, .show_depth_violation = true});
  EXPECT_EQ(alarm.display, vertex.display) << "a fragment's depth breaks the bound that its proxy promises";
  const Picture compute = draw(scene, view, {.expansion = Expansion::Compute});
  expect_equals_reference(compute, scene, view, bars);
  expect_same_surfaces(compute, vertex);
  return vertex;
}

std::vector<glm::dvec4> cloud(std::size_t n, double half, double r_min, double r_max, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<glm::dvec4> spheres;
  for (std::size_t i = 0; i < n; ++i)
    spheres.emplace_back(u(random) * half, u(random) * half, u(random) * half, r_min * std::pow(r_max / r_min, 0.5 * (u(random) + 1)));
  return spheres;
}

Scene placed(Scene scene, const std::vector<glm::dmat4>& instances) {
  Batch& batch = scene.batches.at(0);
  batch.instances.clear();
  scene.bounds = {};
  for (const glm::dmat4& m : instances) {
    batch.instances.push_back({m});
    const Bounds& data = batch.chunks->bounds;
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 corner(i & 1 ? data.max.x : data.min.x, i & 2 ? data.max.y : data.min.y, i & 4 ? data.max.z : data.min.z);
      scene.bounds.add(glm::dvec3(m * glm::dvec4(corner, 1.0)));
    }
  }
  return scene;
}

Scene scene_of(const std::vector<glm::dvec4>& spheres, const std::vector<std::uint32_t>& colors) {
  std::vector<glm::dvec3> centers;
  std::vector<double> radii;
  std::vector<std::uint32_t> rows, kept;
  Scene scene;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    if (!(spheres[i].w > 0)) continue;
    centers.push_back(glm::dvec3(spheres[i]));
    radii.push_back(spheres[i].w);
    rows.push_back(i);
    if (!colors.empty()) kept.push_back(colors[i % colors.size()]);
    scene.bounds.add(centers.back(), radii.back());
  }
  Batch batch;
  batch.chunks = std::make_shared<ChunkSet>(build_spheres(centers, radii, rows, kept));
  batch.instances.resize(1);
  batch.row_count = spheres.size();
  scene.batches.push_back(std::move(batch));
  scene.lights.push_back({.kind = LightKind::Headlight, .intensity = 0.8});
  return scene;
}

Scene glyph_scene(const std::string& type, const std::vector<Glyph>& glyphs, const std::vector<std::uint32_t>& colors) {
  std::vector<glm::dvec3> centers;
  std::vector<double> bounds, finest;
  std::vector<glm::vec4> rest;
  std::vector<std::uint32_t> rows, kept;
  Scene scene;
  for (std::uint32_t i = 0; i < glyphs.size(); ++i) {
    centers.push_back(glyphs[i].center);
    bounds.push_back(glyphs[i].bound);
    finest.push_back(glyphs[i].finest);
    rest.insert(rest.end(), glyphs[i].rest.begin(), glyphs[i].rest.end());
    rows.push_back(i);
    if (!colors.empty()) kept.push_back(colors[i % colors.size()]);
    scene.bounds.add(centers.back(), bounds.back());
  }
  Batch batch;
  batch.type = type;
  batch.chunks = std::make_shared<ChunkSet>(build_chunks({.vec4s_per_record = 1 + static_cast<std::uint32_t>(glyphs.at(0).rest.size()), .centers = centers,
                                                          .radii = bounds, .finest = finest, .rest = rest, .rows = rows, .colors = kept}));
  batch.instances.resize(1);
  batch.row_count = glyphs.size();
  scene.batches.push_back(std::move(batch));
  scene.lights.push_back({.kind = LightKind::Headlight, .intensity = 0.8});
  return scene;
}

Scene joined(Scene scene, const Scene& other) {
  for (Batch batch : other.batches) {
    batch.id_base = scene.particle_count();
    scene.batches.push_back(std::move(batch));
  }
  scene.bounds.add(other.bounds);
  return scene;
}

namespace {
View finish(Camera camera, const Scene& scene, glm::dvec3 eye, glm::dvec3 target, Size2d size) {
  camera.eye = eye;
  camera.target = target;
  camera.up = std::abs(glm::normalize(target - eye).y) > 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  EXPECT_EQ(check(camera), "");
  return make_view(camera, size, scene.bounds.diagonal());
}
} // namespace

View look(const Scene& scene, glm::dvec3 eye, glm::dvec3 target, Size2d size, double fov_y) {
  Camera camera;
  camera.fov_y = fov_y;
  return finish(camera, scene, eye, target, size);
}

View look_orthographic(const Scene& scene, glm::dvec3 eye, glm::dvec3 target, Size2d size, double height) {
  Camera camera;
  camera.projection = Projection::Orthographic;
  camera.height = height;
  return finish(camera, scene, eye, target, size);
}

void expect_equals_reference(const Picture& picture, const Scene& scene, const View& view, const Bars& bars) {
  const ReferencePicture reference = render_reference(scene, view);
  ASSERT_EQ(picture.id.size(), reference.id.size());
  std::size_t wrong = 0, first = 0, hits = 0, ambiguous = 0;
  std::size_t beyond = 0, colors_off = 0;
  std::vector<double> depth;
  double worst_color = 0.0;
  for (std::size_t i = 0; i < reference.id.size(); ++i) {
    hits += reference.id[i] != reference_no_id;
    ambiguous += reference.ambiguous[i];
    if (reference.ambiguous[i]) continue;
    if (picture.id[i] != reference.id[i]) {
      if (wrong++ == 0) first = i;
      continue;
    }
    if (reference.id[i] == reference_no_id) {
      EXPECT_EQ(picture.depth[i], std::numeric_limits<float>::infinity());
      continue;
    }
    depth.push_back(std::abs(picture.depth[i] - reference.depth[i]) / reference.depth[i]);
    const glm::dvec3 n(picture.normal[i]);
    const double angle = std::atan2(glm::length(glm::cross(n, reference.normal[i])), glm::dot(n, reference.normal[i]));
    beyond += angle > bars.normal_factor * (1e-6 + 1.5e-4 / reference.projected_radius[i]);
    const glm::dvec4 c = glm::abs(glm::dvec4(picture.color[i]) - reference.color[i]);
    const double color = std::max({c.r, c.g, c.b});
    colors_off += color > 1.0 / 255.0;
    worst_color = std::max(worst_color, color);
  }
  EXPECT_EQ(wrong, 0u) << "first at pixel " << first % picture.size.width << "," << first / picture.size.width << ": id "
                       << picture.id[first] << ", reference " << reference.id[first] << ", depth " << reference.depth[first];
  EXPECT_LT(static_cast<double>(ambiguous), bars.most_ambiguous * static_cast<double>(reference.id.size())) << "most pixels must count";
  EXPECT_GE(static_cast<double>(hits), bars.least_hits * static_cast<double>(reference.id.size()));
  if (depth.empty()) return;
  EXPECT_LE(percentile(depth, 0.5), 6e-8 * bars.depth_factor);
  EXPECT_LE(percentile(depth, 0.99), 2.5e-7 * bars.depth_factor);
  EXPECT_LE(static_cast<double>(colors_off), bars.colors_off * static_cast<double>(depth.size())) << "worst color " << worst_color;
  // Against each pixel's own projected radius: at most one in a hundred lies beyond the bar.
  EXPECT_LE(static_cast<double>(beyond), 0.01 * bars.depth_factor * static_cast<double>(depth.size()));
}

} // namespace mote::test
