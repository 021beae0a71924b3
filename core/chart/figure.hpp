// SPDX-License-Identifier: MIT
// A chart laid out as strokes, areas and texts on a sheet, y down, in the unit of an SVG. svg.cpp and raster.cpp turn the
// same sheet into a vector and a pixel picture, so that both show the same. Pure.
#pragma once

#include "core/chart/chart.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace mote::chart {

enum class Anchor : std::uint8_t { Start, Middle, End };

struct Stroke {
  std::vector<glm::dvec2> points{};
  std::uint32_t color{}; // 0xRRGGBB, sRGB-encoded
  double width{1.0};
  bool dashed{};
};
struct Area { // convex; with `hollow` filled white and outlined
  std::vector<glm::dvec2> points{};
  std::uint32_t color{};
  bool hollow{};
};
struct Text {
  std::string words{};
  glm::dvec2 at{}; // baseline
  double size{12.0};
  Anchor anchor{Anchor::Start};
  bool upward{}; // turned by 90 degrees, read from below
  std::uint32_t color{0x222222};
};

struct Figure {
  double width{}, height{};
  std::vector<Stroke> strokes{}; // drawn first
  std::vector<Area> areas{};
  std::vector<Text> texts{};     // drawn last
};

Figure lay_out(const Chart& chart);

} // namespace mote::chart
