// SPDX-License-Identifier: MIT
#include "core/chart/figure.hpp"

#include "core/chart/scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mote::chart {
namespace {

constexpr double sheet_width = 860, plot_width = 500, plot_height = 330, left = 84, title_height = 46, panel_gap = 74, legend_row = 17;
constexpr std::uint32_t ink = 0x222222, pale = 0xDDDDDD, front_ink = 0x111111;
// Distinct also without color by their marks (Okabe and Ito's eight, and six darker ones).
constexpr std::array<std::uint32_t, 14> colors{0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xB58900, 0x56B4E9, 0x444444,
                                               0x7B3294, 0x8C2D04, 0x01665E, 0x5A5A9E, 0xA6761D, 0xC51B7D, 0x4D9221};

// A mark of one of five shapes.
std::vector<glm::dvec2> mark(std::size_t shape, glm::dvec2 at, double r) {
  constexpr std::array<int, 5> corners{12, 4, 3, 4, 3};
  constexpr std::array<double, 5> turns{0.0, 0.125, -0.25, 0.0, 0.25}; // circle, square, triangle, diamond, triangle downward
  const int n = corners[shape % 5];
  std::vector<glm::dvec2> out;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * (turns[shape % 5] + i / static_cast<double>(n));
    out.push_back(at + (n == 12 ? 1.0 : 1.25) * r * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return out;
}

class PanelPainter {
public:
  PanelPainter(Figure& figure, const Panel& panel, double top)
      : figure_(figure), panel_(panel), top_(top), x_(make_scale(panel, true, 6)), y_(make_scale(panel, false, 7)) {}
  void draw() {
    frame();
    if (panel_.trade_off) front_line();
    for (std::size_t i = 0; i < panel_.series.size(); ++i) series(i);
    legend();
  }
  // What the panel needs below `top`, legend included.
  [[nodiscard]] double height() const { return std::max(plot_height, legend_row * static_cast<double>(panel_.series.size() + 2)); }

private:
  [[nodiscard]] glm::dvec2 at(const Point& p) const { return {left + plot_width * place(x_, p.x), top_ + plot_height * (1.0 - place(y_, p.y))}; }
  void words(std::string text, glm::dvec2 where, double size, Anchor anchor, std::uint32_t color = ink) {
    figure_.texts.push_back({.words = std::move(text), .at = where, .size = size, .anchor = anchor, .color = color});
  }

  void frame() {
    const double right = left + plot_width, bottom = top_ + plot_height;
    words(panel_.title, {left, top_ - 10}, 14, Anchor::Start);
    for (const overlay::Tick& tick : x_.ticks) {
      const double x = left + plot_width * place(x_, tick.value);
      figure_.strokes.push_back({.points = {{x, top_}, {x, bottom}}, .color = pale});
      words(tick.label, {x, bottom + 16}, 11, Anchor::Middle);
    }
    for (const overlay::Tick& tick : y_.ticks) {
      const double y = bottom - plot_height * place(y_, tick.value);
      figure_.strokes.push_back({.points = {{left, y}, {right, y}}, .color = pale});
      words(tick.label, {left - 6, y + 4}, 11, Anchor::End);
    }
    if (y_.zeros) words("0", {left - 6, bottom + 4}, 11, Anchor::End);
    if (y_.failures) words("fails", {left - 6, top_ + 4}, 11, Anchor::End);
    figure_.strokes.push_back({.points = {{left, top_}, {left, bottom}, {right, bottom}, {right, top_}, {left, top_}}, .color = ink});
    words(label(panel_.x), {left + 0.5 * plot_width, bottom + 36}, 12, Anchor::Middle);
    figure_.texts.push_back({.words = label(panel_.y), .at = {left - 60, top_ + 0.5 * plot_height}, .size = 12, .anchor = Anchor::Middle, .upward = true});
  }

  // The front as a staircase: between its points nothing was measured.
  void front_line() {
    std::vector<Point> front;
    for (const Series& s : panel_.series)
      for (const Point& p : s.points)
        if (p.front) front.push_back(p);
    std::sort(front.begin(), front.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    Stroke line{.points = {}, .color = front_ink, .width = 1.5};
    for (std::size_t i = 0; i < front.size(); ++i) {
      if (i > 0) line.points.push_back({at(front[i]).x, at(front[i - 1]).y});
      line.points.push_back(at(front[i]));
    }
    if (line.points.size() > 1) figure_.strokes.push_back(std::move(line));
  }

  void series(std::size_t i) {
    const Series& s = panel_.series[i];
    const std::uint32_t color = colors[i % colors.size()];
    Stroke line{.points = {}, .color = color, .width = s.baseline ? 1.0 : 1.8, .dashed = s.baseline};
    for (const Point& p : s.points) {
      line.points.push_back(at(p));
      if (p.front) figure_.areas.push_back({.points = mark(0, at(p), 7.5), .color = front_ink, .hollow = true});
      figure_.areas.push_back({.points = mark(i, at(p), 4.0), .color = color, .hollow = s.baseline});
      if (panel_.trade_off && !p.parameter.empty()) words(p.parameter, at(p) + glm::dvec2(7, -5), 8.5, Anchor::Start, color);
    }
    if (line.points.size() > 1) figure_.strokes.push_back(std::move(line));
  }

  void legend() {
    const double x = left + plot_width + 16;
    double y = top_ + 10;
    for (std::size_t i = 0; i < panel_.series.size(); ++i, y += legend_row) {
      const Series& s = panel_.series[i];
      figure_.areas.push_back({.points = mark(i, {x, y - 4}, 4.0), .color = colors[i % colors.size()], .hollow = s.baseline});
      words(s.method, {x + 10, y}, 11, Anchor::Start, s.baseline ? 0x666666u : ink);
    }
    if (!panel_.trade_off) return;
    figure_.areas.push_back({.points = mark(0, {x, y - 4}, 7.5), .color = front_ink, .hollow = true});
    words("Pareto front: nothing is better in both", {x + 12, y}, 11, Anchor::Start);
  }

  Figure& figure_;
  const Panel& panel_;
  double top_;
  Scale x_, y_;
};

std::vector<std::string> footer(const Chart& chart) {
  std::vector<std::string> lines;
  if (std::any_of(chart.panels.begin(), chart.panels.end(), [](const Panel& p) {
        return std::any_of(p.series.begin(), p.series.end(), [](const Series& s) { return s.baseline; });
      }))
    lines.push_back("Hollow marks: baselines, shown to be compared with.");
  lines.insert(lines.end(), chart.notes.begin(), chart.notes.end());
  const Origin& o = chart.origin;
  lines.push_back(fmt::format("{} · {} · {} · {}", o.date, o.machine, o.device, o.driver));
  if (!o.command.empty()) lines.push_back(o.command);
  return lines;
}

} // namespace

Figure lay_out(const Chart& chart) {
  Figure figure{.width = sheet_width};
  figure.texts.push_back({.words = chart.title, .at = {left - 60, 26}, .size = 18});
  double top = title_height + 22;
  for (const Panel& panel : chart.panels) {
    PanelPainter painter(figure, panel, top);
    painter.draw();
    top += painter.height() + panel_gap;
  }
  top -= 14;
  for (const std::string& line : footer(chart)) {
    figure.texts.push_back({.words = line, .at = {left - 60, top}, .size = 10.5, .color = 0x555555});
    top += 15;
  }
  figure.height = top + 4;
  return figure;
}

} // namespace mote::chart
