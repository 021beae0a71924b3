// SPDX-License-Identifier: MIT
// What is written over a picture and belongs to no particle: the color keys of the scalars that are mapped,
// the cells of the data, a scale bar, the time. Values only, made by realize() and drawn by core/overlay
// when the picture is finished; depth, id and normal never know of it.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mote {

// The colors of one mapped scalar, 0xRRGGBB, sRGB-encoded.
struct ColorKey {
  std::string title{}, unit{};
  double low{}, high{1.0};                // values of the first and the last color
  bool logarithmic{};
  std::vector<std::uint32_t> colors{};    // from low to high; with names: one of each
  std::vector<std::string> names{};       // categories; empty: a scale from low to high
  std::optional<std::uint32_t> below{}, above{}, nan{}; // of values outside, as far as they have colors of their own
  bool operator==(const ColorKey&) const = default;
};

// A cell whose edges are drawn; world.
struct CellOutline {
  glm::dvec3 corner{0};
  glm::dmat3 edges{0}; // columns
  glm::dvec3 color{0}; // working space
  double width{};      // pixels; 0: one six-hundredth of the picture's height, at least 1
};

enum class LegendPlace : std::uint8_t { Right, Left };

struct Annotations {
  bool scale_bar{};                  // a bar of known length, measured where the camera looks
  LegendPlace place{LegendPlace::Right};
  double size{1.0};                  // of letters and bars, times that which fits the picture
  std::vector<ColorKey> keys{};      // color bars and lists of kinds
  std::vector<CellOutline> cells{};
  std::string length_unit{};         // of the positions: "A", "nm", "" = unknown
  std::string time{};                // "t = 12.5 ps", or empty
  // Is anything to be drawn?
  [[nodiscard]] bool empty() const { return cells.empty() && keys.empty() && !scale_bar && time.empty(); }
};

} // namespace mote
