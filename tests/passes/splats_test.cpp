// SPDX-License-Identifier: MIT
// Small particles in the compute expansion: splats against the vertex expansion and against tiles, which a device without
// atomics of 64 bits draws instead.
#include "drawing.hpp"
#include "graph_test.hpp"

#include <gtest/gtest.h>

namespace mote::test {
namespace {

using passes::Expansion;

class Splats : public GpuTest {};

Scene lit_cloud(double radius, std::uint32_t seed) { return cloud_scene(20000, radius, seed); }

// From 40 away, 400 pixels and 40 degrees high: a radius of 0.04 has up to 1 pixel in front.
constexpr Size2d size{500, 400};
View view_from(const Scene& scene, double angle) { return look(scene, {40 * std::sin(angle), 6, 40 * std::cos(angle)}, {0, 0, 0}, size); }

struct Case {
  double radius;
  bool orthographic;
};
class SplatSizes : public GpuTest, public ::testing::WithParamInterface<Case> {};

TEST_P(SplatSizes, EqualTheReferenceAndTheVertexExpansion) {
  const Scene scene = lit_cloud(GetParam().radius, 21);
  Drawing splats(device(), {.expansion = Expansion::Compute}), vertex(device(), {.expansion = Expansion::Vertex});
  for (const double angle : {0.0, 0.03, 2.0}) {
    const View view = GetParam().orthographic ? look_orthographic(scene, {40 * std::sin(angle), 6, 40 * std::cos(angle)}, {0, 0, 0}, size, 29.0) : view_from(scene, angle);
    const Picture got = splats.draw(scene, view);
    EXPECT_TRUE(splats.stage_ran("resolve splats"));
    expect_same(got, vertex.draw(scene, view), "angle " + std::to_string(angle));
    expect_equals_reference(got, scene, view, {.least_hits = 0.001, .most_ambiguous = 0.25});
  }
}

INSTANTIATE_TEST_SUITE_P(Pixels, SplatSizes,
                         ::testing::Values(Case{0.005, false}, Case{0.02, false}, Case{0.034, false}, Case{0.037, false}, Case{0.04, false}, Case{0.02, true}, Case{0.08, true}),
                         [](const auto& test) { return (test.param.orthographic ? "orthographic_" : "perspective_") + std::to_string(int(1000 * test.param.radius)); });

// Chunks of splats before, between and behind what is tiled, in data sets of their own materials, colors and instances.
Scene small_and_large() {
  Scene small = lit_cloud(0.03, 1), colored, large = cloud_scene(300, 1.0, 2);
  large.batches[0].material.model = ShadingModel::Phong;
  large.batches[0].material.specular = 0.3;
  std::vector<glm::dvec4> spheres;
  std::vector<std::uint32_t> colors;
  for (int i = 0; i < 3000; ++i) {
    spheres.emplace_back(11.0 * std::sin(i), 11.0 * std::cos(1.3 * i), 11.0 * std::sin(2.1 * i), 0.025);
    colors.push_back(0xFF000000u | static_cast<std::uint32_t>(i * 7919) % 0xFFFFFFu);
  }
  colored = scene_of(spheres, colors);
  colored.batches[0].instances.push_back({glm::dmat4(1)});
  colored.batches[0].instances[1].world_from_data[3] = glm::dvec4(4, 3, 2, 1);
  return join({small, large, colored});
}

TEST_F(Splats, BetweenWhatIsTiled) {
  const Scene scene = small_and_large();
  Drawing splats(device(), {.expansion = Expansion::Compute}), vertex(device(), {.expansion = Expansion::Vertex}), fused(device(), {.expansion = Expansion::Compute}, false);
  for (const double angle : {0.0, 0.02, 0.04, 3.0, 3.02}) {
    const View view = view_from(scene, angle);
    const Picture got = splats.draw(scene, view), want = vertex.draw(scene, view);
    EXPECT_TRUE(splats.stage_ran("resolve splats") && (splats.stage_ran("cast") || splats.stage_ran("cast others")));
    expect_same(got, want, "angle " + std::to_string(angle));
    const Picture displayed = fused.draw(scene, view);
    EXPECT_FALSE(fused.display_ran());
    std::size_t far = 0;
    for (std::size_t i = 0; i < want.display.size(); ++i)
      for (int k = 0; k < 4; ++k) far += std::abs(int(displayed.display[i][k]) - int(want.display[i][k])) > 1;
    EXPECT_LE(far, want.display.size() / 500);
  }
}

// The nearest sphere covers half of the picture: what is behind it is tested away before it is splatted, in the second frame
// and after a cut as well.
TEST_F(Splats, BehindAWallAreHidden) {
  Scene wall = scene_of({{0, 0, 30, 6}});
  const Scene scene = join({lit_cloud(0.03, 5), wall});
  Drawing splats(device(), {.expansion = Expansion::Compute}), vertex(device(), {.expansion = Expansion::Vertex});
  for (const double angle : {0.0, 0.0, 0.05, 3.1, 0.0}) {
    const View view = view_from(scene, angle);
    expect_same(splats.draw(scene, view), vertex.draw(scene, view), "angle " + std::to_string(angle));
  }
}

// So dense that splats alone cover whole tiles, and so many that a camera cut takes several steps.
TEST_F(Splats, HideEachOther) {
  const Scene scene = cloud_scene(140000, 0.06, 7, 4.0);
  Drawing splats(device(), {.expansion = Expansion::Compute}), vertex(device(), {.expansion = Expansion::Vertex});
  for (const double angle : {0.0, 0.1, 3.0}) {
    const View view = view_from(scene, angle);
    const Picture got = splats.draw(scene, view);
    EXPECT_TRUE(splats.stage_ran("splat far"));
    expect_same(got, vertex.draw(scene, view), "angle " + std::to_string(angle));
  }
}

TEST_F(Splats, ADeviceWithoutTheirAtomicsTilesThem) {
  const Scene scene = small_and_large();
  const View view = view_from(scene, 0.3);
  Drawing tiles(plain_subgroup_device(), {.expansion = Expansion::Compute}), splats(device(), {.expansion = Expansion::Compute});
  const Picture tiled = tiles.draw(scene, view), splatted = splats.draw(scene, view);
  EXPECT_FALSE(tiles.stage_ran("splat"));
  EXPECT_TRUE(splats.stage_ran("splat"));
  EXPECT_EQ(tiled.id, splatted.id) << "both cast by one formula";
  EXPECT_EQ(tiled.depth, splatted.depth);
}

} // namespace
} // namespace mote::test
