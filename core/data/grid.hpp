// SPDX-License-Identifier: MIT
// Points of grids that a file states by counts and steps only: image data (origin, spacing, axes) and
// rectilinear grids (three lists of coordinates), x fastest. Grids that carry values in their cells but
// none at their points give the cells' centers instead. Used by the VTK and OVF readers.
#pragma once

#include "core/data/fields.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace mote::data {

struct GridSize {
  std::array<std::uint64_t, 3> nodes{1, 1, 1};
  [[nodiscard]] std::uint64_t points() const { return times(times(nodes[0], nodes[1]), nodes[2]); }
  // A direction with one node has no extent; its cells are flat.
  [[nodiscard]] std::uint64_t cells() const;
  [[nodiscard]] std::string text() const; // "129 x 65 x 65"
};

struct ImageGrid {
  GridSize size{};
  std::array<double, 3> origin{}, spacing{1, 1, 1};
  std::array<double, 9> axes{1, 0, 0, 0, 1, 0, 0, 0, 1}; // rows of a matrix: its columns are the axes
  std::array<std::int64_t, 3> first{};                   // index of the first node
};

// All three check the memory they need (D004) at `loc`. `centers`: of the cells instead of the nodes.
std::vector<double> image_points(const ImageGrid& grid, bool centers, const SourceLoc& loc);
std::vector<double> rectilinear_points(const std::array<std::vector<double>, 3>& axes, bool centers,
                                       const SourceLoc& loc);
// `points` are those of a structured grid: the means of the corners of each cell.
std::vector<double> structured_centers(const GridSize& size, const std::vector<double>& points,
                                       const SourceLoc& loc);

} // namespace mote::data
