// SPDX-License-Identifier: MIT
// Color maps out of files, by their content: tables of numbers (r g b, or position r g b, 0..1 or 0..255,
// with commas or blanks; or "#rrggbb" words), GIMP palettes, GMT .cpt, ParaView's .json and .xml. Points between which
// a map is to be blended become 256 entries, straight between them in sRGB-encoded values; other color spaces
// that a file names are not followed. Used by color mappings whose `map` is a file.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/scene/colormaps.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mote {

// "maps/mine.csv" is a file, "viridis" is a name.
[[nodiscard]] bool is_color_map_file(std::string_view name);

struct ColorMapFile {
  std::vector<std::uint32_t> entries{}; // 0xRRGGBB, at least 2
  bool categories{};                    // a palette
  std::optional<std::uint32_t> below{}, above{}, nan{}; // as far as the file names them
};

// Throws Failure S029. `loc` is where the name was written.
ColorMapFile read_color_map(const std::filesystem::path& file, const SourceLoc& loc);
// The same for the text of a file, `name` for messages.
ColorMapFile parse_color_map(std::string_view text, const std::string& name);

} // namespace mote
