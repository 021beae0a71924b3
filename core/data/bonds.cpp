// SPDX-License-Identifier: MIT
#include "core/data/bonds.hpp"

#include "core/data/cell.hpp"
#include "core/data/elements.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::data {
namespace {

// Atoms in a grid of cells over the periodic cell, or over their bounding box where there is none.
class Grid {
public:
  Grid(const Frame& frame, const std::vector<glm::dvec3>& places, double width) : box_(cell_of(frame, places)) {
    const glm::dmat3 inverse = glm::inverse(box_.edges);
    for (int k = 0; k < 3; ++k) { // the height of the cell over the plane of the other two edges
      const double height = 1.0 / glm::length(glm::dvec3(inverse[0][k], inverse[1][k], inverse[2][k]));
      size_[k] = static_cast<std::int64_t>(std::clamp(std::floor(height / width), 1.0, 512.0));
    }
    cells_.resize(static_cast<std::size_t>(size_[0] * size_[1] * size_[2]));
    of_.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      glm::dvec3 f = inverse * (places[i] - box_.origin);
      for (int k = 0; k < 3; ++k) {
        if (box_.periodic[k]) f[k] -= std::floor(f[k]);
        const double at = std::floor(f[k] * static_cast<double>(size_[k]));
        of_[i][static_cast<std::size_t>(k)] = at >= 0 ? std::min<std::int64_t>(static_cast<std::int64_t>(std::min(at, 1e9)), size_[k] - 1) : 0;
      }
      cells_[index(of_[i])].push_back(static_cast<std::uint32_t>(i));
    }
  }

  [[nodiscard]] const Box& box() const { return box_; }

  // Calls fn(other) for the atoms in the cells around that of `atom`, its own included; each once.
  template <class Fn> void near(std::size_t atom, const Fn& fn) const {
    std::array<std::array<std::int64_t, 3>, 3> along{};
    std::array<int, 3> count{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::int64_t step = -1; step <= 1; ++step) {
        std::int64_t c = of_[atom][k] + step;
        if (box_.periodic[static_cast<int>(k)]) c = (c + size_[static_cast<int>(k)]) % size_[static_cast<int>(k)];
        else if (c < 0 || c >= size_[static_cast<int>(k)]) continue;
        const auto end = along[k].begin() + count[k];
        if (std::find(along[k].begin(), end, c) == end) along[k][static_cast<std::size_t>(count[k]++)] = c;
      }
    for (int x = 0; x < count[0]; ++x)
      for (int y = 0; y < count[1]; ++y)
        for (int z = 0; z < count[2]; ++z)
          for (const std::uint32_t other : cells_[index({along[0][static_cast<std::size_t>(x)], along[1][static_cast<std::size_t>(y)],
                                                         along[2][static_cast<std::size_t>(z)]})])
            fn(other);
  }

private:
  [[nodiscard]] std::size_t index(const std::array<std::int64_t, 3>& c) const {
    return static_cast<std::size_t>((c[2] * size_[1] + c[1]) * size_[0] + c[0]);
  }
  static Box cell_of(const Frame& frame, const std::vector<glm::dvec3>& places) {
    if (frame.box && has_volume(*frame.box) && (frame.box->periodic.x || frame.box->periodic.y || frame.box->periodic.z)) return *frame.box;
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::dvec3& p : places) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    Box box;
    box.origin = low - 0.5;
    for (int k = 0; k < 3; ++k) box.edges[k][k] = std::max(high[k] - low[k], 0.0) + 1.0;
    box.periodic = glm::bvec3(false);
    return box;
  }

  Box box_;
  glm::i64vec3 size_{1};
  std::vector<std::array<std::int64_t, 3>> of_{};
  std::vector<std::vector<std::uint32_t>> cells_{};
};

} // namespace

Bonds bonds_by_distance(const Frame& frame, double tolerance) {
  const Column* elements = frame.find("element");
  const Column* position = frame.find("position");
  const auto* symbols = elements ? std::get_if<TextColumn>(&elements->values) : nullptr;
  if (!symbols || !position || frame.count < 2) return {};
  const double unit = position->unit == "nm" ? 0.1 : 1.0;
  std::vector<double> by_code;
  for (const std::string& symbol : symbols->dictionary) {
    const Element* element = find_element(symbol);
    by_code.push_back(element ? unit * double{element->covalent_radius} : 0.0);
  }
  std::vector<glm::dvec3> places; // atoms that can have bonds
  std::vector<std::uint32_t> rows;
  double largest = 0.0;
  for (std::uint64_t row = 0; row < frame.count; ++row) {
    const glm::dvec3 p(position->number(row, 0), position->number(row, 1), position->number(row, 2));
    const double radius = by_code[symbols->codes[row]];
    if (!(glm::dot(p, p) < 1e30) || !(radius > 0.0)) continue;
    places.push_back(p);
    rows.push_back(static_cast<std::uint32_t>(row));
    largest = std::max(largest, radius);
  }
  if (places.size() < 2) return {};
  const Grid grid(frame, places, 2.0 * largest + tolerance * unit);
  const MinimumImage shortest(grid.box());
  Bonds bonds;
  for (std::size_t i = 0; i < places.size(); ++i)
    grid.near(i, [&](std::uint32_t other) {
      if (other <= i) return;
      const double distance = glm::length(shortest(places[other] - places[i]));
      const double reach = by_code[symbols->codes[rows[i]]] + by_code[symbols->codes[rows[other]]] + tolerance * unit;
      if (distance >= shortest_bond * unit && distance <= reach) bonds.rows.push_back({rows[i], rows[other]});
    });
  std::sort(bonds.rows.begin(), bonds.rows.end());
  return bonds;
}

} // namespace mote::data
