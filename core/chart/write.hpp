// SPDX-License-Identifier: MIT
// A chart as a file: SVG (vector), PNG (the same sheet as pixels), HTML (the SVG and its numbers as a table), CSV (its
// numbers) and text for a terminal. The CSV holds what the picture shows, a row a point:
//
//   panel,method,parameter,x_quantity,x_unit,x,y_quantity,y_unit,y,baseline,front,machine,device,driver,date
//
// Texts are UTF-8; numbers are the shortest that read back the same, "inf" and "nan" where a method failed.
#pragma once

#include "core/chart/chart.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace mote::chart {

std::string to_svg(const Chart& chart);
std::string to_html(const Chart& chart);
std::string to_csv(const Chart& chart);
std::string to_text(const Chart& chart);

struct Pixels {
  std::uint32_t width{}, height{};
  std::vector<std::uint8_t> rgba{}; // row 0 on top, sRGB-encoded, opaque
};
// `scale` pixels a unit of the SVG.
Pixels to_pixels(const Chart& chart, double scale = 2.0);

} // namespace mote::chart
