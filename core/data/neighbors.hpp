// SPDX-License-Identifier: MIT
// How far apart particles are: the scale of a data set whose file gives neither radii nor elements
// (the scene then draws spheres of half this distance). Any unit and any density: nothing is compared
// with a fixed length. Deterministic: no random numbers, no dependence on the number of threads.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace mote::data {

// The median over particles of the distance to the nearest other place, in the unit of the positions.
// `positions`: x y z of each particle. Positions that are not finite and coincident ones do not count.
// Exact over all particles up to 65536; above that the median of 1024 particles spread evenly over the
// data, each measured exactly against all others. Nothing if there are fewer than two places. Periodic
// neighbors are not looked at.
[[nodiscard]] std::optional<double> median_neighbor_distance(std::span<const double> positions);

} // namespace mote::data
