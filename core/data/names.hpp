// SPDX-License-Identifier: MIT
// From the names that files use to the canonical names of Frame: x y z -> position, velo -> velocity,
// c_stress[1..6] -> stress, diameter -> radius (halved), quaternions always as w x y z. One table for
// all formats; a reader passes what its file declares and gets the plan of a RowLayout.
//
//   canonical     components  meaning
//   position      3           as in the file (unwrapped if that is what it has)
//   velocity force momentum dipole angular_velocity angular_momentum torque        3 each
//   image         3           how often the particle crossed the periodic boundaries
//   id type molecule charge mass radius     1
//   element       1 (text)    a chemical symbol; labels that are none are in `type` (text)
//   orientation   4           unit quaternion, w x y z (Column::unit says "wxyz")
//   shape         3           half axes of an ellipsoid
//   normal        3           of a surface point, as in the file
//   color         3           as in the file
//   stress        6 or 9      6: xx yy zz xy xz yz
//   transparency selection magnetic_moment                   as in the file
#pragma once

#include "core/data/rows.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::data {

// What a file declares: a name for `components` fields in a row. Tables declare one field at a time.
struct Declared {
  std::string name{};
  std::uint32_t components{1};
  Cell kind{Cell::Real};
  bool promote{}; // a guessed kind that may widen (RowColumn::promote); ignored for the position
};

// Customs that differ between formats and cannot be seen in the file.
struct Customs {
  bool quaternion_is_xyzw{}; // an unnamed group of four is x y z w (OVITO's extended XYZ)
  bool shape_is_diameter{};  // c_shape, shapex: full axes (LAMMPS)
  bool units_in_names{};     // "x (nm)", "radius [m]", "mass/kg" (tables)
};

// Fields in file order and the columns they fill. Never throws: whether a position is there is asked
// with require_position().
RowLayout plan_columns(std::span<const Declared> declared, const Customs& customs);

// The canonical name of a group of `components`, or `name` itself.
[[nodiscard]] std::string canonical_name(std::string_view name, std::uint32_t components);

// D013 unless the plan has a position of three numbers. `declared` is what the message lists.
void require_position(const RowLayout& layout, std::span<const Declared> declared, const SourceLoc& loc);

// Finishes what needs all values: an `element` column of labels that are not all symbols is renamed to
// `type`; one of atomic numbers becomes symbols.
void finish_columns(std::vector<Column>& columns);

} // namespace mote::data
