// SPDX-License-Identifier: MIT
#include "core/overlay/font.hpp"

#include <algorithm>

namespace mote::overlay {
namespace {

constexpr int pieces = 6; // straight ones that a spline becomes

// The next character of UTF-8 text; broken bytes count as one '?' each.
std::uint32_t next_code(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80 ? 1 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 0;
  if (length == 0 || length > text.size()) {
    text.remove_prefix(1);
    return '?';
  }
  std::uint32_t code = length == 1 ? first : first & (0x7Fu >> length);
  for (std::size_t k = 1; k < length; ++k) code = code << 6 | (static_cast<unsigned char>(text[k]) & 0x3Fu);
  text.remove_prefix(length);
  return code;
}

const Glyph& glyph_of(std::uint32_t code) {
  const auto find = [](std::uint32_t wanted) { return std::find_if(glyphs.begin(), glyphs.end(), [&](const Glyph& g) { return g.code == wanted; }); };
  const auto found = find(code);
  return found != glyphs.end() ? *found : *find('?');
}

struct OutlinePoint {
  glm::dvec2 place{};
  bool on{};
};

// A TrueType contour as straight pieces. Between two points off the curve lies one on it.
std::vector<glm::dvec2> flattened(const std::vector<OutlinePoint>& points) {
  std::vector<OutlinePoint> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const OutlinePoint &a = points[i], &b = points[(i + 1) % points.size()];
    all.push_back(a);
    if (!a.on && !b.on) all.push_back({(a.place + b.place) * 0.5, true});
  }
  const auto start = std::find_if(all.begin(), all.end(), [](const OutlinePoint& p) { return p.on; });
  std::rotate(all.begin(), start, all.end());
  std::vector<glm::dvec2> out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].on) {
      out.push_back(all[i].place);
      continue;
    }
    const glm::dvec2 a = all[i - 1].place, b = all[i].place, c = all[(i + 1) % all.size()].place;
    for (int k = 1; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      out.push_back(a * (1 - t) * (1 - t) + b * 2.0 * t * (1 - t) + c * t * t);
    }
  }
  return out;
}

void add_glyph(const Glyph& glyph, double scale, const glm::dvec2& origin, Path& path) {
  std::size_t at = glyph.first;
  const std::size_t end = at + glyph.count;
  while (at < end) {
    std::vector<OutlinePoint> points(static_cast<std::size_t>(outline_numbers[at++]));
    for (OutlinePoint& p : points) {
      const int x = outline_numbers[at], y = outline_numbers[at + 1];
      p = {origin + scale * glm::dvec2(x >> 1, -y), (x & 1) != 0};
      at += 2;
    }
    path.push_back(flattened(points));
  }
}

} // namespace

double text_width(std::string_view text, double size) {
  double units = 0;
  while (!text.empty()) units += glyph_of(next_code(text)).advance;
  return units * size / units_per_em;
}

Path text_path(std::string_view text, double size, double x, double y) {
  Path path;
  const double scale = size / units_per_em;
  while (!text.empty()) {
    const Glyph& glyph = glyph_of(next_code(text));
    add_glyph(glyph, scale, {x, y}, path);
    x += glyph.advance * scale;
  }
  return path;
}

} // namespace mote::overlay
