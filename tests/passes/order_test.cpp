// SPDX-License-Identifier: MIT
// The order of transparent particles without a device: the radix sort against std::stable_sort, one order
// over all batches and instances, and the bound on what rows of pixels see.
#include "passes/layer_lists.hpp"
#include "passes/particles/order.hpp"
#include "passes/particles/radix_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace mote;
using namespace mote::passes;

namespace {

TEST(RadixSort, IsTheStableOrder) {
  std::mt19937_64 random(3);
  for (const std::size_t n : {0u, 1u, 2u, 1000u, 300000u})
    for (const std::uint64_t mask : {~std::uint64_t{0}, std::uint64_t{0xFF}, std::uint64_t{0xF0000000000000FF}}) {
      std::vector<KeyValue> items(n);
      for (std::size_t i = 0; i < n; ++i) items[i] = {random() & mask, static_cast<std::uint32_t>(i)};
      std::vector<KeyValue> wanted = items;
      std::stable_sort(wanted.begin(), wanted.end(), [](const KeyValue& a, const KeyValue& b) { return a.key < b.key; });
      radix_sort(items);
      ASSERT_TRUE(std::equal(items.begin(), items.end(), wanted.begin(),
                             [](const KeyValue& a, const KeyValue& b) { return a.key == b.key && a.value == b.value; })) << n;
    }
}

TEST(RadixSort, KeysOrderAsDoublesDo) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const double values[] = {-infinity, -1e300, -1.0, -1e-300, 0.0, 1e-300, 1.0, 1.0 + 1e-15, 1e300, infinity};
  for (std::size_t i = 0; i + 1 < std::size(values); ++i) EXPECT_LT(sortable(values[i]), sortable(values[i + 1])) << values[i];
  EXPECT_EQ(sortable(-0.0), sortable(0.0));
  EXPECT_GT(sortable(nan), sortable(infinity));
  EXPECT_GT(sortable(-nan), sortable(infinity));
}

// Spheres (x, y, z, r) of one batch.
Batch batch_of(const std::vector<glm::dvec4>& spheres, double alpha) {
  std::vector<glm::dvec3> centers;
  std::vector<double> radii;
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    centers.emplace_back(spheres[i]);
    radii.push_back(spheres[i].w);
    rows.push_back(i);
  }
  Batch batch;
  batch.chunks = std::make_shared<ChunkSet>(build_spheres(centers, radii, rows, {}));
  batch.instances.resize(1);
  batch.alpha = alpha;
  batch.row_count = spheres.size();
  return batch;
}

View view_from(glm::dvec3 eye, Projection projection = Projection::Perspective) {
  Camera camera;
  camera.projection = projection;
  camera.eye = eye;
  camera.target = {0, 0, 0};
  camera.up = {0, 1, 0};
  camera.height = 40;
  camera.fov_y = 60;
  return make_view(camera, {320, 180}, 50.0);
}

struct Ordered {
  Scene scene;
  std::vector<ChunkBase> bases;
  // Nearness of each particle, in order: its power, or its depth.
  std::vector<double> nearness(const View& view, const OrderedParticles& ordered) const {
    std::vector<double> out;
    for (const std::uint32_t place : ordered.order) {
      const PlacedChunk& placed = ordered.placements[place / chunk_capacity];
      const BatchBlock& block = ordered.blocks[ordered.owners[place / chunk_capacity]];
      const ChunkBase* base = &bases.front();
      for (const ChunkBase& b : bases)
        if (b.first_chunk <= placed.bits.w) base = &b;
      const glm::vec4 record = base->set->records[(placed.bits.w - base->first_chunk) * chunk_capacity + place % chunk_capacity];
      const glm::dvec3 origin(std::bit_cast<float>(placed.bits.x), std::bit_cast<float>(placed.bits.y), std::bit_cast<float>(placed.bits.z));
      const glm::dvec3 center = origin + glm::dvec3(glm::mat3(glm::vec3(block.linear0_scale), glm::vec3(block.linear1), glm::vec3(block.linear2)) * glm::vec3(record));
      const double radius = double(record.w) * block.linear0_scale.w;
      out.push_back(view.projection == Projection::Perspective ? glm::dot(center, center) - radius * radius : center.z);
    }
    return out;
  }
};

Ordered two_batches() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  Ordered o;
  std::uint32_t first = 0;
  for (int b = 0; b < 2; ++b) {
    std::vector<glm::dvec4> spheres;
    for (int i = 0; i < 500; ++i) spheres.emplace_back(8 * u(random), 8 * u(random), 8 * u(random), 0.5 + 0.4 * u(random));
    o.scene.batches.push_back(batch_of(spheres, 0.5));
    o.scene.batches.back().id_base = 500u * static_cast<unsigned>(b);
    o.bases.push_back({o.scene.batches.back().chunks.get(), first});
    first += static_cast<std::uint32_t>(o.scene.batches.back().chunks->chunks.size());
  }
  o.scene.batches[1].instances.push_back({glm::dmat4(1.0)});
  o.scene.batches[1].instances[1].world_from_data[3] = {3, 2, 1, 1};
  return o;
}

TEST(Order, IsOneOverAllBatchesAndInstances) {
  const Ordered o = two_batches();
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    const View view = view_from({10, 20, 40}, projection);
    const OrderedParticles back = order_particles(o.scene, view, {}, Order::BackToFront, o.bases);
    ASSERT_EQ(back.order.size(), 1500u);
    std::vector<double> nearness = o.nearness(view, back);
    EXPECT_TRUE(std::is_sorted(nearness.begin(), nearness.end(), [](double a, double b) { return a > b + 1e-4; })) << "back to front";
    const OrderedParticles front = order_particles(o.scene, view, {}, Order::FrontToBack, o.bases);
    nearness = o.nearness(view, front);
    EXPECT_TRUE(std::is_sorted(nearness.begin(), nearness.end(), [](double a, double b) { return a < b - 1e-4; })) << "front to back";
    EXPECT_EQ(back.runs.size(), 1u) << "one draw";
    EXPECT_EQ(back.blocks.size(), 3u);
  }
}

TEST(Order, RunsEndWhereAnotherPipelineIsNeeded) {
  Ordered o = two_batches();
  o.scene.batches[0].material.specular = 0.5;
  const OrderedParticles ordered = order_particles(o.scene, view_from({10, 20, 40}), {}, Order::BackToFront, o.bases);
  ASSERT_GT(ordered.runs.size(), 10u);
  std::uint32_t next = 0;
  for (const OrderedRun& run : ordered.runs) {
    EXPECT_EQ(run.first, next);
    next += run.count;
  }
  EXPECT_EQ(next, 1500u);
  const OrderedParticles by_file = order_particles(o.scene, view_from({10, 20, 40}), {}, Order::File, o.bases);
  EXPECT_EQ(by_file.runs.size(), 2u);
}

TEST(Order, TakesWhatIsSelected) {
  Ordered o = two_batches();
  o.scene.batches[1].alpha = 1.0;
  const View view = view_from({10, 20, 40});
  EXPECT_EQ(order_particles(o.scene, view, {{}, Opacity::Transparent}, Order::File, o.bases).order.size(), 500u);
  EXPECT_EQ(order_particles(o.scene, view, {{}, Opacity::Opaque}, Order::File, o.bases).order.size(), 1000u);
  EXPECT_EQ(order_particles(o.scene, view, {{}, Opacity::All}, Order::File, o.bases).order.size(), 1500u);
  o.scene.batches[0].alpha = 0.0;
  EXPECT_EQ(order_particles(o.scene, view, {{}, Opacity::All}, Order::File, o.bases).order.size(), 1000u) << "alpha 0 is nothing";
}

// The bound of every row holds, and is not idle: counted against the projection of each sphere on a fine grid.
TEST(LayerLists, RowsAreBoundedFromAbove) {
  const Ordered o = two_batches();
  for (const glm::dvec3 eye : {glm::dvec3(10, 20, 40), glm::dvec3(2, 1, 3)}) {
    const View view = view_from(eye);
    const std::vector<std::uint64_t> rows = entries_per_row(o.scene, view, {});
    std::vector<std::uint64_t> counted(rows.size());
    for (const Batch& batch : o.scene.batches)
      for (const Instance& instance : batch.instances)
        for (std::uint64_t i = 0; i < batch.chunks->record_count(); ++i) {
          if (batch.chunks->rows[i] == no_row) continue;
          const glm::dvec3 c = view.to_view(glm::dvec3(instance.world_from_data * glm::dvec4(batch.chunks->center(i), 1)));
          const double r = batch.chunks->records[i].w;
          for (std::uint32_t y = 0; y < view.size.height; y += 7)
            for (std::uint32_t x = 0; x < view.size.width; ++x) {
              const glm::dvec3 d = view.ray_direction(x, y);
              const double b = glm::dot(d, c), q = b * b - glm::dot(d, d) * (glm::dot(c, c) - r * r);
              counted[y] += q >= 0 && b + std::sqrt(q) > 0;
            }
        }
    std::uint64_t bound = 0, sum = 0;
    for (std::size_t y = 0; y < rows.size(); y += 7) {
      EXPECT_GE(rows[y], counted[y]) << "row " << y;
      bound += rows[y];
      sum += counted[y];
    }
    EXPECT_GT(sum, 1000u);
    if (eye.z > 10) { // spheres that reach the eye plane count everywhere
      EXPECT_LT(bound, 2 * sum);
    }
  }
}

TEST(LayerLists, StripsHoldWhatFitsAndLoseNoRow) {
  const std::vector<std::uint64_t> rows{3, 3, 3, 10, 0, 4, 4, 0};
  const std::vector<Rows> strips = strips_of(rows, 8);
  ASSERT_EQ(strips.size(), 4u); // 3+3 | 3 | 10 alone | 0+4+4+0
  const Rows wanted[] = {{0, 2}, {2, 3}, {3, 4}, {4, 8}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(strips[i].begin, wanted[i].begin);
    EXPECT_EQ(strips[i].end, wanted[i].end);
  }
  EXPECT_EQ(strips_of(rows, 100).size(), 1u);
}

} // namespace
