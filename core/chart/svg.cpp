// SPDX-License-Identifier: MIT
#include "core/chart/figure.hpp"
#include "core/chart/tables.hpp"
#include "core/chart/write.hpp"

#include <fmt/format.h>

namespace mote::chart {
namespace {

std::string points_text(const std::vector<glm::dvec2>& points) {
  std::string out;
  for (const glm::dvec2& p : points) out += fmt::format("{}{:.1f},{:.1f}", out.empty() ? "" : " ", p.x, p.y);
  return out;
}

std::string anchor_text(Anchor anchor) {
  return anchor == Anchor::Start ? "" : anchor == Anchor::Middle ? " text-anchor=\"middle\"" : " text-anchor=\"end\"";
}

std::string text_element(const Text& t) {
  const std::string turn = t.upward ? fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", t.at.x, t.at.y) : "";
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:g}\" fill=\"#{:06x}\"{}{}>{}</text>\n", t.at.x, t.at.y, t.size, t.color,
                     anchor_text(t.anchor), turn, escaped(t.words));
}

} // namespace

std::string to_svg(const Chart& chart) {
  const Figure f = lay_out(chart);
  std::string out = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
                                "font-family=\"DejaVu Sans, Verdana, sans-serif\">\n<title>{2}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
                                f.width, f.height, escaped(chart.title));
  for (const Stroke& s : f.strokes)
    out += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"#{:06x}\" stroke-width=\"{:g}\"{}/>\n", points_text(s.points), s.color, s.width,
                       s.dashed ? " stroke-dasharray=\"4 3\"" : "");
  for (const Area& a : f.areas)
    out += a.hollow ? fmt::format("<polygon points=\"{}\" fill=\"#ffffff\" stroke=\"#{:06x}\" stroke-width=\"1.2\"/>\n", points_text(a.points), a.color)
                    : fmt::format("<polygon points=\"{}\" fill=\"#{:06x}\"/>\n", points_text(a.points), a.color);
  for (const Text& t : f.texts) out += text_element(t);
  return out + "</svg>\n";
}

} // namespace mote::chart
