// SPDX-License-Identifier: MIT
// A byte a particle and a palette draw the same picture, bit for bit, as a word a particle: in every expansion, of opaque
// and transparent particles, in data sets that are cut into several buffers.
#include "drawing.hpp"
#include "graph_test.hpp"

#include <gmock/gmock.h>

#include <set>

namespace mote::test {
namespace {

using passes::Expansion;

// The scene with a word a particle in place of palettes.
Scene with_words(Scene scene) {
  for (Batch& batch : scene.batches) {
    if (!batch.chunks->paletted()) continue;
    auto set = std::make_shared<ChunkSet>(*batch.chunks);
    set->colors.clear();
    for (std::uint64_t i = 0; i < set->record_count(); ++i) set->colors.push_back(batch.chunks->color_of(i));
    set->color_indices = {};
    batch.chunks = set;
  }
  return scene;
}

// `different` colors over the whole of RGB, of which every third lets through what is behind it, if asked to.
std::vector<std::uint32_t> colors(std::uint32_t different, bool transparent = false) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < different; ++i) out.push_back((i * 0x9E3779B1u >> 8) | (transparent && i % 3 == 0 ? 0x60000000u + (i << 24) % 0x90000000u : 0xFF000000u));
  return out;
}

Scene colored_cloud(std::uint32_t count, double radius, const std::vector<std::uint32_t>& own, double half = 10.0) {
  std::vector<glm::dvec4> spheres;
  for (std::uint32_t i = 0; i < count; ++i) spheres.emplace_back(half * std::sin(i), half * std::cos(1.3 * i), half * std::sin(2.1 * i), radius * (1.0 + 0.3 * std::sin(3.7 * i)));
  return scene_of(spheres, own);
}

// Of one color, with a palette, with many colors, with a palette and twice: the particles of each differ in how they are colored.
Scene several(double radius) {
  Scene plain = cloud_scene(500, radius, 3), few = colored_cloud(3000, radius, colors(8)), many = colored_cloud(2000, 1.1 * radius, colors(300)),
        twice = colored_cloud(1000, 1.2 * radius, colors(256));
  plain.batches[0].color = {0.7, 0.2, 0.1};
  twice.batches[0].instances.push_back({glm::dmat4(1)});
  twice.batches[0].instances[1].world_from_data[3] = glm::dvec4(4, 3, 2, 1);
  Scene scene = join({plain, few, many, twice});
  EXPECT_TRUE(!scene.batches[0].chunks->paletted() && scene.batches[1].chunks->paletted() && !scene.batches[2].chunks->paletted() && scene.batches[3].chunks->paletted());
  return scene;
}

template <class T> void expect_equal(const std::vector<T>& got, const std::vector<T>& want, const std::string& what) {
  ASSERT_EQ(got.size(), want.size()) << what;
  std::size_t different = 0;
  for (std::size_t i = 0; i < want.size(); ++i) different += got[i] != want[i];
  EXPECT_EQ(different, 0u) << what << ", of " << want.size() << " pixels";
}
void expect_equal(const Picture& got, const Picture& want, const std::string& what) {
  expect_equal(got.display, want.display, what + ", displayed");
  expect_equal(got.color, want.color, what + ", color");
  expect_equal(got.id, want.id, what + ", id");
  EXPECT_EQ(got.depth, want.depth) << what;
  std::set<std::uint32_t> shown;
  for (const glm::u8vec4& c : got.display) shown.insert(c.r | c.g << 8 | c.b << 16);
  EXPECT_GT(shown.size(), 50u) << what << " shows something";
}

class Palettes : public GraphTest {
protected:
  // Two frames with each, from `eye`: the second knows what was seen.
  void expect_same_as_words(const Scene& scene, const glm::dvec3& eye, Expansion expansion, bool every_aov, std::uint64_t largest_binding = 0) {
    const View view = look(scene, eye, {0, 0, 0}, {300, 200});
    const Scene words = with_words(scene);
    Drawing palette(device(), {.expansion = expansion}, every_aov, largest_binding), word(device(), {.expansion = expansion}, every_aov);
    for (const char* frame : {"first frame", "second frame"})
      expect_equal(palette.draw(scene, view), word.draw(words, view), std::string(to_string(expansion)) + ", " + frame);
    ran_splats_ = palette.stage_ran("resolve splats");
    ran_tiles_ = palette.stage_ran("cast") || palette.stage_ran("cast others");
  }
  bool ran_splats_{}, ran_tiles_{};
};

TEST_F(Palettes, DrawAsWordsDo) {
  for (const Expansion expansion : {Expansion::Vertex, Expansion::Geometry, Expansion::Point, Expansion::Compute}) expect_same_as_words(several(0.4), {20, 15, 45}, expansion, true);
  expect_same_as_words(several(0.4), {20, 15, 45}, Expansion::Compute, false);
  EXPECT_TRUE(ran_tiles_);
}

TEST_F(Palettes, DrawAsWordsDoInSplats) {
  for (const bool every_aov : {true, false}) {
    expect_same_as_words(several(0.04), {20, 15, 45}, Expansion::Compute, every_aov);
    EXPECT_TRUE(ran_splats_);
  }
}

TEST_F(Palettes, DrawAsWordsDoWhereParticlesArePlacedInDouble) {
  const glm::dvec3 eye(0.3, 0.2, 0.9);
  for (const bool every_aov : {true, false}) { // without AOVs tiles serve them, too
    expect_same_as_words(several(0.05), eye, Expansion::Vertex, every_aov);
    expect_same_as_words(several(0.05), eye, Expansion::Compute, every_aov);
  }
}

TEST_F(Palettes, OfTheMostColorsAndOneMore) {
  for (const std::uint32_t different : {256u, 257u}) {
    const Scene scene = colored_cloud(2000, 0.4, colors(different));
    ASSERT_EQ(scene.batches[0].chunks->paletted(), different == 256);
    const View view = look(scene, {20, 15, 45}, {0, 0, 0}, {200, 150});
    for (const Expansion expansion : {Expansion::Vertex, Expansion::Compute}) {
      Drawing drawing(device(), {.expansion = expansion});
      expect_equals_reference(drawing.draw(scene, view), scene, view, {.least_hits = 0.1, .most_ambiguous = 0.05});
    }
  }
}

TEST_F(Palettes, OfSetsInSeveralBuffers) {
  const std::uint64_t binding = 64 * chunk_capacity * sizeof(glm::vec4); // 4096 spheres, a page of bytes
  for (const double radius : {0.3, 0.04}) {
    const Scene scene = join({colored_cloud(20000, radius, colors(200)), colored_cloud(9000, 0.5 * radius, colors(7))});
    for (const Expansion expansion : {Expansion::Vertex, Expansion::Compute})
      for (const bool every_aov : {true, false}) expect_same_as_words(scene, {20, 15, 45}, expansion, every_aov, binding);
  }
}

TEST_F(Palettes, OfParticlesWithAlpha) {
  const Scene scene = join({colored_cloud(300, 1.0, colors(9, true)), cloud_scene(20, 1.0, 3), colored_cloud(300, 0.8, colors(280, true))}), words = with_words(scene);
  ASSERT_TRUE(scene.batches[0].chunks->paletted() && !scene.batches[2].chunks->paletted());
  const View view = look(scene, {20, 15, 45}, {0, 0, 0}, {120, 90});
  const std::string sorted = "order = \"back_to_front\"", exact = "oit = \"exact\"";
  for (const auto& [params, expansion] : {std::pair{sorted, Expansion::Vertex}, std::pair{sorted, Expansion::Geometry}, std::pair{exact, Expansion::Vertex}})
    expect_equal(draw_graph(scene, view, glyphs_over_opaque(params), "glyphs.color", {.expansion = expansion}).texels,
                 draw_graph(words, view, glyphs_over_opaque(params), "glyphs.color", {.expansion = expansion}).texels, params);
  const std::vector<glm::vec4> opaque = draw_graph(scene, view, glyphs_over_opaque(""), "opaque.color").texels;
  expect_equal(opaque, draw_graph(words, view, glyphs_over_opaque(""), "opaque.color").texels, "the opaque ones alone");
  EXPECT_NE(opaque, draw_graph(scene, view, glyphs_over_opaque(""), "glyphs.color").texels);
}

TEST_F(Palettes, ThrowShadowsAsWordsDo) {
  graph_ = "shadowed";
  for (const Expansion expansion : {Expansion::Vertex, Expansion::Compute}) {
    const bool alpha = expansion == Expansion::Vertex; // tiles cannot tell which are opaque
    Scene scene = join({colored_cloud(300, 1.0, colors(9, alpha)), colored_cloud(300, 0.8, colors(5))});
    scene.lights = {{.name = "sun", .kind = LightKind::Directional, .direction = glm::normalize(glm::dvec3(-1, -2, -1)), .intensity = 0.8, .shadows = true}};
    const Scene words = with_words(scene);
    const View view = look(scene, {20, 15, 45}, {0, 0, 0}, {120, 90});
    for (const char* method : {"shadow.method=\"ids\"", "shadow.method=\"depth\""})
      expect_equal(draw(scene, view, {.expansion = expansion}, {method}), draw(words, view, {.expansion = expansion}, {method}), method);
  }
}

} // namespace
} // namespace mote::test
