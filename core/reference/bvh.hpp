// SPDX-License-Identifier: MIT
// A bounding volume hierarchy over boxes, for the reference tracer: over the particles of a
// ChunkSet and over the instances of a scene. It never sees particles: a leaf is a run of item
// numbers, and what a ray does with them is the caller's business.
//
// Boxes are float32 relative to `center`, rounded outward, so they never lose what lies in them;
// the slab test computes in double. Built with binned surface-area splits (MacDonald and Booth
// 1990; binning: Wald 2007), medians where that finds nothing and below a depth that bounds the stack.
// The tree does not depend on the number of threads.
#pragma once

#include "core/math/camera.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace mote::reference {

struct BvhItem {
  std::array<float, 3> lo{}, hi{}; // relative to the tree's center
  std::uint32_t index{};           // the caller's number
};
BvhItem make_item(const Bounds& bounds, const glm::dvec3& center, std::uint32_t index); // rounds outward

struct BvhNode {
  std::array<std::array<float, 6>, 2> box{}; // of either child: lo.xyz, hi.xyz
  std::array<std::uint32_t, 2> first{};      // an inner child: its node; a leaf: its first place in `order`
  std::array<std::uint32_t, 2> count{};      // 0: an inner child, or (inverted box) no child
};

constexpr std::uint32_t bvh_leaf = 4;       // items of a leaf at most
constexpr std::uint32_t bvh_max_depth = 96; // levels at most

struct Bvh {
  glm::dvec3 center{0};
  Bounds bounds{};                    // of all items, in the space of `center`
  std::vector<BvhNode> nodes{};       // nodes[0] is the root; empty: nothing to hit
  std::vector<std::uint32_t> order{}; // item numbers, leaf by leaf
};

// Called with a run of items whose box centers are all the same place; may reorder it and returns how many
// of the first ones to keep. Runs on several threads at once.
using Collapse = std::function<std::size_t(std::span<BvhItem>)>;

Bvh build_bvh(std::vector<BvhItem> items, const glm::dvec3& center, const Collapse& collapse,
              unsigned threads);

// Visits the leaves whose box, grown by `slack` on all sides, meets the ray o + t d for a t in
// [t_min, limit()], nearer child first; limit() may shrink on the way. leaf(first, count) takes places in
// `order`.
template <class Limit, class Leaf>
void walk(const Bvh& bvh, const glm::dvec3& o, const glm::dvec3& d, double slack, double t_min, Limit&& limit,
          Leaf&& leaf) {
  if (bvh.nodes.empty()) return;
  std::array<double, 3> inverse, at_near,
      at_far; // the two planes of a slab are met at (plane - at) * inverse
  std::array<std::uint32_t, 3> near_side;
  for (int k = 0; k < 3; ++k) {
    inverse[k] = d[k] != 0.0 ? 1.0 / d[k] : 1e300; // a zero component: beyond the slab is 1e300 away
    const double from = o[k] - bvh.center[k];
    near_side[k] = inverse[k] < 0.0 ? 3u : 0u;
    at_near[k] = inverse[k] < 0.0 ? from - slack : from + slack;
    at_far[k] = inverse[k] < 0.0 ? from + slack : from - slack;
  }
  constexpr double miss = std::numeric_limits<double>::infinity();
  const auto enter = [&](const std::array<float, 6>& box, double end) {
    double t0 = t_min, t1 = end;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const double a = (double(box[k + near_side[k]]) - at_near[k]) * inverse[k];
      const double b = (double(box[k + 3 - near_side[k]]) - at_far[k]) * inverse[k];
      t0 = a > t0 ? a : t0;
      t1 = b < t1 ? b : t1;
    }
    return t0 <= t1 * (1.0 + 1e-15) ? t0 : miss;
  };
  std::array<std::pair<std::uint32_t, double>, bvh_max_depth + 2> stack;
  std::size_t depth = 0;
  stack[depth++] = {0u, t_min};
  while (depth) {
    const auto [index, entry] = stack[--depth];
    if (entry > limit()) continue;
    const BvhNode& node = bvh.nodes[index];
    const double t[2] = {enter(node.box[0], limit()), enter(node.box[1], limit())};
    const int nearer = t[1] < t[0] ? 1 : 0;
    for (const int side : {nearer, 1 - nearer})
      if (node.count[side] && t[side] < miss && t[side] <= limit()) leaf(node.first[side], node.count[side]);
    for (const int side : {1 - nearer, nearer})
      if (!node.count[side] && t[side] < miss) stack[depth++] = {node.first[side], t[side]};
  }
}

} // namespace mote::reference
