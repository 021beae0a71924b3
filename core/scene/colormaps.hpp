// SPDX-License-Identifier: MIT
// Named color maps: numbers in [0,1] to sRGB-encoded colors, as tables of 8-bit entries that the
// published maps consist of; a lookup takes the entry that the number falls into, with no blending, so a
// picture shows only colors that the map has. "NAME_r" is NAME reversed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote {

struct ColorMap {
  std::string_view name{};
  std::string_view summary{};                // what it is for
  std::string_view license{};                // of the values
  std::span<const std::uint32_t> entries{};  // 0xRRGGBB
  bool categories{};                         // entries are for kinds of things: whole numbers pick entries in turn
  bool reversed{};                           // read from the end
  // x in [0,1] (outside: the end's color; not NaN) -> 0xRRGGBB
  [[nodiscard]] std::uint32_t at(double x) const;
  [[nodiscard]] std::uint32_t category(std::int64_t k) const; // entry k modulo the number of entries
};

std::span<const ColorMap> color_maps();
// Lookup by name, "_r" understood; false when there is no such map.
bool find_color_map(std::string_view name, ColorMap& out);
std::vector<std::string> color_map_names(); // without the reversed ones

inline constexpr std::uint32_t not_a_number_color = 0xff00ff; // of values that are NaN: in no shipped map

} // namespace mote
