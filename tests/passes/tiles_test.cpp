// SPDX-License-Identifier: MIT
// The compute expansion against the vertex expansion, frame by frame: what it keeps between frames, what overflows, what
// it fuses, what it cannot do, and what `auto` makes of that.
#include "drawing.hpp"
#include "graph_test.hpp"

#include "core/scene/generated.hpp"

#include <gmock/gmock.h>

namespace mote::test {
namespace {

using passes::Expansion;
using ::testing::HasSubstr;

class Tiles : public GpuTest {};

std::vector<Expansion> expansions_used(const Drawing& drawing) {
  std::vector<Expansion> out;
  for (const auto& report : drawing.choices()) out.push_back(report.choice.expansion);
  return out;
}

// Sixty chunks to a thousand; the camera moves, then jumps to the other side, then into the cloud.
TEST_F(Tiles, FramesOfAMovingCameraAndACutEqualTheVertexExpansion) {
  const Scene scene = cloud_scene(20000, 0.35, 5);
  Drawing tiles(device(), {.expansion = Expansion::Compute}), vertex(device(), {.expansion = Expansion::Vertex});
  const Size2d size{320, 200};
  std::vector<View> views;
  for (int k = 0; k < 4; ++k) views.push_back(look(scene, {40.0 * std::sin(0.05 * k), 6, 40.0 * std::cos(0.05 * k)}, {0, 0, 0}, size));
  views.push_back(look(scene, {-3, -45, 4}, {0, 0, 0}, size));    // cut
  views.push_back(look(scene, {-3, -44.5, 4}, {0, 0.3, 0}, size));
  views.push_back(look(scene, {0.5, 0.4, 0.3}, {10, 3, 1}, size)); // cut, into the cloud
  views.push_back(look(scene, {40, 6, 0}, {0, 0, 0}, {160, 100})); // cut, another size
  for (std::size_t k = 0; k < views.size(); ++k) {
    const Picture got = tiles.draw(scene, views[k]);
    ASSERT_EQ(expansions_used(tiles), std::vector{Expansion::Compute});
    EXPECT_GT(tiles.choices().front().tiled, 0u) << "few in the cloud: what is near is drawn by quads where depth is asked for";
    expect_same(got, vertex.draw(scene, views[k]), "frame " + std::to_string(k));
  }
}

// Chunks of the first scene were seen; the second scene has others in their places.
TEST_F(Tiles, AnotherSceneForgetsNothingThatShows) {
  const Scene one = cloud_scene(9000, 0.5, 1), two = cloud_scene(12000, 0.4, 2);
  Drawing tiles(device(), {.expansion = Expansion::Compute}), vertex(device(), {.expansion = Expansion::Vertex});
  for (const Scene* scene : {&one, &two, &one}) {
    const View view = look(*scene, {4, 5, 40}, {0, 0, 0}, {200, 150});
    expect_same(tiles.draw(*scene, view), vertex.draw(*scene, view), scene == &one ? "one" : "two");
  }
}

// Thousands of particles in one tile: more than its own places hold, so that the list and the second go are needed.
TEST_F(Tiles, ATileWithThousandsOfParticles) {
  Scene scene = cloud_scene(6000, 0.05, 3, 0.4);
  const Scene wide = cloud_scene(300, 0.3, 4);
  scene = join({scene, wide});
  const View view = look(scene, {0, 0, 60}, {0, 0, 0}, {256, 256});
  Drawing tiles(device(), {.expansion = Expansion::Compute}), vertex(device(), {.expansion = Expansion::Vertex});
  for (int k = 0; k < 3; ++k) expect_same(tiles.draw(scene, view), vertex.draw(scene, view), "frame " + std::to_string(k));
}

Scene with_material(Scene scene, ShadingModel model, double specular) {
  for (Batch& batch : scene.batches) {
    batch.material.model = model;
    batch.material.specular = specular;
    batch.material.exponent = 20.0;
  }
  return scene;
}

Scene mixed(ShadingModel first, ShadingModel second) {
  Scene a = with_material(cloud_scene(2000, 0.5, 6), first, 0.4), b = with_material(cloud_scene(1500, 0.7, 7), second, 0.3);
  b.batches[0].color = {0.1, 0.5, 0.9};
  std::vector<glm::dvec4> spheres;
  for (int i = 0; i < 300; ++i) spheres.emplace_back(9.0 * std::sin(i), 9.0 * std::cos(1.3 * i), 9.0 * std::sin(2.1 * i), 0.9);
  Scene colored = with_material(scene_of(spheres, {0xFF3050D0u, 0xFF40C020u, 0xFFD08010u}), first, 0.1);
  colored.batches[0].instances.push_back({glm::dmat4(1)});
  colored.batches[0].instances[1].world_from_data[3] = glm::dvec4(4, 3, 2, 1);
  return join({a, b, colored});
}

TEST_F(Tiles, DataSetsWithMaterialsColorsAndInstancesOfTheirOwn) {
  for (const auto& [first, second] : {std::pair{ShadingModel::Lambert, ShadingModel::Phong}, std::pair{ShadingModel::BlinnPhong, ShadingModel::BlinnPhong},
                                      std::pair{ShadingModel::BlinnPhong, ShadingModel::Lambert}}) {
    const Scene scene = mixed(first, second);
    const View view = look(scene, {20, 15, 45}, {0, 0, 0}, {240, 160});
    Drawing tiles(device(), {.expansion = Expansion::Compute}), vertex(device(), {.expansion = Expansion::Vertex});
    expect_same(tiles.draw(scene, view), vertex.draw(scene, view), std::to_string(int(first)) + " and " + std::to_string(int(second)));
  }
}

std::string refusal(Drawing& drawing, const Scene& scene, const View& view) {
  try {
    (void)drawing.draw(scene, view);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "P001");
    return failure.what();
  }
  return "(none)";
}

constexpr double many_frames = 1e6; // pipelines cost nothing then

TEST_F(Tiles, PhongWithBlinnPhongIsRefusedAndLeftToOthersByAuto) {
  const Scene scene = mixed(ShadingModel::Phong, ShadingModel::BlinnPhong);
  const View view = look(scene, {20, 15, 45}, {0, 0, 0}, {120, 80});
  Drawing tiles(device(), {.expansion = Expansion::Compute});
  EXPECT_THAT(refusal(tiles, scene, view), HasSubstr("Phong and Blinn-Phong"));
  passes::DeviceCosts costs; // tiles for nothing
  costs.costs[0] = {1, 0, 0, 0, 0};
  costs.costs[1] = {2, 0, 0, 0, 0};
  Drawing chosen(device(), {.expansion = Expansion::Auto, .frames = many_frames, .costs = &costs});
  (void)chosen.draw(scene, view);
  EXPECT_EQ(expansions_used(chosen), std::vector{Expansion::Vertex});
  EXPECT_THAT(chosen.choices().front().choice.candidates.back().refused, HasSubstr("Phong"));
  (void)chosen.draw(mixed(ShadingModel::Phong, ShadingModel::Phong), view);
  EXPECT_EQ(expansions_used(chosen), std::vector{Expansion::Compute}) << "the next scene can";
}

TEST_F(Tiles, TheFusedDisplayTransformIsTheDisplayPass) {
  const Scene scene = mixed(ShadingModel::Phong, ShadingModel::Phong);
  const View view = look(scene, {20, 15, 45}, {0, 0, 0}, {333, 222});
  Drawing fused(device(), {.expansion = Expansion::Compute}, false), whole(device(), {.expansion = Expansion::Compute}),
      raster(device(), {.expansion = Expansion::Vertex}, false);
  const Picture a = fused.draw(scene, view), b = whole.draw(scene, view), c = raster.draw(scene, view);
  EXPECT_FALSE(fused.display_ran());
  EXPECT_TRUE(whole.display_ran());
  EXPECT_TRUE(raster.display_ran());
  std::size_t far = 0;
  for (std::size_t i = 0; i < a.display.size(); ++i)
    for (int k = 0; k < 4; ++k) {
      ASSERT_NEAR(int(a.display[i][k]), int(b.display[i][k]), 1) << "pixel " << i;
      far += std::abs(int(a.display[i][k]) - int(c.display[i][k])) > 1;
    }
  EXPECT_LE(far, a.display.size() / 1000);
}

TEST_F(Tiles, OddSizes) {
  const Scene scene = cloud_scene(3000, 0.5, 8);
  Drawing tiles(device(), {.expansion = Expansion::Compute}), vertex(device(), {.expansion = Expansion::Vertex}), fused(device(), {.expansion = Expansion::Compute}, false);
  for (const Size2d size : {Size2d{1, 1}, Size2d{7, 9}, Size2d{641, 361}, Size2d{8, 8}, Size2d{300, 1}}) {
    const View view = look(scene, {2, 1.5, 20}, {0, 0, 0}, size); // particles up to the edges
    const std::string what = std::to_string(size.width) + "x" + std::to_string(size.height);
    const Picture got = tiles.draw(scene, view), want = vertex.draw(scene, view);
    expect_same(got, want, what);
    const Picture displayed = fused.draw(scene, view);
    ASSERT_EQ(displayed.display.size(), want.display.size());
    EXPECT_NEAR(int(displayed.display[0].r), int(want.display[0].r), 1) << what;
  }
}

TEST_F(Tiles, NothingInViewIsTheBackground) {
  Scene scene = cloud_scene(3000, 0.3, 8);
  scene.background = {0.25, 0.5, 1.0, 1.0};
  Drawing tiles(device(), {.expansion = Expansion::Compute}), fused(device(), {.expansion = Expansion::Compute}, false);
  const View away = look(scene, {0, 0, 60}, {0, 0, 200}, {50, 30}), seen = look(scene, {0, 0, 60}, {0, 0, 0}, {50, 30});
  for (const View* view : {&away, &seen, &away}) {
    const Picture picture = tiles.draw(scene, *view);
    const std::size_t hits = static_cast<std::size_t>(std::count_if(picture.id.begin(), picture.id.end(), [](std::uint32_t id) { return id != 0xFFFFFFFFu; }));
    EXPECT_EQ(hits > 0, view == &seen);
    EXPECT_NEAR(picture.color[0].r, 0.25f, 1e-3);
    const Picture displayed = fused.draw(scene, *view);
    EXPECT_EQ(displayed.display[0], picture.display[0]);
  }
}

TEST_F(Tiles, ADeviceWithoutSubgroupsDrawsByVerticesAndSaysSo) {
  const Scene scene = cloud_scene(3000, 0.4, 9);
  const View view = look(scene, {5, 4, 40}, {0, 0, 0}, {100, 70});
  passes::DeviceCosts costs;
  costs.costs[0] = {1, 0, 0, 0, 0};
  Drawing bare(bare_device(), {.expansion = Expansion::Auto, .frames = many_frames, .costs = &costs}), able(device(), {.expansion = Expansion::Auto, .frames = many_frames, .costs = &costs});
  const Picture picture = bare.draw(scene, view);
  EXPECT_EQ(expansions_used(bare), std::vector{Expansion::Vertex});
  const Diagnostics said = bare.report();
  ASSERT_TRUE(said.has("P020"));
  EXPECT_THAT(to_string(said), HasSubstr("warning P020: the device has no subgroup operations"));
  expect_same(able.draw(scene, view), picture, "with and without");
  EXPECT_NE(expansions_used(able), std::vector{Expansion::Vertex});
  EXPECT_FALSE(able.report().has("P020"));
  Drawing asked(bare_device(), {.expansion = Expansion::Compute});
  EXPECT_THAT(refusal(asked, scene, view), HasSubstr("no subgroup operations"));
  Drawing stage(bare_device(), {.expansion = Expansion::Geometry});
  EXPECT_THAT(refusal(stage, scene, view), HasSubstr("expansions that work here: vertex"));
  EXPECT_THAT(bare_device_messages(), ::testing::IsEmpty());
}

} // namespace
} // namespace mote::test
