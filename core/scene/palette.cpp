// SPDX-License-Identifier: MIT
#include "core/scene/palette.hpp"

#include "core/base/parallel.hpp"

#include <algorithm>
#include <atomic>

namespace mote {
namespace {
constexpr std::uint64_t block = 1 << 14; // colors between two looks at whether another thread has given up
}

bool Palette::add(std::uint32_t color) {
  const std::size_t at = place_of(color);
  if (numbers_[at] != 0) return true;
  if (colors_.size() == most_palette_colors) return false;
  colors_.push_back(color);
  keys_[at] = color;
  numbers_[at] = static_cast<std::uint16_t>(colors_.size());
  return true;
}

void Palette::sort() {
  std::sort(colors_.begin(), colors_.end());
  for (std::size_t i = 0; i < colors_.size(); ++i) numbers_[place_of(colors_[i])] = static_cast<std::uint16_t>(i + 1);
}

std::optional<Palette> find_palette(std::span<const std::uint32_t> colors) {
  if (colors.empty()) return {};
  std::vector<Palette> parts(thread_count(colors.size(), 16 * block));
  std::atomic<bool> too_many{false};
  parallel_parts(colors.size(), static_cast<std::uint32_t>(parts.size()), [&](std::uint32_t part, std::uint64_t begin, std::uint64_t end) {
    Palette& own = parts[part];
    std::uint32_t last = ~colors[begin];
    for (std::uint64_t i = begin; i < end; ++i) {
      if (i % block == 0 && too_many) return;
      if (colors[i] == last) continue; // runs of one color are common
      last = colors[i];
      if (own.add(last)) continue;
      too_many = true;
      return;
    }
  });
  if (too_many) return {};
  for (std::size_t part = 1; part < parts.size(); ++part)
    for (const std::uint32_t color : parts[part].colors())
      if (!parts.front().add(color)) return {};
  parts.front().sort();
  return std::move(parts.front());
}

} // namespace mote
