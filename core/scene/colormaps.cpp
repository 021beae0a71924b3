// SPDX-License-Identifier: MIT
#include "core/scene/colormaps.hpp"

#include "core/scene/colormap_tables.hpp"

#include <algorithm>
#include <array>

namespace mote {
namespace {

constexpr std::string_view cc0 = "CC0 1.0 (S. van der Walt, N. Smith, E. Firing)";
constexpr std::string_view brewer = "Apache-2.0 (C. Brewer, ColorBrewer)";

const std::array<ColorMap, 12>& table() {
  static const std::array<ColorMap, 12> maps{{
      {"viridis", "values, even steps, safe for color blindness", cc0, colormap_viridis},
      {"plasma", "values, even steps", cc0, colormap_plasma},
      {"inferno", "values, even steps, from black", cc0, colormap_inferno},
      {"magma", "values, even steps, from black", cc0, colormap_magma},
      {"cividis", "values, the same for the color-blind", "CC0 1.0 (J. Nunez, C. Anderton, R. Renslow)", colormap_cividis},
      {"turbo", "values, many hues", "Apache-2.0 (A. Mikhailov, Google)", colormap_turbo},
      {"batlow", "values, even steps, safe for color blindness", "MIT (c) 2020 F. Crameri", colormap_batlow},
      {"gray", "values, black to white", "no rights apply", colormap_gray},
      {"coolwarm", "values about a middle, blue to red", "free (K. Moreland)", colormap_coolwarm},
      {"RdBu", "values about a middle, red to blue", brewer, colormap_RdBu},
      {"twilight", "angles: both ends are the same color", "CC0 1.0 (B. Bechtold)", colormap_twilight},
      {"tab10", "kinds of things, ten colors in turn", "BSD-3-Clause (Tableau, Matplotlib)", colormap_tab10, true},
  }};
  return maps;
}

} // namespace

std::uint32_t ColorMap::at(double x) const {
  const auto n = static_cast<double>(entries.size());
  const auto i = static_cast<std::size_t>(std::clamp(x * n, 0.0, n - 1.0));
  return entries[reversed ? entries.size() - 1 - i : i];
}

std::uint32_t ColorMap::category(std::int64_t k) const {
  const auto n = static_cast<std::int64_t>(entries.size());
  const auto i = static_cast<std::size_t>((k % n + n) % n);
  return entries[reversed ? entries.size() - 1 - i : i];
}

std::span<const ColorMap> color_maps() { return table(); }

bool find_color_map(std::string_view name, ColorMap& out) {
  const bool reversed = name.ends_with("_r");
  if (reversed) name.remove_suffix(2);
  const auto found = std::find_if(table().begin(), table().end(), [&](const ColorMap& map) { return map.name == name; });
  if (found == table().end()) return false;
  out = *found;
  out.reversed = reversed;
  return true;
}

std::vector<std::string> color_map_names() {
  std::vector<std::string> names;
  for (const ColorMap& map : table()) names.emplace_back(map.name);
  return names;
}

} // namespace mote
