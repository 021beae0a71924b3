// SPDX-License-Identifier: MIT
#include "passes/frame.hpp"

#include <array>

namespace mote::passes {
namespace {
constexpr std::array<std::string_view, 5> names{"auto", "vertex", "geometry", "compute", "point"};
}

std::string_view to_string(Expansion expansion) { return names[static_cast<std::size_t>(expansion)]; }
std::span<const std::string_view> expansion_names() { return names; }

bool parse_expansion(std::string_view name, Expansion& out) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) {
      out = static_cast<Expansion>(i);
      return true;
    }
  return false;
}

} // namespace mote::passes
