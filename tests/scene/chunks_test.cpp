// SPDX-License-Identifier: MIT
#include "core/scene/chunks.hpp"
#include "core/scene/generated.hpp"
#include "core/scene/morton.hpp"
#include "core/scene/scene.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace mote {
namespace {

using testing::Each;

struct Particles {
  std::vector<glm::dvec3> centers{};
  std::vector<double> radii{};
  std::vector<std::uint32_t> rows{};
  void add(const glm::dvec3& p, double r) {
    centers.push_back(p);
    radii.push_back(r);
    rows.push_back(static_cast<std::uint32_t>(rows.size()));
  }
  [[nodiscard]] ChunkSet build(std::span<const std::uint32_t> colors = {}) const {
    return build_spheres(centers, radii, rows, colors);
  }
};

void add_cluster(Particles& p, std::size_t count, const glm::dvec3& at, double size, double r, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-size, size);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = u(random), y = u(random), z = u(random);
    p.add(at + glm::dvec3(x, y, z), r);
  }
}

// Every particle is in exactly one place, with its radius, close to where it was given, inside its chunk's box.
void expect_sound(const Particles& p, const ChunkSet& set, double bar_in_radii = 1e-3) {
  ASSERT_EQ(set.records.size(), set.record_count());
  ASSERT_EQ(set.rows.size(), set.record_count());
  std::vector<int> seen(p.rows.size());
  double worst = 0.0;
  for (std::uint64_t i = 0; i < set.record_count(); ++i) {
    const Chunk& chunk = set.chunks[i / chunk_capacity];
    if (i % chunk_capacity >= chunk.count) {
      ASSERT_EQ(set.rows[i], no_row);
      ASSERT_EQ(set.records[i], glm::vec4(0.0f));
      continue;
    }
    const std::uint32_t row = set.rows[i];
    ASSERT_LT(row, seen.size());
    ++seen[row];
    ASSERT_EQ(set.records[i].w, static_cast<float>(p.radii[row]));
    worst = std::max(worst, glm::length(set.center(i) - p.centers[row]) / p.radii[row]);
    for (int k = 0; k < 3; ++k) {
      ASSERT_LE(double{chunk.box_min[k]}, double{set.records[i][k]} - double{set.records[i].w});
      ASSERT_GE(double{chunk.box_max[k]}, double{set.records[i][k]} + double{set.records[i].w});
    }
  }
  EXPECT_THAT(seen, Each(1));
  EXPECT_LE(worst, bar_in_radii);
}

TEST(Chunks, EmptyInputMakesNoChunk) {
  const ChunkSet set = Particles{}.build();
  EXPECT_TRUE(set.chunks.empty());
  EXPECT_TRUE(set.bounds.empty());
}

TEST(Chunks, EveryParticleHasOnePlace) {
  Particles p;
  add_cluster(p, 5000, {3, -2, 7}, 10.0, 0.3);
  const ChunkSet set = p.build();
  expect_sound(p, set);
  EXPECT_EQ(set.chunks.size(), (5000u + 63u) / 64u);
}

TEST(Chunks, BoundsHoldAllSpheres) {
  Particles p;
  p.add({0, 0, 0}, 1.0);
  p.add({10, 0, 0}, 2.0);
  const ChunkSet set = p.build();
  EXPECT_NEAR(set.bounds.min.x, -1.0, 1e-5);
  EXPECT_NEAR(set.bounds.max.x, 12.0, 1e-5);
  EXPECT_NEAR(set.bounds.max.y, 2.0, 1e-5);
}

TEST(Chunks, ColorsFollowTheirParticles) {
  Particles p;
  add_cluster(p, 300, {0, 0, 0}, 5.0, 0.1);
  std::vector<std::uint32_t> colors(300);
  std::iota(colors.begin(), colors.end(), 1000u);
  const ChunkSet set = p.build(colors);
  for (std::uint64_t i = 0; i < set.record_count(); ++i)
    if (set.rows[i] != no_row) {
      ASSERT_EQ(set.color_of(i), set.rows[i] + 1000u);
    }
}

TEST(Chunks, FarClustersNeverShareAChunk) {
  for (std::size_t first : {1u, 7u, 63u, 64u, 100u, 4000u}) {
    Particles p;
    add_cluster(p, first, {-5e5, 0, 0}, 1.0, 0.05, 1);
    add_cluster(p, 333, {5e5, 0, 0}, 1.0, 0.05, 2);
    const ChunkSet set = p.build();
    expect_sound(p, set);
    for (const Chunk& chunk : set.chunks) EXPECT_LT(chunk.box_max.x - chunk.box_min.x, 3.0f) << first;
  }
}

TEST(Chunks, ClustersFarFromTheOriginKeepTheirPlaces) {
  Particles p;
  add_cluster(p, 20000, {1e6, -1e6, 1e6}, 50.0, 0.01);
  expect_sound(p, p.build());
}

TEST(Chunks, ALonelyPairFarApartIsPlacedExactly) {
  Particles p;
  p.add({1e9, 0, 0}, 1e-3);
  p.add({-1e9, 0, 0}, 1e-3);
  const ChunkSet set = p.build();
  EXPECT_EQ(set.chunks.size(), 2u);
  expect_sound(p, set);
}

// Tiny spheres at wide spacing: the budget bounds the memory, the error stays far below the spacing.
TEST(Chunks, DustStaysInFullChunks) {
  Particles p;
  add_cluster(p, 640000, {0, 0, 0}, 1000.0, 1e-6);
  const ChunkSet set = p.build();
  EXPECT_LE(set.chunks.size(), 640000u / 64 * 3 / 2 + 4096);
  expect_sound(p, set, 100.0); // in radii of 1e-6: 1e-4, against a spacing of 23
}

TEST(Chunks, CoincidingParticlesAreAllKept) {
  Particles p;
  for (int i = 0; i < 500; ++i) p.add({1, 2, 3}, 0.5);
  const ChunkSet set = p.build();
  EXPECT_EQ(set.chunks.size(), 8u);
  expect_sound(p, set, 1e-12);
}

TEST(Chunks, Float32CoordinatesAreKeptExactly) {
  const GeneratedParticles g = generate_spheres(20000, 5);
  Particles p;
  for (std::size_t i = 0; i < g.radii.size(); ++i)
    p.add({g.positions[3 * i], g.positions[3 * i + 1], g.positions[3 * i + 2]}, g.radii[i]);
  const ChunkSet set = p.build();
  // A coordinate near 0 has finer digits than an offset of up to the chunk's reach (about 8 here) can hold.
  auto coarse = [](const glm::dvec3& c) { return std::min({std::abs(c.x), std::abs(c.y), std::abs(c.z)}) >= 16.0; };
  for (std::uint64_t i = 0; i < set.record_count(); ++i)
    if (set.rows[i] != no_row && coarse(p.centers[set.rows[i]])) {
      ASSERT_EQ(set.center(i), p.centers[set.rows[i]]);
    }
}

TEST(Chunks, TheResultIsTheSameEveryTime) {
  Particles p;
  add_cluster(p, 200000, {0, 0, 0}, 10.0, 0.1);
  const ChunkSet a = p.build(), b = p.build();
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_TRUE(a.records == b.records);
}

TEST(Chunks, MortonOrderIsAPermutationAndKeepsNeighborsTogether) {
  Particles p;
  add_cluster(p, 30000, {0, 0, 0}, 1.0, 0.1);
  std::vector<std::uint32_t> order = morton_order(p.centers);
  double steps = 0.0;
  for (std::size_t i = 1; i < order.size(); ++i) steps += glm::length(p.centers[order[i]] - p.centers[order[i - 1]]);
  EXPECT_LT(steps / 30000, 0.1); // neighbors in random order lie 1.3 apart
  std::sort(order.begin(), order.end());
  for (std::uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
}

TEST(Chunks, DenseClusterInAWideBoxIsSortedWithin) {
  Particles p;
  add_cluster(p, 4096, {0, 0, 0}, 1e-4, 1e-6); // all in one cell of the grid over everything
  p.add({1e3, 1e3, 1e3}, 1e-6);
  const ChunkSet set = p.build();
  expect_sound(p, set);
  std::size_t tight = 0;
  for (const Chunk& chunk : set.chunks) tight += chunk.box_max.x - chunk.box_min.x < 1.2e-4f;
  EXPECT_GT(tight, set.chunks.size() * 3 / 4); // 64 chunks of a cube 2e-4 wide: about a quarter of it each way
}

TEST(Chunks, AMillionSpheresTakeAFractionOfASecond) {
  const GeneratedParticles g = generate_spheres(1000000, 1);
  Particles p;
  for (std::size_t i = 0; i < g.radii.size(); ++i)
    p.add({g.positions[3 * i], g.positions[3 * i + 1], g.positions[3 * i + 2]}, g.radii[i]);
  const ChunkSet set = p.build();
  EXPECT_EQ(set.chunks.size(), 15625u);
}

TEST(Similarity, OnlyRotationsMirrorsAndOneScale) {
  glm::dmat4 m(1.0);
  EXPECT_DOUBLE_EQ(similarity_scale(m).value(), 1.0);
  m = glm::dmat4(2.0);
  m[3] = {5, 6, 7, 1};
  EXPECT_DOUBLE_EQ(similarity_scale(m).value(), 2.0);
  m[0] = -m[0];
  EXPECT_DOUBLE_EQ(similarity_scale(m).value(), 2.0);
  m[1][1] = 2.1;
  EXPECT_FALSE(similarity_scale(m));
  EXPECT_FALSE(similarity_scale(glm::dmat4(0.0)));
}

// What a device on the processor uses as it is.
TEST(Chunks, RecordsStartAtPages) {
  const std::vector<glm::dvec3> centers(1000, glm::dvec3(1));
  const std::vector<double> radii(1000, 1.0);
  const std::vector<std::uint32_t> rows(1000, 0), colors(1000, 0);
  const ChunkSet set = build_spheres(centers, radii, rows, colors);
  for (const void* at : {static_cast<const void*>(set.records.data()), static_cast<const void*>(set.rows.data()), static_cast<const void*>(set.colors.data()),
                         static_cast<const void*>(set.color_indices.data())})
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(at) % page_bytes, 0u);
}

} // namespace
} // namespace mote
