// SPDX-License-Identifier: MIT
// The different colors of many particles, where they are so few that a byte can name one: what elements, types,
// categories and generated scenes have. The chunk builder then keeps a byte a particle instead of a word.
//
// find_palette() looks at every color once, on all cores, and gives up as soon as it has met one too many. Its
// answer depends on the set of colors alone: neither on their order nor on the number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mote {

constexpr std::size_t most_palette_colors = 256;

class Palette {
public:
  // False: there is no room for one more, and nothing has changed.
  bool add(std::uint32_t color);
  // Numbers the colors in ascending order.
  void sort();
  [[nodiscard]] const std::vector<std::uint32_t>& colors() const { return colors_; }
  // Where a color is among colors(); it must have been added.
  [[nodiscard]] std::uint8_t index_of(std::uint32_t color) const { return static_cast<std::uint8_t>(numbers_[place_of(color)] - 1u); }

private:
  static constexpr std::size_t places = 4 * most_palette_colors; // a table with open addressing, a quarter full at most
  // Where a color is or belongs. It starts at the upper bits of a product with 2^32 over the golden ratio (Knuth, The Art of
  // Computer Programming 3, 6.4).
  [[nodiscard]] std::size_t place_of(std::uint32_t color) const {
    std::size_t at = (color * 0x9E3779B1u) >> 22;
    while (numbers_[at] != 0 && keys_[at] != color) at = (at + 1) % places;
    return at;
  }

  std::array<std::uint32_t, places> keys_{};
  std::array<std::uint16_t, places> numbers_{}; // from 1; 0: nothing is there
  std::vector<std::uint32_t> colors_{};
};

// The palette of `colors`, sorted; none: there are no colors, or more than 256 different ones.
std::optional<Palette> find_palette(std::span<const std::uint32_t> colors);

} // namespace mote
