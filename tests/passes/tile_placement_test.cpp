// SPDX-License-Identifier: MIT
// The tiles that chunks are given, against the rays of every pixel in double precision: no pixel that shows a particle
// lies in a tile that its chunk does not have, and no particle covers more tiles than its chunk says.
#include "passes/particles/tiles/tile_placement.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

using namespace mote;
using namespace mote::passes;

namespace {

// Tiles of the pixels whose rays hit a sphere in view space in front of the eye; lo.x > hi.x: none.
struct Tiles {
  glm::uvec2 lo{1u << 30}, hi{0};
  glm::uvec2 first{1u << 30}, last{0}; // pixels
};
Tiles tiles_of(const View& view, const glm::dvec3& center, double radius) {
  Tiles tiles;
  for (std::uint32_t y = 0; y < view.size.height; ++y)
    for (std::uint32_t x = 0; x < view.size.width; ++x) {
      const glm::dvec3 o = view.ray_origin(x, y) - center, d = view.ray_direction(x, y);
      const double a = glm::dot(d, d), b = glm::dot(o, d), disc = b * b - a * (glm::dot(o, o) - radius * radius);
      if (disc < 0 || (-b + std::sqrt(disc)) / a <= view.near_cut) continue;
      const glm::uvec2 tile(x / tile_size, y / tile_size);
      tiles.lo = glm::min(tiles.lo, tile);
      tiles.hi = glm::max(tiles.hi, tile);
      tiles.first = glm::min(tiles.first, {x, y});
      tiles.last = glm::max(tiles.last, {x, y});
    }
  return tiles;
}

struct Counts {
  int tiled{}, near{}, rest{}, hits{};
  std::array<int, 4> sides{}; // particles, by the side of their chunk, if it is for splats
};

void expect_inside(const TileChunk& chunk, const Tiles& tiles, Counts& counts) {
  if (tiles.lo.x > tiles.hi.x) return;
  ++counts.hits;
  const glm::uvec2 lo = corner(chunk.rect_lo), hi = corner(chunk.rect_hi), span = tiles.hi - tiles.lo + 1u;
  ASSERT_TRUE(lo.x <= tiles.lo.x && lo.y <= tiles.lo.y && hi.x >= tiles.hi.x && hi.y >= tiles.hi.y);
  const std::uint32_t x = chunk.rect_lo >> 24, y = chunk.rect_hi >> 24;
  ASSERT_TRUE(x == 255 || span.x <= x) << span.x << " tiles in x, at most " << x;
  ASSERT_TRUE(y == 255 || span.y <= y) << span.y << " tiles in y, at most " << y;
  const glm::uvec2 pixels = tiles.last - tiles.first + 1u;
  ++counts.sides[chunk.side];
  ASSERT_TRUE(chunk.side == 0 || std::max(pixels.x, pixels.y) <= chunk.side) << pixels.x << " x " << pixels.y << " pixels, side " << chunk.side;
}

void check_view(const ChunkSet& set, const Instance& instance, const View& view, Counts& counts, bool splats = false) {
  PlacedForTiles out;
  place_for_tiles(set, 0, 0, set.chunks.size(), instance, view, ViewCuller(view), {.draw = 5, .splats = splats}, out);
  std::vector<int> placed(set.chunks.size());
  const double scale = similarity_scale(instance.world_from_data).value();
  for (const TileChunk& chunk : out.tiled) {
    EXPECT_EQ(chunk.draw, 5u);
    ++placed[chunk.chunk];
    ++counts.tiled;
    for (std::uint64_t record = chunk.chunk * chunk_capacity; record < (chunk.chunk + 1) * chunk_capacity; ++record) {
      if (set.rows[record] == no_row) continue;
      const glm::dvec3 center = view.to_view(glm::dvec3(instance.world_from_data * glm::dvec4(set.center(record), 1.0)));
      const double radius = scale * double{set.records[record].w};
      EXPECT_GE((center.z - radius) * (1 + 1e-6), double{chunk.z_min});
      expect_inside(chunk, tiles_of(view, center, radius), counts);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  for (const TileChunk& chunk : out.near) {
    ++counts.near;
    for (std::uint64_t record = chunk.chunk * chunk_capacity; record < (chunk.chunk + 1) * chunk_capacity; ++record) {
      const glm::dvec4 particle(out.near_records[record]);
      if (out.near_rows[record] != no_row) expect_inside(chunk, tiles_of(view, glm::dvec3(particle), particle.w), counts);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  counts.rest += static_cast<int>(out.rest.far.size() + out.rest.near.size());
  for (std::size_t c = 0; c < placed.size(); ++c) ASSERT_LE(placed[c], 1) << "chunk " << c << " twice";
}

TEST(TilePlacement, RectanglesHoldEveryPixelOfTheirParticles) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-1, 1);
  Counts counts;
  for (int i = 0; i < 360 && !HasFatalFailure(); ++i) {
    std::vector<glm::dvec3> centers;
    std::vector<double> radii;
    std::vector<std::uint32_t> rows;
    const double size = std::pow(10.0, u(random));
    const std::uint32_t count = i < 60 ? 150 : 1; // alone, a particle's box is as tight as can be
    for (std::uint32_t k = 0; k < count; ++k) {
      centers.push_back(glm::dvec3(u(random), u(random), u(random)) * 10.0 + 1e4 * double(i % 4));
      radii.push_back(size * (0.2 + 0.15 * u(random)));
      rows.push_back(k);
    }
    const ChunkSet set = build_spheres(centers, radii, rows, {});
    Camera camera;
    camera.projection = i % 3 ? Projection::Perspective : Projection::Orthographic;
    camera.target = glm::dvec3(1e4 * double(i % 4)) + glm::dvec3(u(random), u(random), u(random)) * 6.0;
    camera.eye = camera.target + glm::dvec3(u(random), u(random), u(random)) * (i % 5 ? 60.0 : 12.0);
    camera.up = {0, 1, 0};
    camera.fov_y = 20.0 + 50.0 * std::abs(u(random));
    camera.height = 5.0 + 20.0 * std::abs(u(random));
    View view = make_view(camera, {61, 43}, 30.0);
    view.sample_offset = {0.5 + 0.4 * u(random), 0.5 + 0.4 * u(random)};
    check_view(set, {}, view, counts);
  }
  EXPECT_GT(counts.tiled, 60);
  EXPECT_GT(counts.near, 3);
  EXPECT_GT(counts.rest, 3);
  EXPECT_GT(counts.hits, 2000);
}

// Spheres of 0.05 to 3 pixels: none covers more pixel centers than the side of its chunk says.
TEST(TilePlacement, SidesOfSplatsHoldEveryPixelOfTheirParticles) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> u(-1, 1);
  Counts counts;
  for (int i = 0; i < 300 && !HasFatalFailure(); ++i) {
    Camera camera;
    camera.projection = i % 3 ? Projection::Perspective : Projection::Orthographic;
    camera.eye = glm::normalize(glm::dvec3(u(random), u(random), u(random))) * 60.0;
    camera.target = {0, 0, 0};
    camera.up = {0.1, 1, 0.2};
    camera.fov_y = 20.0 + 60.0 * std::abs(u(random));
    camera.height = 20.0;
    View view = make_view(camera, {61, 43}, 30.0);
    view.sample_offset = {0.5 + 0.4 * u(random), 0.5 + 0.4 * u(random)};
    const double pixel = 60.0 / view.focal * (camera.projection == Projection::Perspective ? 1.0 : 1.0 / 60.0);
    std::vector<glm::dvec3> centers;
    std::vector<double> radii;
    std::vector<std::uint32_t> rows;
    const double radius = pixel * std::pow(10.0, -0.4 + 0.9 * u(random));
    for (std::uint32_t k = 0; k < 40; ++k) {
      centers.push_back(glm::dvec3(u(random), u(random), u(random)) * 8.0);
      radii.push_back(radius);
      rows.push_back(k);
    }
    check_view(build_spheres(centers, radii, rows, {}), {}, view, counts, true);
  }
  for (const int count : counts.sides) EXPECT_GT(count, 100);
}

// A chunk across the far cut has to be cut, which tiles do not, unless what lies beyond does not matter.
TEST(TilePlacement, ChunksAcrossTheFarCut) {
  const ChunkSet set = build_spheres(std::vector<glm::dvec3>{{0, 0, -2}, {0, 0, 2}}, std::vector<double>{0.5, 0.5}, std::vector<std::uint32_t>{0, 1}, {});
  Camera camera;
  camera.projection = Projection::Orthographic;
  camera.eye = {0, 0, 60};
  camera.up = {0, 1, 0};
  camera.height = 10.0;
  View view = make_view(camera, {61, 43}, 30.0);
  const double first = view.to_view({0, 0, 2}).z - 0.5, last = view.to_view({0, 0, -2}).z + 0.5;
  const auto tiled = [&](double far_cut, bool whole) {
    view.far_cut = far_cut;
    PlacedForTiles out;
    place_for_tiles(set, 0, 0, set.chunks.size(), {}, view, ViewCuller(view), {.whole = whole}, out);
    EXPECT_EQ(out.tiled.size() + out.rest.far.size() + out.rest.near.size(), far_cut > first ? 1u : 0u);
    return out.tiled.size();
  };
  EXPECT_EQ(tiled(last + 0.5, false), 1u);
  EXPECT_EQ(tiled(0.5 * (first + last), false), 0u);
  EXPECT_EQ(tiled(0.5 * (first + last), true), 1u);
  EXPECT_EQ(tiled(first - 0.5, true), 0u) << "all of it lies beyond";
}

} // namespace
