// SPDX-License-Identifier: MIT
// The chemical elements: masses, radii and the colors that people expect, and colors for particle
// types that are mere numbers. The scene calls it to give radii and colors to particles; readers call
// it to tell element symbols from other labels. A table of facts: nothing here can be configured.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace mote::data {

struct Element {
  int number{};
  std::string_view symbol{}, name{};
  double mass{};           // u
  float covalent_radius{}; // A; 0 = not known
  float bondi_radius{};    // van der Waals after Bondi, A; 0 = not known
  float alvarez_radius{};  // van der Waals after Alvarez, A; 0 = not known
  std::uint32_t color{};   // 0xRRGGBB, sRGB-encoded: decode before lighting
  // Bondi's where there is one, Alvarez' for the others (metals), 0 if neither is known.
  [[nodiscard]] constexpr float vdw_radius() const {
    return bondi_radius > 0 ? bondi_radius : alvarez_radius;
  }
};

inline constexpr std::uint32_t unknown_color = 0xff1493; // Jmol's color of what is not an element

[[nodiscard]] std::span<const Element> elements();         // 1 = H at index 0
[[nodiscard]] const Element* element(std::int64_t number); // nullptr outside 1..118
// The element that a label names: its symbol in any case, perhaps with a number, charge or mark
// behind it ("C", "FE", "o2", "Na+", "H1'"); D and T are hydrogen. nullptr for all else ("CT", "A").
[[nodiscard]] const Element* find_element(std::string_view label);
// OVITO's color of particle type 1, 2, ... as 0xRRGGBB, sRGB-encoded; nine colors in turn.
[[nodiscard]] std::uint32_t type_color(std::int64_t type);

} // namespace mote::data
