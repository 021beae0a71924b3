// SPDX-License-Identifier: MIT
// Bonds as particles: each bond is two cylinders that meet in its middle, one in the color of either atom. Across a periodic cell
// each half points to the nearest image of the other atom. Called by realize() for the styles that draw bonds;
// private to core/scene.
#pragma once

#include "core/scene/drawable.hpp"

namespace mote {

// The bonds that the file states, with those that distances tell (core/data/bonds.hpp) where it states fewer than one for three
// atoms, between atoms that are drawn.
// S043 where there can be none of either.
data::Bonds drawn_bonds(const FrameContext& context, const DataDesc& desc, Diagnostics& diagnostics);

// Of bonds whose both atoms `group` marks (all, when it is empty). `colors`: of the atoms, may be empty. Rows count bonds.
// Halves without length are left out.
Drawable bond_sticks(const data::Frame& frame, const data::Bonds& bonds, const std::vector<bool>& group, const std::vector<std::uint32_t>& colors, double radius, bool open);

// Radii of bonds and of the atoms of `licorice` where the scene says none; those of `ball_and_stick` are a quarter of the atoms'.
double usual_bond_radius(const data::Frame& frame, MoleculeStyle style);
constexpr double ball_of_atom = 0.25;

} // namespace mote
