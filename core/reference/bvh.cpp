// SPDX-License-Identifier: MIT
#include "core/reference/bvh.hpp"

#include "core/base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace mote::reference {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::uint32_t bins = 16;
constexpr std::uint32_t sah_depth = 48; // medians below: 48 + log2(2^32) + 1 levels stay under bvh_max_depth

struct Box {
  std::array<float, 3> lo{infinity, infinity, infinity}, hi{-infinity, -infinity, -infinity};
  void add(const std::array<float, 3>& l, const std::array<float, 3>& h) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], l[k]);
      hi[k] = std::max(hi[k], h[k]);
    }
  }
  void add(const Box& b) { add(b.lo, b.hi); }
  [[nodiscard]] double half_area() const {
    if (!(lo[0] <= hi[0])) return 0.0;
    const double x = double(hi[0]) - lo[0], y = double(hi[1]) - lo[1], z = double(hi[2]) - lo[2];
    return x * y + y * z + z * x;
  }
  [[nodiscard]] std::array<float, 6> flat() const { return {lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]}; }
};

// Twice the center, so that no rounding of a halving matters.
float middle(const BvhItem& item, std::size_t axis) { return item.lo[axis] + item.hi[axis]; }

// Part of the items under construction, and where the child that it becomes is noted.
struct Range {
  std::size_t begin{}, end{};
  std::uint32_t node{}, side{}, depth{};
};

struct Builder {
  std::vector<BvhItem>& items;
  const Collapse& collapse;
  std::vector<BvhNode> nodes{};
  std::vector<std::uint32_t> order{};

  [[nodiscard]] std::span<BvhItem> run(const Range& r) const {
    return {items.data() + r.begin, r.end - r.begin};
  }

  // Where to split: items before the returned place go left. Returns r.end for a run that is to become a
  // leaf.
  std::size_t split(Range& r);
  void leaf(const Range& r);
  // Makes the inner node of a run that is split at `at`; returns its children.
  std::array<Range, 2> inner(const Range& r, std::size_t at);
  // Builds everything under r.
  void grow(const Range& r);
};

std::size_t median(std::span<BvhItem> run, std::size_t axis) {
  const auto half = run.begin() + static_cast<std::ptrdiff_t>(run.size() / 2);
  std::nth_element(run.begin(), half, run.end(), [axis](const BvhItem& a, const BvhItem& b) {
    const float ma = middle(a, axis), mb = middle(b, axis);
    return ma != mb ? ma < mb : a.index < b.index;
  });
  return run.size() / 2;
}

// Binned surface-area split along `axis`, whose doubled centers span [low, low + extent]; 0 when one side
// stays empty.
std::size_t sah_split(std::span<BvhItem> run, std::size_t axis, float low, float extent) {
  std::array<Box, bins> box{};
  std::array<std::size_t, bins> count{};
  const double scale = bins * (1.0 - 1e-6) / double(extent);
  const auto bin_of = [&](const BvhItem& item) {
    const double place = (double(middle(item, axis)) - low) * scale;
    return std::min<std::size_t>(bins - 1, static_cast<std::size_t>(std::max(0.0, place)));
  };
  for (const BvhItem& item : run) {
    const std::size_t b = bin_of(item);
    box[b].add(item.lo, item.hi);
    ++count[b];
  }
  std::array<double, bins> right{};
  Box sum;
  std::size_t n = 0;
  for (std::size_t b = bins - 1; b > 0; --b) {
    sum.add(box[b]);
    n += count[b];
    right[b] = sum.half_area() * double(n);
  }
  sum = {};
  n = 0;
  double best = std::numeric_limits<double>::infinity();
  std::size_t cut = 0;
  for (std::size_t b = 1; b < bins; ++b) {
    sum.add(box[b - 1]);
    n += count[b - 1];
    const double cost = sum.half_area() * double(n) + right[b];
    if (n && n < run.size() && cost < best) {
      best = cost;
      cut = b;
    }
  }
  if (!cut) return 0;
  const auto at = std::partition(run.begin(), run.end(), [&](const BvhItem& i) { return bin_of(i) < cut; });
  return static_cast<std::size_t>(at - run.begin());
}

std::size_t Builder::split(Range& r) {
  if (r.end - r.begin <= bvh_leaf) return r.end;
  std::array<float, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const BvhItem& item : run(r))
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], middle(item, k));
      high[k] = std::max(high[k], middle(item, k));
    }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  const float extent = high[axis] - low[axis];
  if (!(extent > 0.0f) && collapse) {
    r.end = r.begin + collapse(run(r));
    if (r.end - r.begin <= bvh_leaf) return r.end;
  }
  const std::size_t at =
      extent > 0.0f && r.depth < sah_depth ? sah_split(run(r), axis, low[axis], extent) : std::size_t{0};
  return r.begin + (at ? at : median(run(r), axis));
}

void Builder::leaf(const Range& r) {
  nodes[r.node].first[r.side] = static_cast<std::uint32_t>(order.size());
  nodes[r.node].count[r.side] = static_cast<std::uint32_t>(r.end - r.begin);
  for (const BvhItem& item : run(r)) order.push_back(item.index);
}

std::array<Range, 2> Builder::inner(const Range& r, std::size_t at) {
  const auto node = static_cast<std::uint32_t>(nodes.size());
  nodes[r.node].first[r.side] = node;
  nodes.emplace_back();
  const std::array<Range, 2> parts{Range{r.begin, at, node, 0, r.depth + 1},
                                   Range{at, r.end, node, 1, r.depth + 1}};
  for (std::uint32_t side = 0; side < 2; ++side) {
    Box box;
    for (const BvhItem& item : run(parts[side])) box.add(item.lo, item.hi);
    nodes[node].box[side] = box.flat();
  }
  return parts;
}

void Builder::grow(const Range& top) {
  std::vector<Range> todo{top};
  while (!todo.empty()) {
    Range r = todo.back();
    todo.pop_back();
    const std::size_t at = split(r);
    if (at == r.end) {
      leaf(r);
      continue;
    }
    const std::array<Range, 2> parts = inner(r, at);
    todo.push_back(parts[1]);
    todo.push_back(parts[0]);
  }
}

// Appends a tree grown under a root of its own to `main`, as the child `place` of it.
void graft(Builder& main, const Range& place, const Builder& part) {
  // part.nodes[0] only stands for the place in the parent; the others move up by `shift`.
  const auto shift = static_cast<std::uint32_t>(main.nodes.size()) - 1u;
  const auto leaves = static_cast<std::uint32_t>(main.order.size());
  const auto moved = [&](const BvhNode& node, std::uint32_t side) {
    return node.first[side] + (node.count[side] ? leaves : shift);
  };
  main.nodes[place.node].first[place.side] = moved(part.nodes[0], 0);
  main.nodes[place.node].count[place.side] = part.nodes[0].count[0];
  for (std::size_t i = 1; i < part.nodes.size(); ++i) {
    BvhNode node = part.nodes[i];
    for (std::uint32_t side = 0; side < 2; ++side) node.first[side] = moved(node, side);
    main.nodes.push_back(node);
  }
  main.order.insert(main.order.end(), part.order.begin(), part.order.end());
}

} // namespace

BvhItem make_item(const Bounds& bounds, const glm::dvec3& center, std::uint32_t index) {
  BvhItem item;
  item.index = index;
  for (int k = 0; k < 3; ++k) {
    const double lo = bounds.min[k] - center[k], hi = bounds.max[k] - center[k];
    auto& l = item.lo[static_cast<std::size_t>(k)];
    auto& h = item.hi[static_cast<std::size_t>(k)];
    l = static_cast<float>(lo);
    h = static_cast<float>(hi);
    if (double(l) > lo) l = std::nextafter(l, -infinity);
    if (double(h) < hi) h = std::nextafter(h, infinity);
  }
  return item;
}

Bvh build_bvh(std::vector<BvhItem> items, const glm::dvec3& center, const Collapse& collapse,
              unsigned threads) {
  Bvh bvh;
  bvh.center = center;
  if (items.empty()) return bvh;
  Box all;
  for (const BvhItem& item : items) all.add(item.lo, item.hi);
  for (int k = 0; k < 3; ++k) {
    bvh.bounds.min[k] = center[k] + double(all.lo[static_cast<std::size_t>(k)]);
    bvh.bounds.max[k] = center[k] + double(all.hi[static_cast<std::size_t>(k)]);
  }
  Builder main{items, collapse};
  main.nodes.emplace_back();
  main.nodes[0].box = {all.flat(), Box{}.flat()};
  // The top levels here, widest run first, until there are enough runs to share out.
  std::vector<Range> parts{Range{0, items.size(), 0, 0, 1}};
  std::vector<Range> leaves;
  const auto smaller = [](const Range& a, const Range& b) { return a.end - a.begin < b.end - b.begin; };
  while (!parts.empty() && parts.size() < 64) {
    std::pop_heap(parts.begin(), parts.end(), smaller);
    Range r = parts.back();
    parts.pop_back();
    const std::size_t at = main.split(r);
    if (at == r.end) {
      leaves.push_back(r);
      continue;
    }
    for (const Range& half : main.inner(r, at)) {
      parts.push_back(half);
      std::push_heap(parts.begin(), parts.end(), smaller);
    }
  }
  for (const Range& r : leaves) main.leaf(r);
  std::vector<Builder> grown(parts.size(), Builder{items, collapse});
  for_each_block(parts.size(), [&](std::size_t i) {
    grown[i].nodes.emplace_back();
    grown[i].grow(Range{parts[i].begin, parts[i].end, 0, 0, parts[i].depth});
  }, threads);
  for (std::size_t i = 0; i < parts.size(); ++i) graft(main, parts[i], grown[i]);
  bvh.nodes = std::move(main.nodes);
  bvh.order = std::move(main.order);
  return bvh;
}

} // namespace mote::reference
