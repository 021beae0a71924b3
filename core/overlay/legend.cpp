// SPDX-License-Identifier: MIT
#include "core/overlay/legend.hpp"

#include "core/color/srgb.hpp"
#include "core/overlay/font.hpp"
#include "core/overlay/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote::overlay {
namespace {

constexpr double veil = 0.75; // opacity of what lies between letters and picture

glm::dvec3 decoded(std::uint32_t rgb) {
  return {srgb_decode((rgb >> 16 & 255u) / 255.0), srgb_decode((rgb >> 8 & 255u) / 255.0), srgb_decode((rgb & 255u) / 255.0)};
}

// The parts of one key, measured before they are drawn.
struct KeyBox {
  const ColorKey* key{};
  std::vector<Tick> ticks{};
  std::string title{};
  double width{}, height{};
};

struct Pen { // sizes in pixels
  Canvas& canvas;
  Ink ink;
  double letters, bar, gap;
  void text(std::string_view words, double x, double baseline, double size) const { canvas.fill(text_path(words, size, x, baseline), ink.text); }
};

bool has_patches(const ColorKey& key) { return key.below || key.above || key.nan; }

KeyBox measure(const ColorKey& key, const Pen& pen, double bar_height) {
  KeyBox box;
  box.key = &key;
  box.title = key.title;
  if (!key.unit.empty()) box.title += fmt::format(" ({})", unit_label(key.unit));
  const double line = 1.35 * pen.letters;
  double widest = 0.0;
  if (key.names.empty()) {
    box.ticks = ticks(key.low, key.high, std::max(2, static_cast<int>(bar_height / (2.6 * pen.letters))), key.logarithmic);
    for (const Tick& tick : box.ticks) widest = std::max(widest, text_width(tick.label, pen.letters));
    if (has_patches(key)) widest = std::max(widest, text_width("above", pen.letters));
    box.height = bar_height + line * (0.6 + (key.above ? 1 : 0) + (key.below ? 1 : 0) + (key.nan ? 1 : 0));
  } else {
    for (const std::string& name : key.names) widest = std::max(widest, text_width(name, pen.letters));
    box.height = line * static_cast<double>(key.names.size());
  }
  box.width = std::max(pen.bar + 2.0 * pen.gap + widest, text_width(box.title, pen.letters));
  box.height += 1.7 * line;
  return box;
}

// A square of one color with a word beside it.
void patch(const Pen& pen, double x, double y, std::uint32_t color, std::string_view word) {
  const double side = 0.95 * pen.letters;
  pen.canvas.rectangle({x, y}, {x + side, y + side}, decoded(color));
  pen.text(word, x + pen.bar + 2.0 * pen.gap, y + 0.5 * side + 0.5 * cap_height * pen.letters, pen.letters);
}

// Place of a value on the bar, 0 at low, 1 at high.
double place_of(const ColorKey& key, double value) {
  if (key.low == key.high) return 0.5;
  return key.logarithmic ? (std::log(value) - std::log(key.low)) / (std::log(key.high) - std::log(key.low)) : (value - key.low) / (key.high - key.low);
}

void draw_scale(const Pen& pen, const KeyBox& box, double x, double y, double bar_height) {
  const ColorKey& key = *box.key;
  const double line = 1.35 * pen.letters;
  if (key.above) {
    patch(pen, x, y, *key.above, "above");
    y += line;
  }
  y += 0.3 * line;
  const auto rows = static_cast<int>(std::max(1.0, std::round(bar_height)));
  const double top = std::round(y);
  for (int row = 0; row < rows; ++row) { // whole rows of pixels: every one shows a color of the map
    const double t = (rows - 0.5 - row) / rows;
    const auto entry = std::min(key.colors.size() - 1, static_cast<std::size_t>(t * static_cast<double>(key.colors.size())));
    pen.canvas.rectangle({x, top + row}, {x + pen.bar, top + row + 1}, decoded(key.colors[entry]));
  }
  const double thin = std::max(1.0, pen.letters / 16.0);
  for (const Tick& tick : box.ticks) {
    const double at = top + rows * (1.0 - place_of(key, tick.value));
    pen.canvas.rectangle({x + pen.bar, at - 0.5 * thin}, {x + pen.bar + pen.gap, at + 0.5 * thin}, pen.ink.text);
    pen.text(tick.label, x + pen.bar + 2.0 * pen.gap, at + 0.5 * cap_height * pen.letters, pen.letters);
  }
  y = top + rows + 0.3 * line;
  if (key.below) {
    patch(pen, x, y, *key.below, "below");
    y += line;
  }
  if (key.nan) patch(pen, x, y, *key.nan, "NaN");
}

void draw_key(const Pen& pen, const KeyBox& box, double x, double y, double bar_height) {
  const double pad = 0.6 * pen.letters, line = 1.35 * pen.letters;
  pen.canvas.rectangle({x - pad, y - pad}, {x + box.width + pad, y + box.height + 0.2 * pad}, pen.ink.veil, veil);
  pen.text(box.title, x, y + cap_height * pen.letters, pen.letters);
  y += 1.5 * line;
  if (box.key->names.empty()) return draw_scale(pen, box, x, y, bar_height);
  for (std::size_t i = 0; i < box.key->names.size(); ++i) patch(pen, x, y + static_cast<double>(i) * line, box.key->colors[i], box.key->names[i]);
}

void draw_keys(const Pen& pen, const Annotations& a, double width, double height, double margin) {
  if (a.keys.empty()) return;
  const double share = (height - 2.0 * margin) / static_cast<double>(a.keys.size());
  const double bar_height = std::max(2.0 * pen.letters, std::min(0.45 * height * a.size, share - 6.5 * pen.letters));
  double y = margin;
  for (const ColorKey& key : a.keys) {
    if (key.colors.empty()) continue;
    const KeyBox box = measure(key, pen, bar_height);
    draw_key(pen, box, a.place == LegendPlace::Right ? width - margin - box.width : margin, y, bar_height);
    y += box.height + 1.8 * pen.letters;
  }
}

void draw_scale_bar(const Pen& pen, const Annotations& a, double pixels_per_length, double width, double height, double margin) {
  const double length = round_length(0.2 * width / pixels_per_length);
  if (!(length > 0.0)) return;
  std::string label = number_label(length, 0.0);
  if (!a.length_unit.empty()) label += " " + unit_label(a.length_unit);
  const double pixels = length * pixels_per_length, thick = std::max(2.0, std::round(pen.letters / 5.0)), pad = 0.6 * pen.letters;
  const double across = std::max(pixels, text_width(label, pen.letters));
  const double left = a.place == LegendPlace::Right ? margin : width - margin - across, bottom = height - margin;
  pen.canvas.rectangle({left - pad, bottom - thick - 2.1 * pen.letters}, {left + across + pad, bottom + pad}, pen.ink.veil, veil);
  pen.canvas.rectangle({left, bottom - thick}, {left + pixels, bottom}, pen.ink.text);
  pen.text(label, left + 0.5 * (pixels - text_width(label, pen.letters)) * (pixels >= across ? 1.0 : 0.0), bottom - thick - 0.6 * pen.letters, pen.letters);
}

void draw_time(const Pen& pen, const Annotations& a, double width, double margin) {
  if (a.time.empty()) return;
  const double pad = 0.6 * pen.letters, across = text_width(a.time, pen.letters);
  const double left = a.place == LegendPlace::Right ? margin : width - margin - across;
  pen.canvas.rectangle({left - pad, margin - pad}, {left + across + pad, margin + pen.letters + 0.2 * pad}, pen.ink.veil, veil);
  pen.text(a.time, left, margin + cap_height * pen.letters, pen.letters);
}

} // namespace

Ink ink_for(const glm::dvec4& background) {
  const double light = glm::dot(glm::dvec3(background), glm::dvec3(0.2126, 0.7152, 0.0722));
  const bool on_light = background.a < 0.5 || light > 0.18; // middle gray
  const glm::dvec3 behind = background.a < 0.5 ? glm::dvec3(1.0) : glm::clamp(glm::dvec3(background), 0.0, 1.0);
  return {glm::dvec3(on_light ? 0.0 : 1.0), behind};
}

void draw_legend(Canvas& canvas, const Annotations& annotations, const Ink& ink, double pixels_per_length) {
  const double width = canvas.size().width, height = canvas.size().height;
  const double letters = std::max(9.0, std::min(height / 45.0, width / 30.0)) * annotations.size;
  const Pen pen{canvas, ink, letters, std::round(1.1 * letters), 0.35 * letters};
  const double margin = std::round(1.6 * letters);
  draw_keys(pen, annotations, width, height, margin);
  if (annotations.scale_bar && pixels_per_length > 0.0) draw_scale_bar(pen, annotations, pixels_per_length, width, height, margin);
  draw_time(pen, annotations, width, margin);
}

} // namespace mote::overlay
