// SPDX-License-Identifier: MIT
// What readers of molecular files share: building columns value by value, cells from lengths and
// angles, elements from atom names, bonds from pairs that may come twice. It knows no file format.
//
// Columns of molecular files beyond the canonical ones of names.hpp:
//   atom_name residue_name chain altloc        text, without blanks around
//   residue_id                                 integer (author's numbering); insertion_code text
//   occupancy b_factor (A^2) hetero (0 or 1)
//   anisou      6      U11 U22 U33 U12 U13 U23 in A^2, in the axes of the positions; NaN = not given
#pragma once

#include "core/data/dataset.hpp"

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace mote::data {

// A text column in the making.
class Labels {
public:
  void add(std::string_view word);
  [[nodiscard]] bool any_text() const {
    return map_.size() > 1 || (map_.size() == 1 && !column_.dictionary[0].empty());
  }
  Column take(std::string name) { return {std::move(name), 1, std::move(column_), {}}; }

private:
  TextColumn column_{};
  std::unordered_map<std::string, std::uint32_t> map_{};
  std::uint32_t last_{};
};

// Bonds without doubles. Rows above 2^32 - 1 cannot be told to it.
class BondList {
public:
  // False, and nothing is added, when it is there already or joins a row to itself.
  bool add(std::uint64_t a, std::uint64_t b);
  bool add(std::uint64_t a, std::uint64_t b, std::int64_t type);
  Bonds take() { return std::move(bonds_); }

private:
  Bonds bonds_{};
  std::unordered_map<std::uint64_t, bool> known_{};
};

// The columns of one model of a protein file in the making: one value of each for every atom.
struct AtomColumns {
  std::vector<double> positions{}, occupancies{}, b_factors{}, anisou{}; // anisou may lag behind
  std::vector<std::int64_t> ids{}, residue_ids{}, hetero{};
  Labels elements{}, names{}, residues{}, chains{}, chain_labels{}, altlocs{}, insertions{};
  std::uint64_t count{};
  // The place of the six values of atom `row`; NaN for the atoms before it that have none.
  double* anisou_of(std::uint64_t row);
  void give(Frame& frame); // columns that would be empty throughout are left out
};

// The cell with edges of `lengths` and angles alpha (b, c), beta (a, c), gamma (a, b) in degrees: a
// along x, b in the xy plane (International Tables for Crystallography A, and every program). Nothing
// when a length is not above 0, or the angles form no cell.
[[nodiscard]] std::optional<Box> cell_box(const glm::dvec3& lengths, const glm::dvec3& angles);

// The symbol ("C", "Fe") of an atom by its four name columns in a PDB file: a one-letter symbol
// stands in the second of them. "X" when it names none.
[[nodiscard]] std::string_view element_of_pdb_name(std::string_view four, std::string_view residue);
// The same for names without columns (GRO): an ion is called as its residue; otherwise the first
// letter counts, except in names such as FE, ZN, BR.
[[nodiscard]] std::string_view element_of_name(std::string_view name, std::string_view residue);

[[nodiscard]] inline Column real_column(std::string name, std::uint32_t components,
                                        std::vector<double> values, std::string unit = {}) {
  return {std::move(name), components, std::move(values), std::move(unit)};
}
[[nodiscard]] inline Column int_column(std::string name, std::vector<std::int64_t> values,
                                       std::uint32_t components = 1) {
  return {std::move(name), components, std::move(values), {}};
}

} // namespace mote::data
