// SPDX-License-Identifier: MIT
// Color tables and stored pictures by their size in bytes: hues from tables of N entries, and pictures whose chroma is kept
// for fewer pixels than luma. Plain arithmetic in double. Method book, section 8.5.
#pragma once

#include "core/chart/chart.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace mote::app {

enum class HueTable : std::uint8_t { Nearest, Centers, Knots }; // read at the nearest entry; linear, entries at (j + 1/2)/N; linear, at j/N, around the seam
glm::dvec3 hue_color(double h);                              // exact, saturation and value 1; h in [0, 1)
glm::dvec3 hue_from_table(HueTable kind, int entries, double h);

// A picture of discs of saturated colors, side x side, sRGB-encoded bytes 0..255.
std::vector<glm::dvec3> discs(int side);
// Through 8-bit BT.709 full range, chroma averaged over across x down pixels and read back linearly or as blocks.
std::vector<glm::dvec3> subsampled(const std::vector<glm::dvec3>& picture, int side, int across, int down, bool linear);

chart::Panel hue_panel();
chart::Panel chroma_panel();

} // namespace mote::app
