// SPDX-License-Identifier: MIT
#include "app/window/hud.hpp"

#include "core/color/srgb.hpp"
#include "core/overlay/font.hpp"

#include <algorithm>
#include <cmath>

namespace mote::window {
namespace {

constexpr double letters = 14.0, line = 20.0, margin = 10.0, gap = 24.0; // pixels of a usual display
constexpr double darkness = 0.78;
const glm::dvec3 ink(0.9), accent(0.45, 0.7, 1.0);

} // namespace

std::vector<std::uint8_t> displayed(const overlay::Layer& layer) {
  std::vector<std::uint8_t> out(layer.pixels.size() * 4);
  for (std::size_t i = 0; i < layer.pixels.size(); ++i) {
    const glm::vec4& p = layer.pixels[i];
    for (int k = 0; k < 3; ++k) out[i * 4 + static_cast<std::size_t>(k)] = p.a > 0.0f ? to_8bit(srgb_encode(double{p[k]} / double{p.a})) : 0;
    out[i * 4 + 3] = to_8bit(double{p.a});
  }
  return out;
}

FlatPicture text_box(const std::vector<std::array<std::string, 2>>& rows, HudPlace place, Size2d window, double scale) {
  FlatPicture out;
  if (rows.empty() || window.width < 16 || window.height < 16) return out;
  const double size = letters * scale, step = line * scale, border = margin * scale;
  double first = 0.0, second = 0.0;
  for (const auto& row : rows) {
    first = std::max(first, overlay::text_width(row[0], size));
    second = std::max(second, overlay::text_width(row[1], size));
  }
  const double column = second > 0.0 ? first + gap * scale : 0.0;
  const double width = std::min(2 * border + std::max(first, column + second), static_cast<double>(window.width));
  const auto fit = static_cast<std::size_t>(std::max(1.0, std::floor((window.height - 2 * border) / step)));
  const std::size_t shown = std::min(rows.size(), fit);
  const double height = std::min(2 * border + step * static_cast<double>(shown), static_cast<double>(window.height));
  overlay::Canvas canvas({static_cast<std::uint32_t>(std::ceil(width)), static_cast<std::uint32_t>(std::ceil(height))});
  canvas.rectangle({0, 0}, {std::ceil(width), std::ceil(height)}, glm::dvec3(0.01), darkness);
  for (std::size_t i = 0; i < shown; ++i) {
    const double baseline = border + step * (static_cast<double>(i) + 0.75);
    canvas.fill(overlay::text_path(rows[i][0], size, border, baseline), second > 0.0 ? accent : ink);
    if (!rows[i][1].empty()) canvas.fill(overlay::text_path(rows[i][1], size, border + column, baseline), ink);
  }
  out.size = canvas.size();
  out.rgba = displayed(canvas.take());
  const auto rest = [](std::uint32_t whole, std::uint32_t part) { return static_cast<std::int32_t>(whole - part); };
  const std::int32_t across = rest(window.width, out.size.width), down = rest(window.height, out.size.height);
  const auto edge = static_cast<std::int32_t>(border);
  out.x = place == HudPlace::Center ? across / 2 : std::min(edge, across);
  out.y = place == HudPlace::Center ? down / 2 : place == HudPlace::TopLeft ? std::min(edge, down) : std::max(down - edge, 0);
  return out;
}

} // namespace mote::window
