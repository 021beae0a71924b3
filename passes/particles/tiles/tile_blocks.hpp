// SPDX-License-Identifier: MIT
// Blocks that the kernels of the compute expansion read; mirrors shaders/particles/tiles/work.glsl.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace mote::passes {

constexpr std::uint32_t tile_size = 8; // pixels

// Push constants of every kernel.
struct StepBlock {
  std::uint32_t first{}, count{}, others{}, region{}, round{}, slice{}, slices{}, capacity{}, list_capacity{};
  std::uint32_t tiles_x{}, tiles_y{}, level1{}, level2{}, level3{}, width{}, height{}, tile_room{}, spilled{};
  float depth_origin{}, depth_scale{};
  glm::vec4 material{}, background{};
  std::uint32_t place_first{};
};
static_assert(sizeof(StepBlock) == 116);

// With analytic edges, pixels: how far from its center a pixel is met, with what rounding needs (seen.glsl), and the margin of placing.
constexpr float pixel_reach = 0.52f;
constexpr double edge_margin = 0.55;

// A corner of a rectangle of tiles: x in bits 0..11, y in 12..23; and tiles of one particle above them.
inline std::uint32_t pack_corner(glm::uvec2 tile, std::uint32_t most) { return tile.x | tile.y << 12 | (most < 255 ? most : 255u) << 24; }
inline glm::uvec2 corner(std::uint32_t packed) { return {packed & 0xFFFu, (packed >> 12) & 0xFFFu}; }

// A chunk of one instance that the view may see: where it is, the tiles it may cover (corners, inclusive), and how many
// tiles one of its particles may cover at most in x (in rect_lo) and y (in rect_hi); 255 and more: all of its rectangle's.
// With `side` it is drawn by splats: no particle of it covers more pixel centers than that in x or in y.
struct TileChunk {
  glm::vec3 origin{};
  float z_min{};
  std::uint32_t rect_lo{}, rect_hi{}, chunk{};
  std::uint32_t draw : 30 {}, side : 2 {};
};
constexpr std::uint32_t splat_sides = 3; // 1, 2, 3 pixels
static_assert(sizeof(TileChunk) == 32);

// One for each (batch, instance, slice).
struct TileDraw {
  glm::vec3 linear0{};
  float scale{};
  glm::vec3 linear1{};
  std::uint32_t id_base{};
  glm::vec3 linear2{};
  std::uint32_t first_flag{};
  glm::vec3 color{};
  std::uint32_t material : 16 {}, slice : 15 {}, colored : 1 {};
};
static_assert(sizeof(TileDraw) == 64);

} // namespace mote::passes
