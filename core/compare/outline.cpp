// SPDX-License-Identifier: MIT
#include "core/compare/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mote::compare {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int farthest = 16; // pixels that an element is looked for; beyond them it counts as lost

using Shown = std::span<const std::uint32_t>;

class Elements {
public:
  Elements(Shown shown, std::uint32_t width, std::uint32_t height) : shown_(shown), width_(static_cast<int>(width)), height_(static_cast<int>(height)) {}

  // Calls fn(x, y, down) for each: between pixel (x, y) and its right neighbor, or the one below.
  template <class Fn> void each(const Fn& fn) const {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        if (is(x, y, false)) fn(x, y, false);
        if (is(x, y, true)) fn(x, y, true);
      }
  }
  // Distance from that place to the nearest element here between the same two things; infinite if there is none near.
  [[nodiscard]] double distance(int x, int y, bool down, std::uint32_t first, std::uint32_t second) const {
    if (separates(x, y, down, first, second)) return 0.0;
    double best = infinity;
    for (int reach = 1; reach <= farthest && best > reach - 1.0; ++reach) // rings; nothing nearer comes once a ring is beyond
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; dx += std::abs(dy) == reach ? 1 : 2 * reach)
          for (const bool other : {false, true}) {
            if (!separates(x + dx, y + dy, other, first, second)) continue;
            const double turn = down == other ? 0.0 : 0.5; // between the middles of the two kinds of pairs
            best = std::min(best, std::hypot(dx + (down ? turn : -turn), dy + (down ? -turn : turn)));
          }
    if (separates(x, y, !down, first, second)) best = std::min(best, std::sqrt(0.5));
    return best;
  }

private:
  [[nodiscard]] std::uint32_t at(int x, int y) const { return shown_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)]; }
  [[nodiscard]] bool within(int x, int y, bool down) const { return x >= 0 && y >= 0 && x + (down ? 0 : 1) < width_ && y + (down ? 1 : 0) < height_; }
  [[nodiscard]] std::uint32_t neighbor(int x, int y, bool down) const { return down ? at(x, y + 1) : at(x + 1, y); }
  [[nodiscard]] bool is(int x, int y, bool down) const { return within(x, y, down) && at(x, y) != neighbor(x, y, down); }
  [[nodiscard]] bool separates(int x, int y, bool down, std::uint32_t first, std::uint32_t second) const {
    if (!within(x, y, down)) return false;
    const std::uint32_t p = at(x, y), q = neighbor(x, y, down);
    return (p == first && q == second) || (p == second && q == first);
  }

  Shown shown_;
  int width_, height_;
};

// Adds the displacement of each element of `from`, looked for in `to`.
void add_displacements(Shown from, Shown to, std::uint32_t width, std::uint32_t height, std::vector<double>& out) {
  const Elements there(to, width, height);
  Elements(from, width, height).each([&](int x, int y, bool down) {
    const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
    out.push_back(there.distance(x, y, down, from[i], from[i + (down ? width : 1u)]));
  });
}

double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = std::max<std::size_t>(static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))), 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

} // namespace

OutlineDifference compare_outlines(Shown a, Shown b, std::uint32_t width, std::uint32_t height) {
  OutlineDifference d;
  for (std::size_t i = 0; i < b.size(); ++i) d.disagreeing += a[i] != b[i] ? 1 : 0;
  std::uint64_t pairs = 0;
  Elements(b, width, height).each([&](int, int, bool) { ++pairs; });
  d.length = static_cast<double>(pairs) * (3.14159265358979323846 / 4.0);
  if (d.disagreeing == 0) return d;
  d.displacement = pairs ? static_cast<double>(d.disagreeing) / d.length : infinity;
  std::vector<double> displacements;
  add_displacements(b, a, width, height, displacements);
  add_displacements(a, b, width, height, displacements);
  d.p999 = percentile(displacements, 0.999);
  return d;
}

} // namespace mote::compare
