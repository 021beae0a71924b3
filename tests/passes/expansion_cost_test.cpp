// SPDX-License-Identifier: MIT
// What `auto` reckons with, and what it makes of it; no device.
#include "passes/particles/expansion_cost.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace mote;
using namespace mote::passes;

namespace {

const std::array<std::string, 3> all_can{};

Scene cube_of(std::uint32_t count, double radius) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(-10, 10);
  std::vector<glm::dvec3> centers;
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i < count; ++i) {
    centers.emplace_back(u(random), u(random), u(random));
    rows.push_back(i);
  }
  Scene scene;
  Batch batch;
  batch.chunks = std::make_shared<ChunkSet>(build_spheres(centers, std::vector<double>(count, radius), rows, {}));
  batch.instances.resize(1);
  batch.row_count = count;
  scene.batches.push_back(std::move(batch));
  return scene;
}

View from(double distance, Size2d size = {1280, 720}) {
  Camera camera;
  camera.eye = {0, 0, distance};
  camera.up = {0, 1, 0};
  return make_view(camera, size, 35.0);
}

TEST(Survey, CountsWhatIsInView) {
  const Scene scene = cube_of(20000, 0.05);
  const View view = from(400);
  const ViewContents c = survey(scene, view, {});
  EXPECT_NEAR(c.particles, 20000, 200);
  EXPECT_EQ(c.chunks, c.chunks_total);
  EXPECT_NEAR(c.radius, 0.05 * view.focal / 400, 0.002);
  EXPECT_NEAR(c.fragments, std::pow(2 * c.radius + 1, 2), 0.1);
  EXPECT_NEAR(c.span, std::pow(20 * view.focal / 400, 2), 0.15 * c.span);
  EXPECT_EQ(c.pixels, 1280.0 * 720.0);
  EXPECT_NEAR(c.depth(), 20000 * std::numbers::pi * c.radius * c.radius / c.span, 1e-9);
}

TEST(Survey, ASampleIsEnough) {
  Scene scene = cube_of(20000, 0.05);
  for (int i = 1; i < 20; ++i) scene.batches[0].instances.push_back(scene.batches[0].instances[0]);
  const ViewContents all = survey(scene, from(400), {}, 1u << 30), some = survey(scene, from(400), {}, 500);
  EXPECT_NEAR(all.particles, 400000, 1);
  EXPECT_NEAR(some.particles, all.particles, 0.05 * all.particles);
  EXPECT_NEAR(some.radius, all.radius, 0.05 * all.radius);
}

TEST(Survey, WhatIsOutOfViewOrNotOfThePassCostsNothing) {
  const Scene scene = cube_of(5000, 0.05);
  View away = from(400);
  away.rotation = glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, -1) * away.rotation; // looks the other way
  EXPECT_EQ(survey(scene, away, {}).particles, 0.0);
  EXPECT_EQ(survey(Scene{}, away, {}).particles, 0.0);
  Scene clear = scene;
  clear.batches[0].alpha = 0.5;
  EXPECT_EQ(survey(clear, from(400), {.opacity = Opacity::Opaque}).particles, 0.0);
  const double near = survey(scene, from(12), {}).particles;
  EXPECT_GT(near, 10.0);
  EXPECT_LT(near, 4000.0) << "most lie beside the view";
}

ViewContents contents(double particles, double radius, double span = 500000) {
  return {.particles = particles, .radius = radius, .fragments = std::pow(2 * radius + 1, 2), .tiles = std::pow(radius / 4 + 1, 2), .span = span, .pixels = 921600};
}

TEST(ExpansionCost, MoreOfAnythingCostsMore) {
  const DeviceCosts costs = shipped_costs(gpu::DeviceType::Cpu);
  for (const Expansion e : costed_expansions) {
    const double base = predict_ms(costs, e, contents(1e4, 3));
    EXPECT_GT(predict_ms(costs, e, contents(2e4, 3)), base);
    EXPECT_GT(predict_ms(costs, e, contents(1e4, 6)), base);
    ViewContents more = contents(1e4, 3);
    more.aovs = 3;
    EXPECT_NEAR(predict_ms(costs, e, more) - base, 3 * costs.aov_ns * 0.9216, 1e-9);
  }
}

TEST(ExpansionCost, HiddenParticlesCostTilesLittle) {
  DeviceCosts costs;
  costs.costs[2].unit_ns = 100;
  const double once = predict_ms(costs, Expansion::Compute, contents(1e5, 2));
  EXPECT_GT(contents(1e5, 2).depth(), 2.0);
  EXPECT_NEAR(predict_ms(costs, Expansion::Compute, contents(1e7, 2)), predict_ms(costs, Expansion::Compute, contents(1e8, 2)), 1e-9);
  EXPECT_LT(predict_ms(costs, Expansion::Compute, contents(1e8, 2)), 2 * once);
}

Expansion chosen(const ViewContents& c, double frames, std::span<const std::string, 3> refused = all_can) {
  return ExpansionChooser().choose(shipped_costs(gpu::DeviceType::Cpu), c, refused, frames).expansion;
}

TEST(ExpansionChooser, OnePictureOfFewIsNotWorthComputePipelines) {
  const ViewContents few = contents(1e3, 15, 350000), many = contents(1e6, 1.5, 350000);
  EXPECT_EQ(chosen(few, 1), Expansion::Vertex);
  EXPECT_EQ(chosen(few, 1000), Expansion::Compute);
  EXPECT_EQ(chosen(many, 1), Expansion::Compute);
  EXPECT_EQ(chosen(many, 1000), Expansion::Compute);
}

TEST(ExpansionChooser, WhatCannotIsNotTaken) {
  const std::array<std::string, 3> raster{"", "", "no subgroups"}, vertex{"", "no stage", "no subgroups"};
  const ViewContents many = contents(1e6, 1.5);
  EXPECT_NE(chosen(many, 1000, raster), Expansion::Compute);
  EXPECT_EQ(chosen(many, 1000, vertex), Expansion::Vertex);
  const ExpansionChoice choice = ExpansionChooser().choose(shipped_costs(gpu::DeviceType::Cpu), many, vertex, 1);
  ASSERT_EQ(choice.candidates.size(), 3u);
  EXPECT_EQ(choice.candidates[2].refused, "no subgroups");
}

// A view that moves to and fro over the point where two cost the same.
TEST(ExpansionChooser, DoesNotFlipEveryFrame) {
  DeviceCosts costs;
  costs.costs = {{{0, 100, 0, 0, 0}, {1e6, 0, 0, 0, 0}, {1.0, 0, 0, 0, 0}}}; // equal at 1e4 particles
  ExpansionChooser chooser;
  int flips = 0;
  Expansion last = chooser.choose(costs, contents(0.9e4, 1), all_can, 1000).expansion;
  EXPECT_EQ(last, Expansion::Vertex);
  for (int k = 0; k < 100; ++k) {
    const Expansion now = chooser.choose(costs, contents(k % 2 ? 0.9e4 : 1.2e4, 1), all_can, 1000).expansion;
    flips += now != last;
    last = now;
  }
  EXPECT_EQ(flips, 0);
  EXPECT_EQ(chooser.choose(costs, contents(2e4, 1), all_can, 1000).expansion, Expansion::Compute) << "half the price is reason enough";
  EXPECT_EQ(chooser.choose(costs, contents(0.9e4, 1), all_can, 1000).expansion, Expansion::Compute);
  const std::array<std::string, 3> no_tiles{"", "", "no"};
  EXPECT_EQ(chooser.choose(costs, contents(2e4, 1), no_tiles, 1000).expansion, Expansion::Vertex) << "what cannot any more is left at once";
}

TEST(ExpansionChooser, PipelinesThatAreThereCostNothingAgain) {
  DeviceCosts costs;
  costs.costs = {{{10, 0, 0, 0, 0}, {100, 0, 0, 0, 0}, {1, 0, 0, 0, 300}}};
  ExpansionChooser chooser;
  EXPECT_EQ(chooser.choose(costs, contents(1, 1), all_can, 10).expansion, Expansion::Vertex);
  EXPECT_EQ(chooser.choose(costs, contents(1, 1), all_can, 100).expansion, Expansion::Compute);
  EXPECT_EQ(chooser.choose(costs, contents(1, 1), all_can, 1).expansion, Expansion::Compute);
}

TEST(FitCosts, FindsTheCostsThatMadeTheTimes) {
  for (std::size_t i = 0; i < costed_expansions.size(); ++i) {
    DeviceCosts truth;
    truth.costs[i] = {2.5, i == 2 ? 20.0 : 600.0, 15.0, 12.0, 0.0};
    std::vector<CostSample> samples;
    for (const double particles : {1e2, 1e4, 1e6})
      for (const double radius : {0.5, 4.0, 20.0}) {
        ViewContents c = contents(particles, radius, 1e7);
        c.pixels *= radius;
        samples.push_back({c, predict_ms(truth, costed_expansions[i], c)});
      }
    const ExpansionCosts found = fit_costs(costed_expansions[i], samples);
    EXPECT_NEAR(found.fixed_ms, truth.costs[i].fixed_ms, 0.02 * truth.costs[i].fixed_ms);
    EXPECT_NEAR(found.particle_ns, truth.costs[i].particle_ns, 0.02 * truth.costs[i].particle_ns);
    EXPECT_NEAR(found.unit_ns, truth.costs[i].unit_ns, 0.02 * truth.costs[i].unit_ns);
    EXPECT_NEAR(found.pixel_ns, truth.costs[i].pixel_ns, 0.02 * truth.costs[i].pixel_ns);
  }
}

TEST(FitCosts, NothingIsNegative) {
  // Frames that get cheaper with more pixels: noise.
  std::vector<CostSample> samples;
  for (const double particles : {1e2, 1e4, 1e5})
    for (const double pixels : {1e5, 1e6}) {
      ViewContents c = contents(particles, 2.0);
      c.pixels = pixels;
      samples.push_back({c, 5.0 + 1e-3 * particles - 2e-6 * pixels});
    }
  const ExpansionCosts found = fit_costs(Expansion::Vertex, samples);
  EXPECT_GE(found.fixed_ms, 0.0);
  EXPECT_GE(found.pixel_ns, 0.0);
  EXPECT_GE(found.particle_ns + found.unit_ns, 0.0);
  EXPECT_GT(found.particle_ns + found.unit_ns, 10.0);
}

// One picture of arrows is not worth the pipelines of their tiles; a window is. Superquadrics cost more everywhere.
TEST(Choice, TypesHaveCostsOfTheirOwn) {
  Scene scene = cube_of(100000, 0.3);
  scene.batches[0].type = "arrow";
  const DeviceCosts costs = shipped_costs(gpu::DeviceType::Cpu);
  const ViewContents arrows = survey(scene, from(60), {});
  EXPECT_EQ(arrows.type, "arrow");
  ExpansionChooser once, often;
  EXPECT_EQ(once.choose(costs, arrows, all_can, 1).expansion, Expansion::Vertex);
  EXPECT_EQ(often.choose(costs, arrows, all_can, 1000).expansion, Expansion::Compute);
  ViewContents spheres = arrows, superquadrics = arrows;
  spheres.type = "sphere";
  superquadrics.type = "superquadric";
  for (const Expansion expansion : {Expansion::Vertex, Expansion::Compute}) {
    EXPECT_LE(predict_ms(costs, expansion, spheres), predict_ms(costs, expansion, arrows));
    EXPECT_LT(3 * predict_ms(costs, expansion, arrows), predict_ms(costs, expansion, superquadrics));
  }
  EXPECT_EQ(type_costs("torus"), nullptr);
}

} // namespace
