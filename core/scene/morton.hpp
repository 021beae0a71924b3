// SPDX-License-Identifier: MIT
// The order that makes neighbors in space neighbors in memory: Morton's curve through a grid of 1024^3
// cells over the box of the points, refined inside cells that hold many points, so that it stays good
// for clusters that lie far apart. Chunks and the neighbor search are runs of this order.
// The result depends on the points alone, not on the number of threads.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace mote {

// Indices of `points` in Morton order (a permutation of 0..n-1; points in one cell keep their order).
// Points must be finite and below 1e150 in magnitude; n < 2^32.
std::vector<std::uint32_t> morton_order(std::span<const glm::dvec3> points);

} // namespace mote
