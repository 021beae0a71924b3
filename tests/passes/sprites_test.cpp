// SPDX-License-Identifier: MIT
// Which chunks the point expansion draws as sprites: none of the three faults of points can happen to their
// particles, checked particle by particle; and most chunks of an ordinary view are sprites.
#include "core/scene/generated.hpp"
#include "passes/particles/sprites.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

using namespace mote;
using namespace mote::passes;

namespace {

struct Counts {
  std::size_t sprites{}, rest{};
};

ChunkSet cloud(std::size_t n, double half, double r_max) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<glm::dvec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < n; ++i) {
    centers.emplace_back(half * u(random), half * u(random), half * u(random));
    radii.push_back(r_max * (0.55 + 0.45 * u(random)));
  }
  std::vector<std::uint32_t> rows(n);
  std::iota(rows.begin(), rows.end(), 0u);
  return build_spheres(centers, radii, rows, {});
}

// The rectangle of every particle of a sprite chunk, sampled from its surface, is inside of the image by its center and
// not larger than the point.
Counts check(const ChunkSet& set, const View& view, double largest) {
  PlacedChunks placed;
  const SpriteRule rule(view, largest);
  place_chunks(set, 0, set.chunks.size(), {}, view, ViewCuller(view), placed, &rule);
  const bool perspective = view.projection == Projection::Perspective;
  for (const PlacedChunk& chunk : placed.sprites)
    for (std::uint64_t i = chunk.bits.w * chunk_capacity; i < chunk.bits.w * chunk_capacity + set.chunks[chunk.bits.w].count; ++i) {
      const glm::dvec3 c = view.to_view(set.center(i));
      const double r = set.records[i].w;
      glm::dvec2 lo(1e300), hi(-1e300);
      for (int a = 0; a < 32; ++a)
        for (int b = 0; b <= 16; ++b) {
          const double u = a * 0.19634954, v = b * 0.19634954;
          const glm::dvec3 p = c + r * glm::dvec3(std::cos(u) * std::sin(v), std::sin(u) * std::sin(v), std::cos(v));
          EXPECT_GT(p.z, 0.0);
          const glm::dvec2 pixel = glm::dvec2(p) / (perspective ? p.z : 1.0) * view.focal + 0.5 * glm::dvec2(view.size.width, view.size.height);
          lo = glm::min(lo, pixel);
          hi = glm::max(hi, pixel);
        }
      const glm::dvec2 center = 0.5 * (lo + hi);
      EXPECT_TRUE(center.x > 0 && center.x < view.size.width && center.y > 0 && center.y < view.size.height);
      EXPECT_LT(std::max(hi.x - lo.x, hi.y - lo.y) + 1.0, largest);
    }
  return {placed.sprites.size(), placed.far.size() + placed.near.size()};
}

View view_from(glm::dvec3 eye, double fov, Projection projection = Projection::Perspective) {
  Camera camera;
  camera.projection = projection;
  camera.eye = eye;
  camera.target = {0, 0, 0};
  camera.up = {0, 1, 0};
  camera.fov_y = fov;
  camera.height = 24;
  return make_view(camera, {640, 360}, 40.0);
}

TEST(Sprites, NoFaultOfPointsCanHappenToThem) {
  const ChunkSet set = cloud(5000, 10, 0.8);
  for (const double largest : {255.0, 64.0, 16.0})
    for (const double fov : {30.0, 60.0, 110.0})
      for (const glm::dvec3 eye : {glm::dvec3(9, 12, 40), glm::dvec3(2, 3, 14), glm::dvec3(1, 2, 3)}) check(set, view_from(eye, fov), largest);
  check(set, view_from({9, 12, 40}, 30, Projection::Orthographic), 64);
}

TEST(Sprites, MostChunksOfAnOrdinaryViewAreSprites) {
  const ChunkSet set = cloud(20000, 10, 0.3);
  const Counts counts = check(set, view_from({12, 16, 50}, 30), 255);
  EXPECT_GT(counts.sprites, 4 * counts.rest);
  EXPECT_EQ(check(set, view_from({12, 16, 50}, 30), 2.0).sprites, 0u) << "a device with small points has none";
}

} // namespace
