// SPDX-License-Identifier: MIT
#include "core/data/neighbors.hpp"

#include "core/base/parallel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <vector>

namespace mote::data {
namespace {

constexpr std::uint64_t exact_particles = 65536;
constexpr std::uint64_t sample_places = 32768;
constexpr std::uint64_t sample_queries = 1024;
constexpr double infinite = std::numeric_limits<double>::infinity();

using Point = std::array<double, 3>;

bool is_finite(const Point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

double distance_squared(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

// A k-d tree in an array: the middle of each range splits it along the range's longest side.
class Tree {
public:
  explicit Tree(std::vector<Point> points) : points_(std::move(points)), axes_(points_.size()) {
    build(0, points_.size());
  }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  // The squared distance from `from` to the nearest point that is not at the same place.
  [[nodiscard]] double nearest(const Point& from) const {
    double best = infinite;
    search(0, points_.size(), from, best);
    return best;
  }

private:
  void build(std::size_t begin, std::size_t end) {
    if (end - begin < 2) return;
    Point low = points_[begin], high = low;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], points_[i][k]);
        high[k] = std::max(high[k], points_[i][k]);
      }
    std::uint8_t axis = 0;
    for (std::uint8_t k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [this](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [axis](const Point& a, const Point& b) { return a[axis] < b[axis]; });
    axes_[middle] = axis;
    build(begin, middle);
    build(middle + 1, end);
  }
  void search(std::size_t begin, std::size_t end, const Point& from, double& best) const {
    if (begin >= end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const double squared = distance_squared(from, points_[middle]);
    if (squared > 0 && squared < best) best = squared;
    if (end - begin == 1) return;
    const std::uint8_t axis = axes_[middle];
    const double side = from[axis] - points_[middle][axis];
    const bool left = side < 0;
    search(left ? begin : middle + 1, left ? middle : end, from, best);
    if (side * side < best) search(left ? middle + 1 : begin, left ? end : middle, from, best);
  }
  std::vector<Point> points_;
  std::vector<std::uint8_t> axes_;
};

std::vector<Point> distinct(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

double median(std::vector<double> squared) {
  const auto middle = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
  std::nth_element(squared.begin(), middle, squared.end());
  return std::sqrt(*middle);
}

// Balls around the query points, found by any point that lies in them. A ball of radius r is entered
// into the (at most eight) cells that it touches of a grid whose cells are as wide as the power of two
// at or above 2 r; a point looks into its one cell of each grid that is in use.
class Balls {
public:
  Balls(const std::vector<Point>& centers, const std::vector<double>& squared, const Point& origin)
      : centers_(centers), origin_(origin) {
    std::map<int, std::uint64_t> levels;
    for (const double s : squared) levels.try_emplace(level_of(s), 0);
    for (auto& [level, number] : levels) {
      number = widths_.size();
      widths_.push_back(std::ldexp(1.0, -level));
    }
    std::vector<std::pair<std::uint64_t, std::uint32_t>> entries;
    for (std::uint32_t q = 0; q < centers.size(); ++q)
      enter(q, std::sqrt(squared[q]), levels.at(level_of(squared[q])), entries);
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    fill(entries);
  }

  // Lowers best[q] for every ball q that `p` may lie in.
  void meet(const Point& p, std::vector<double>& best) const {
    for (std::uint64_t g = 0; g < widths_.size(); ++g) {
      const std::uint64_t key = key_of(g, cell(p[0], 0, g), cell(p[1], 1, g), cell(p[2], 2, g));
      if (!may_be_known(key)) continue;
      for (std::uint64_t slot = key & mask_; slots_[slot].end != 0; slot = (slot + 1) & mask_) {
        if (slots_[slot].key != key) continue;
        for (std::uint32_t i = slots_[slot].begin; i < slots_[slot].end; ++i) {
          const double squared = distance_squared(p, centers_[members_[i]]);
          if (squared > 0 && squared < best[members_[i]]) best[members_[i]] = squared;
        }
        break;
      }
    }
  }

private:
  struct Slot {
    std::uint64_t key{};
    std::uint32_t begin{}, end{}; // of members_; end 0: free
  };

  static int level_of(double squared) { return std::ilogb(2.0 * std::sqrt(squared)) + 1; }
  std::int64_t cell(double value, std::size_t axis, std::uint64_t grid) const {
    const double scaled = std::clamp((value - origin_[axis]) * widths_[grid], -4e18, 4e18);
    const auto down = static_cast<std::int64_t>(scaled);
    return down - (static_cast<double>(down) > scaled ? 1 : 0);
  }
  static std::uint64_t key_of(std::uint64_t grid, std::int64_t x, std::int64_t y, std::int64_t z) {
    const std::uint64_t sum = (grid + 1) * 0x9e3779b97f4a7c15u +
                              static_cast<std::uint64_t>(x) * 0xc2b2ae3d27d4eb4fu +
                              static_cast<std::uint64_t>(y) * 0x165667b19e3779f9u +
                              static_cast<std::uint64_t>(z) * 0xd6e8feb86659fd93u;
    return (sum ^ (sum >> 32)) * 0x9e3779b97f4a7c15u;
  }
  // Most points lie in no ball: one bit of a table that fits the first cache tells.
  static std::size_t bit_of(std::uint64_t key) { return key >> (64 - filter_bits); }
  [[nodiscard]] bool may_be_known(std::uint64_t key) const {
    return (filter_[bit_of(key) / 64] >> (bit_of(key) % 64)) & 1;
  }
  void enter(std::uint32_t q, double radius, std::uint64_t grid,
             std::vector<std::pair<std::uint64_t, std::uint32_t>>& entries) const {
    std::array<std::int64_t, 3> low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = cell(centers_[q][k] - radius, k, grid);
      high[k] = cell(centers_[q][k] + radius, k, grid);
    }
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) entries.emplace_back(key_of(grid, x, y, z), q);
  }
  void fill(const std::vector<std::pair<std::uint64_t, std::uint32_t>>& entries) {
    slots_.resize(std::bit_ceil(2 * entries.size() + 2));
    mask_ = slots_.size() - 1;
    for (std::size_t i = 0; i < entries.size();) {
      const std::uint64_t key = entries[i].first;
      filter_[bit_of(key) / 64] |= std::uint64_t{1} << (bit_of(key) % 64);
      Slot filled{key, static_cast<std::uint32_t>(i), 0};
      for (; i < entries.size() && entries[i].first == key; ++i) members_.push_back(entries[i].second);
      filled.end = static_cast<std::uint32_t>(i);
      std::uint64_t slot = key & mask_;
      while (slots_[slot].end != 0) slot = (slot + 1) & mask_;
      slots_[slot] = filled;
    }
  }

  const std::vector<Point>& centers_;
  Point origin_;
  std::vector<double> widths_{}; // 1 / width of the cells of each grid
  std::vector<Slot> slots_{};
  std::vector<std::uint32_t> members_{};
  static constexpr int filter_bits = 18;
  std::vector<std::uint64_t> filter_ = std::vector<std::uint64_t>(std::size_t{1} << (filter_bits - 6));
  std::uint64_t mask_{};
};

// Every `step`-th finite point, `wanted` of them in all.
std::vector<Point> spread(std::span<const double> positions, std::uint64_t wanted) {
  std::vector<Point> out;
  const std::uint64_t count = positions.size() / 3;
  for (std::uint64_t i = 0; i < std::min(count, wanted); ++i) {
    const std::uint64_t at =
        count <= wanted ? i
                        : static_cast<std::uint64_t>(static_cast<double>(i) * (static_cast<double>(count) /
                                                                               static_cast<double>(wanted)));
    const Point p{positions[3 * at], positions[3 * at + 1], positions[3 * at + 2]};
    if (is_finite(p)) out.push_back(p);
  }
  return out;
}

} // namespace

std::optional<double> median_neighbor_distance(std::span<const double> positions) {
  const std::uint64_t count = positions.size() / 3;
  const bool exact = count <= exact_particles;
  const Tree tree(distinct(spread(positions, exact ? count : sample_places)));
  const std::vector<Point>& places = tree.points();
  if (places.size() < 2) return std::nullopt;
  std::vector<Point> queries;
  const std::uint64_t wanted = exact ? places.size() : std::min<std::uint64_t>(sample_queries, places.size());
  for (std::uint64_t i = 0; i < wanted; ++i) queries.push_back(places[i * places.size() / wanted]);
  std::vector<double> best(queries.size());
  constexpr std::size_t per_block = 1024;
  for_each_block((queries.size() + per_block - 1) / per_block, [&](std::size_t block) {
    for (std::size_t q = block * per_block; q < std::min(queries.size(), (block + 1) * per_block); ++q)
      best[q] = tree.nearest(queries[q]);
  });
  for (std::size_t q = best.size(); q-- > 0;) // distances whose square is beyond the range of double
    if (!std::isfinite(best[q])) {
      best.erase(best.begin() + static_cast<std::ptrdiff_t>(q));
      queries.erase(queries.begin() + static_cast<std::ptrdiff_t>(q));
    }
  if (best.empty()) return std::nullopt;
  if (exact) return median(std::move(best));
  const Balls balls(queries, best, places.front());
  std::mutex guard;
  constexpr std::uint64_t rows_per_block = 1 << 16;
  const std::vector<double> bound = best;
  for_each_block((count + rows_per_block - 1) / rows_per_block, [&](std::size_t block) {
    std::vector<double> nearer = bound;
    for (std::uint64_t i = block * rows_per_block;
         i < std::min<std::uint64_t>(count, (block + 1) * rows_per_block); ++i) {
      const Point p{positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
      if (is_finite(p)) balls.meet(p, nearer);
    }
    const std::scoped_lock lock(guard);
    for (std::size_t q = 0; q < best.size(); ++q) best[q] = std::min(best[q], nearer[q]);
  });
  return median(std::move(best));
}

} // namespace mote::data
