// SPDX-License-Identifier: MIT
#include "core/data/grid.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::data {
namespace {

std::array<std::uint64_t, 3> cell_counts(const std::array<std::uint64_t, 3>& nodes) {
  std::array<std::uint64_t, 3> out{};
  for (std::size_t a = 0; a < 3; ++a) out[a] = nodes[a] > 1 ? nodes[a] - 1 : nodes[a];
  return out;
}

void check(const GridSize& size, const SourceLoc& loc) {
  need_memory(times(size.points(), 3 * sizeof(double)), loc, fmt::format("the {} points", size.text()));
}

} // namespace

std::uint64_t GridSize::cells() const {
  const auto n = cell_counts(nodes);
  return times(times(n[0], n[1]), n[2]);
}
std::string GridSize::text() const { return fmt::format("{} x {} x {}", nodes[0], nodes[1], nodes[2]); }

std::vector<double> image_points(const ImageGrid& grid, bool centers, const SourceLoc& loc) {
  check(grid.size, loc);
  const auto n = centers ? cell_counts(grid.size.nodes) : grid.size.nodes;
  std::array<double, 3> shift{};
  for (std::size_t a = 0; a < 3; ++a)
    shift[a] = static_cast<double>(grid.first[a]) + (centers && grid.size.nodes[a] > 1 ? 0.5 : 0.0);
  std::vector<double> out;
  out.reserve(n[0] * n[1] * n[2] * 3);
  const auto& m = grid.axes;
  for (std::uint64_t k = 0; k < n[2]; ++k)
    for (std::uint64_t j = 0; j < n[1]; ++j)
      for (std::uint64_t i = 0; i < n[0]; ++i) {
        const std::array<double, 3> step{(static_cast<double>(i) + shift[0]) * grid.spacing[0],
                                         (static_cast<double>(j) + shift[1]) * grid.spacing[1],
                                         (static_cast<double>(k) + shift[2]) * grid.spacing[2]};
        for (std::size_t a = 0; a < 3; ++a)
          out.push_back(grid.origin[a] +
                        (m[3 * a] * step[0] + m[3 * a + 1] * step[1] + m[3 * a + 2] * step[2]));
      }
  return out;
}

std::vector<double> rectilinear_points(const std::array<std::vector<double>, 3>& axes, bool centers,
                                       const SourceLoc& loc) {
  std::array<std::vector<double>, 3> at = axes;
  GridSize size;
  for (std::size_t a = 0; a < 3; ++a) size.nodes[a] = axes[a].size();
  check(size, loc);
  if (centers)
    for (std::vector<double>& line : at) {
      if (line.size() < 2) continue;
      for (std::size_t i = 0; i + 1 < line.size(); ++i) line[i] = 0.5 * (line[i] + line[i + 1]);
      line.pop_back();
    }
  std::vector<double> out;
  out.reserve(at[0].size() * at[1].size() * at[2].size() * 3);
  for (const double z : at[2])
    for (const double y : at[1])
      for (const double x : at[0]) out.insert(out.end(), {x, y, z});
  return out;
}

std::vector<double> structured_centers(const GridSize& size, const std::vector<double>& points,
                                       const SourceLoc& loc) {
  check(size, loc);
  const auto n = cell_counts(size.nodes);
  std::array<std::uint64_t, 3> last{}; // how far the opposite corner lies
  for (std::size_t a = 0; a < 3; ++a) last[a] = size.nodes[a] > 1 ? 1 : 0;
  std::vector<double> out;
  out.reserve(n[0] * n[1] * n[2] * 3);
  for (std::uint64_t k = 0; k < n[2]; ++k)
    for (std::uint64_t j = 0; j < n[1]; ++j)
      for (std::uint64_t i = 0; i < n[0]; ++i)
        for (std::size_t a = 0; a < 3; ++a) {
          double sum = 0;
          for (std::uint64_t corner = 0; corner < 8; ++corner) {
            const std::uint64_t x = i + (corner & 1) * last[0], y = j + (corner >> 1 & 1) * last[1],
                                z = k + (corner >> 2) * last[2];
            sum += points[3 * (x + size.nodes[0] * (y + size.nodes[1] * z)) + a];
          }
          out.push_back(sum / 8);
        }
  return out;
}

} // namespace mote::data
