// SPDX-License-Identifier: MIT
#include "core/scene/colormap_files.hpp"

#include "core/color/srgb.hpp"
#include "core/data/text.hpp"
#include "core/scene/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

namespace mote {
namespace {

using data::Cursor;
using data::Line;

constexpr std::size_t most_points = 65536;

struct Point {
  double at{};
  std::array<double, 3> rgb{};
};

[[noreturn]] void refuse(const SourceLoc& loc, std::string text) {
  fail(Exit::BadInput, code::color_map_file, loc, std::move(text),
       {"A color map file holds lines of r g b (0..1 or 0..255) or of position r g b, #rrggbb words, or is a .gpl, .cpt, or ParaView's .json or .xml"});
}

std::uint32_t packed(const std::array<double, 3>& c) {
  return std::uint32_t{to_8bit(c[0])} << 16 | std::uint32_t{to_8bit(c[1])} << 8 | std::uint32_t{to_8bit(c[2])};
}

// Points in order of their places -> 256 entries; entry i stands for the place (i + 0.5) / 256 of the way.
std::vector<std::uint32_t> blended(std::vector<Point> points) {
  std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.at < b.at; });
  const double first = points.front().at, span = points.back().at - first;
  std::vector<std::uint32_t> entries(256);
  std::size_t k = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double x = first + span * (static_cast<double>(i) / 255.0);
    while (k + 2 < points.size() && points[k + 1].at <= x) ++k;
    const Point &a = points[k], &b = points[k + 1];
    const double t = b.at > a.at ? std::clamp((x - a.at) / (b.at - a.at), 0.0, 1.0) : 0.0;
    std::array<double, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = a.rgb[c] + t * (b.rgb[c] - a.rgb[c]);
    entries[i] = packed(rgb);
  }
  return entries;
}

// Numbers of a line with any of the usual separators; false when a word is no number.
bool numbers_of(std::string_view line, std::vector<double>& out) {
  out.clear();
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t,;/\r");
    if (begin == std::string_view::npos) return true;
    line.remove_prefix(begin);
    const std::string_view word = line.substr(0, line.find_first_of(" \t,;/\r"));
    double value = 0;
    if (!data::parse_real(word, value) || !std::isfinite(value)) return false;
    out.push_back(value);
    line.remove_prefix(word.size());
  }
}

std::optional<std::uint32_t> hex_color(std::string_view word) {
  word = data::trim(word);
  while (!word.empty() && (word.back() == ',' || word.back() == '"')) word.remove_suffix(1);
  while (!word.empty() && word.front() == '"') word.remove_prefix(1);
  if (!word.starts_with('#') || word.size() != 7) return std::nullopt;
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(word.data() + 1, word.data() + 7, value, 16);
  return error == std::errc{} && end == word.data() + 7 ? std::optional(value) : std::nullopt;
}

// 0..255 where any value is above 1.
void scale_colors(std::vector<Point>& points) {
  double largest = 0.0;
  for (const Point& p : points) largest = std::max({largest, p.rgb[0], p.rgb[1], p.rgb[2]});
  if (largest > 1.0)
    for (Point& p : points)
      for (double& v : p.rgb) v /= 255.0;
}

// "255 0 0  bright red" -> "255 0 0"
std::string_view first_three(std::string_view line) {
  data::Words words(line);
  std::string_view last;
  for (int k = 0; k < 3; ++k)
    if (const std::string_view word = words.next(); !word.empty()) last = word;
  return last.empty() ? line : line.substr(0, static_cast<std::size_t>(last.data() + last.size() - line.data()));
}

ColorMapFile table_map(std::string_view text, const std::string& name, bool palette) {
  ColorMapFile map;
  std::vector<std::vector<double>> rows;
  std::vector<double> row;
  Cursor cursor(text);
  while (const auto line = cursor.next()) {
    const std::string_view words = data::trim(line->text);
    if (const auto hex = hex_color(words)) map.entries.push_back(*hex);
    if (words.empty() || words[0] == '#') continue;
    std::string_view values = words;
    if (palette) values = first_three(words);
    if (!numbers_of(values, row)) {
      if (rows.empty() && map.entries.empty()) continue; // a heading
      refuse({name, line->number}, fmt::format("{} is no color", data::shown(words)));
    }
    if (row.size() != 3 && row.size() != 4) refuse({name, line->number}, fmt::format("a line of {} numbers where 3 or 4 make a color", row.size()));
    if (!rows.empty() && rows[0].size() != row.size()) refuse({name, line->number}, "lines of 3 and of 4 numbers in one map");
    rows.push_back(row);
    if (rows.size() > most_points) refuse({name, line->number}, fmt::format("more than {} colors", most_points));
  }
  if (rows.empty()) return map;
  map.entries.clear();
  const bool alpha_last = rows[0].size() == 4 && std::all_of(rows.begin(), rows.end(), [&](const auto& r) { return r[3] == rows[0][3]; });
  const std::size_t first = rows[0].size() == 4 && !alpha_last ? 1 : 0;
  std::vector<Point> points;
  for (std::size_t i = 0; i < rows.size(); ++i)
    points.push_back({first ? rows[i][0] : static_cast<double>(i), {rows[i][first], rows[i][first + 1], rows[i][first + 2]}});
  scale_colors(points);
  if (palette || (first == 0 && rows.size() >= 64)) // a finished table
    for (const Point& p : points) map.entries.push_back(packed(p.rgb));
  else if (points.size() >= 2) map.entries = blended(std::move(points));
  map.categories = palette;
  return map;
}

// GMT: "z0 r g b z1 r g b" (or r/g/b) a line; B, F, N are the colors below, above and of NaN.
ColorMapFile cpt_map(std::string_view text, const std::string& name) {
  ColorMapFile map;
  std::vector<Point> points;
  std::vector<double> row;
  Cursor cursor(text);
  while (const auto line = cursor.next()) {
    std::string_view words = data::trim(line->text);
    words = data::trim(words.substr(0, words.find(';'))); // a label
    if (words.empty() || words[0] == '#') continue;
    const char mark = words[0];
    if (mark == 'B' || mark == 'F' || mark == 'N') {
      if (!numbers_of(words.substr(1), row) || row.size() != 3) refuse({name, line->number}, "B, F and N take r g b");
      (mark == 'B' ? map.below : mark == 'F' ? map.above : map.nan) = packed({row[0] / 255, row[1] / 255, row[2] / 255});
      continue;
    }
    if (!numbers_of(words, row) || row.size() != 8) refuse({name, line->number}, "a line of a .cpt file is z r g b z r g b");
    for (const std::size_t k : {std::size_t{0}, std::size_t{4}}) points.push_back({row[k], {row[k + 1] / 255, row[k + 2] / 255, row[k + 3] / 255}});
    if (points.size() > most_points) refuse({name, line->number}, "too many colors");
  }
  if (points.size() >= 2) map.entries = blended(std::move(points));
  return map;
}

// The list of numbers behind "name" : [ ... ] in JSON.
std::vector<double> json_numbers(std::string_view text, std::string_view name) {
  const std::size_t at = text.find(fmt::format("\"{}\"", name));
  const std::size_t begin = at == std::string_view::npos ? at : text.find('[', at);
  const std::size_t end = begin == std::string_view::npos ? begin : text.find(']', begin);
  std::vector<double> out;
  if (end == std::string_view::npos) return out;
  std::string list(text.substr(begin + 1, end - begin - 1));
  std::replace(list.begin(), list.end(), '\n', ' ');
  return numbers_of(list, out) ? out : std::vector<double>{};
}

ColorMapFile json_map(std::string_view text, const std::string& name) {
  ColorMapFile map;
  const std::vector<double> values = json_numbers(text, "RGBPoints");
  if (values.size() < 8 || values.size() % 4 != 0 || values.size() > 4 * most_points) refuse({name}, "there is no list \"RGBPoints\" of x, r, g, b in it");
  std::vector<Point> points;
  for (std::size_t i = 0; i < values.size(); i += 4) points.push_back({values[i], {values[i + 1], values[i + 2], values[i + 3]}});
  map.entries = blended(std::move(points));
  if (const std::vector<double> nan = json_numbers(text, "NanColor"); nan.size() == 3) map.nan = packed({nan[0], nan[1], nan[2]});
  return map;
}

ColorMapFile xml_map(std::string_view text, const std::string& name) {
  auto value = [](std::string_view tag, std::string_view key, double& out) {
    const std::string quoted = fmt::format(" {}=\"", key);
    const std::size_t at = tag.find(quoted);
    if (at == std::string_view::npos) return false;
    tag.remove_prefix(at + quoted.size());
    return data::parse_real(data::trim(tag.substr(0, tag.find('"'))), out) && std::isfinite(out);
  };
  std::vector<Point> points;
  for (std::size_t at = text.find("<Point"); at != std::string_view::npos; at = text.find("<Point", at + 1)) {
    const std::string_view tag = text.substr(at, text.find('>', at) - at);
    Point p;
    if (!value(tag, "x", p.at) || !value(tag, "r", p.rgb[0]) || !value(tag, "g", p.rgb[1]) || !value(tag, "b", p.rgb[2]))
      refuse({name}, "a <Point> lacks x, r, g or b");
    points.push_back(p);
    if (points.size() > most_points) refuse({name}, "too many colors");
  }
  ColorMapFile map;
  if (points.size() >= 2) map.entries = blended(std::move(points));
  return map;
}

} // namespace

bool is_color_map_file(std::string_view name) { return name.find_first_of("./") != std::string_view::npos; }

ColorMapFile parse_color_map(std::string_view text, const std::string& name) {
  const std::string_view start = data::trim(text.substr(0, std::min<std::size_t>(text.size(), 4096)));
  ColorMapFile map;
  if (start.starts_with('[') || start.starts_with('{')) map = json_map(text, name);
  else if (start.starts_with('<')) map = xml_map(text, name);
  else if (start.starts_with("GIMP Palette")) map = table_map(text.substr(text.find('\n') == std::string_view::npos ? text.size() : text.find('\n')), name, true);
  else if (name.ends_with(".cpt")) map = cpt_map(text, name);
  else map = table_map(text, name, false);
  if (map.entries.size() < 2) refuse({name}, "there are not two colors in it");
  return map;
}

ColorMapFile read_color_map(const std::filesystem::path& file, const SourceLoc& loc) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code error;
  if (!stream || std::filesystem::is_directory(file, error)) refuse(loc, fmt::format("the color map file '{}' cannot be read", file.string()));
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (text.size() > (std::size_t{16} << 20)) refuse({file.string()}, "the file is larger than any color map");
  return parse_color_map(text, file.string());
}

} // namespace mote
