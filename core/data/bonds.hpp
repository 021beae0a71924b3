// SPDX-License-Identifier: MIT
// Bonds guessed from distances, for files that state none: two atoms are bonded when they are nearer than
// the sum of their covalent radii (Cordero et al. 2008) plus a tolerance, and not nearer than 0.4 A (Meng and
// Lewis 1991, with the tolerance of 0.45 A that Open Babel and Jmol use). Periodic cells are looked across.
// Called by styles that draw bonds and by whoever asks; never changes a frame.
#pragma once

#include "core/data/dataset.hpp"

namespace mote::data {

inline constexpr double bond_tolerance = 0.45, shortest_bond = 0.4; // A

// Pairs as in Bonds, sorted; none when the frame has no elements. Positions are in Angstrom unless their unit is "nm".
// Time grows with the number of atoms: a grid of cells as wide as the longest bond.
[[nodiscard]] Bonds bonds_by_distance(const Frame& frame, double tolerance = bond_tolerance);

} // namespace mote::data
