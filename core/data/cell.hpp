// SPDX-License-Identifier: MIT
// Periodic cells, orthogonal or triclinic: shortest distances over all images, positions brought back into
// the cell, and paths put together again by image flags. Values in the file's units. Used by the scene
// (wrap, unwrap, replicas) and by bonds; draws nothing.
#pragma once

#include "core/data/dataset.hpp"

#include <string>

namespace mote::data {

// Has the cell a volume? Flat and empty cells can be drawn, but not wrapped into.
[[nodiscard]] bool has_volume(const Box& box);

// The shortest of d + n1 a + n2 b + n3 c over whole n along the periodic edges. Exact for every cell: the
// image found by rounding is compared with its 26 neighbors, after the edges were reduced (Minkowski,
// in three dimensions by the greedy algorithm of Semaev 2001) where the cell is strongly skewed.
class MinimumImage {
public:
  explicit MinimumImage(const Box& box);
  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& d) const;

private:
  glm::dmat3 edges_{0.0}, inverse_{0.0};
  glm::bvec3 periodic_{false};
};

// Positions into the cell along its periodic edges: fractions in [0, 1). The column `image` (made where it is missing)
// takes what was taken off. Returns what hinders it ("there is no cell"), or nothing.
std::string wrap(Frame& frame);
// Positions plus image flags times edges; the column `image` goes. Returns what hinders it, or nothing.
std::string unwrap(Frame& frame);

} // namespace mote::data
