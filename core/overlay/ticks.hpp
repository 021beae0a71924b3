// SPDX-License-Identifier: MIT
// Numbers for scales: round steps (1, 2, 5 times a power of ten), labels that say no more than the step
// needs, raised powers for large and small numbers, lengths for scale bars, units as people write them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mote::overlay {

struct Tick {
  double value{};
  std::string label{};
};
// Within [low, high] (either order), about `wanted` of them. Logarithmic: powers of ten, and 2 and 5 times them where
// the range is short; both ends are above 0.
[[nodiscard]] std::vector<Tick> ticks(double low, double high, int wanted, bool logarithmic);
// The largest of 1, 2, 5 times a power of ten that is at most `longest` > 0.
[[nodiscard]] double round_length(double longest);
// "12.5", "3×10⁻⁷"; `step`: the distance to the next number shown, 0 for a number alone.
[[nodiscard]] std::string number_label(double value, double step);
// "A" -> "Å", "A^2" -> "Å²", "um" -> "µm"; "A/m" (of amperes) and anything else as it is.
[[nodiscard]] std::string unit_label(std::string_view unit);

} // namespace mote::overlay
