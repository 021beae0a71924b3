// SPDX-License-Identifier: MIT
#include "core/color/parse_color.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mote {

namespace {
// CSS Color Module Level 4, "named colors": the 16 basic ones and six in daily use.
constexpr std::array<std::pair<std::string_view, std::uint32_t>, 22> names{{
    {"black", 0x000000},   {"silver", 0xc0c0c0}, {"gray", 0x808080},    {"grey", 0x808080},
    {"white", 0xffffff},   {"maroon", 0x800000}, {"red", 0xff0000},     {"purple", 0x800080},
    {"fuchsia", 0xff00ff}, {"green", 0x008000},  {"lime", 0x00ff00},    {"olive", 0x808000},
    {"yellow", 0xffff00},  {"navy", 0x000080},   {"blue", 0x0000ff},    {"teal", 0x008080},
    {"aqua", 0x00ffff},    {"cyan", 0x00ffff},   {"magenta", 0xff00ff}, {"orange", 0xffa500},
    {"pink", 0xffc0cb},    {"brown", 0xa52a2a},
}};

ParsedColor from_rgb24(std::uint32_t v) {
  return {{((v >> 16) & 255u) / 255.0, ((v >> 8) & 255u) / 255.0, (v & 255u) / 255.0}};
}

std::optional<ParsedColor> from_hex(std::string_view digits) {
  if (digits.size() != 3 && digits.size() != 6 && digits.size() != 8) return std::nullopt;
  std::uint32_t v = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), v, 16);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  if (digits.size() == 3)
    return from_rgb24(((v >> 8) & 15u) * 0x110000u + ((v >> 4) & 15u) * 0x1100u + (v & 15u) * 0x11u);
  if (digits.size() == 6) return from_rgb24(v);
  ParsedColor color = from_rgb24(v >> 8);
  color.alpha = (v & 255u) / 255.0;
  color.has_alpha = true;
  return color;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}
} // namespace

ParsedColor parse_color(std::string_view text, const SourceLoc& loc) {
  if (!text.empty() && text.front() == '#') {
    if (const auto color = from_hex(text.substr(1))) return *color;
    fail(Exit::BadInput, "C008", loc, fmt::format("'{}' is not a color", text),
         {"after '#' come 3, 6 or 8 hexadecimal digits: \"#rgb\", \"#rrggbb\" or \"#rrggbbaa\""});
  }
  const std::string word = lower(text);
  if (word == "transparent") return {{0, 0, 0}, 0.0, true};
  std::vector<std::string> exist;
  for (const auto& [name, value] : names) {
    if (name == word) return from_rgb24(value);
    exist.emplace_back(name);
  }
  exist.emplace_back("transparent");
  fail(Exit::BadInput, "C008", loc, fmt::format("'{}' is not a color", text),
       {did_you_mean(text, exist),
        "a color is \"#rgb\", \"#rrggbb\", \"#rrggbbaa\", [r, g, b] or one of: " + list_of(exist)});
}

ParsedColor parse_color(std::span<const double> numbers, const SourceLoc& loc) {
  if (numbers.size() != 3 && numbers.size() != 4)
    fail(Exit::BadInput, "C009", loc,
         fmt::format("a color has 3 or 4 numbers, [r, g, b] or [r, g, b, a], not {}", numbers.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double v = numbers[i];
    if (!std::isfinite(v))
      fail(Exit::BadInput, "C009", loc, fmt::format("the color component '{}' is not a finite number", v));
    if (v < 0 || (i == 3 && v > 1))
      fail(Exit::BadInput, "C009", loc,
           fmt::format("the {} '{}' of a color is outside {}", i == 3 ? "alpha" : "component", v,
                       i == 3 ? "0..1" : "0 and above"));
  }
  ParsedColor color{{numbers[0], numbers[1], numbers[2]}};
  if (numbers.size() == 4) {
    color.alpha = numbers[3];
    color.has_alpha = true;
  }
  return color;
}

} // namespace mote
