// SPDX-License-Identifier: MIT
// How the compute expansion cuts a frame into steps and rounds: pure, no device.
//
// Chunks are put in order of depth, front to back. The first step takes the chunks that were seen in the last frame, all
// at once; the others are tested against its depth in a few steps, the nearest first, so that after a camera cut (when
// hardly anything was seen before) the front hides the back all the same. Each step runs in rounds: every chunk reserves
// the entries it could need at most, and rounds are cut where the reservations pass the capacity, so that no buffer can
// overflow whatever the scene.
#pragma once

#include "passes/particles/tiles/tile_blocks.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace mote::passes {

// Entries that a chunk reserves: for each particle the tiles that the largest may cover; at least 4 a particle, which
// bounds the number of chunks of a round (capacity / 256). None for splats. As in cull.comp.
std::uint64_t reserved_entries(const TileChunk& chunk);

struct TileStep {
  std::uint32_t first{}, count{}; // chunks, in depth order
  bool others{};                  // not those that were seen in the last frame
  std::uint32_t rounds{};
  bool operator==(const TileStep&) const = default;
};
struct TilePlan {
  std::uint32_t tiles_x{}, tiles_y{};
  std::uint32_t level1{}, level2{}, level3{}, cells{}; // starts of the coarser levels of depth, and cells of all levels
  std::uint32_t capacity{};      // entries a round may reserve before the next begins
  std::uint32_t most_entries{};  // that a round can hold: capacity and one chunk more
  std::uint32_t list_capacity{}; // chunks of one round
  std::uint32_t tile_room{};     // entries that each tile has places for; what is more goes to a list of most_entries
  float depth_first{}, depth_last{}; // the least and the greatest z_min of the chunks
  std::vector<TileStep> steps{};
  std::uint32_t splats{};        // chunks that are drawn by splats: they reserve nothing
  bool gathered{};               // one step of the others, whose entries join those of the first (work.glsl); each has one round
  [[nodiscard]] std::uint32_t most_rounds() const;
};

// Stable, by z_min in 32 steps: front to back, and within a step the order that chunks had. `order` is scratch that is kept between frames.
void sort_by_depth(std::vector<TileChunk>& chunks, std::vector<TileChunk>& scratch);

// Takes the sides of splats away where fewer than nine in ten chunks have one: both ways in one picture shade it twice.
void choose_splats(std::span<TileChunk> chunks);

// `chunks` in depth order; `most_capacity`: entries that memory allows in a round. `gather`: one round where that is enough.
TilePlan plan_tiles(std::span<const TileChunk> chunks, std::uint32_t width, std::uint32_t height, std::uint32_t most_capacity, bool gather = false);

} // namespace mote::passes
