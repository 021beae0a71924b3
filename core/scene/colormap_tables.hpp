// SPDX-License-Identifier: MIT
// The entries of the shipped color maps, 0xRRGGBB, sRGB-encoded: the tables of Matplotlib 3.10, and of F.
// Crameri's Scientific colour maps, rounded to 8 bits. Generated once from comma-separated values; who made
// each map and under which license stands in colormaps.cpp. Private to core/scene.
#pragma once

#include <array>
#include <cstdint>

namespace mote {

extern const std::array<std::uint32_t, 256> colormap_viridis;
extern const std::array<std::uint32_t, 256> colormap_plasma;
extern const std::array<std::uint32_t, 256> colormap_inferno;
extern const std::array<std::uint32_t, 256> colormap_magma;
extern const std::array<std::uint32_t, 256> colormap_cividis;
extern const std::array<std::uint32_t, 256> colormap_turbo;
extern const std::array<std::uint32_t, 256> colormap_batlow;
extern const std::array<std::uint32_t, 256> colormap_gray;
extern const std::array<std::uint32_t, 256> colormap_coolwarm;
extern const std::array<std::uint32_t, 256> colormap_RdBu;
extern const std::array<std::uint32_t, 510> colormap_twilight;
extern const std::array<std::uint32_t, 10> colormap_tab10;

} // namespace mote
