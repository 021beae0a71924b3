// SPDX-License-Identifier: MIT
// A function of one channel as a table over the bits of a float: 64 linear cells per octave, from
// 2^-15 to 2^17, for both signs. Finding the cell costs a shift instead of a logarithm, and the
// relative step of 1/64 keeps a smooth curve within about 3e-5 of its value. DisplayTransform bakes
// runs of per-channel arithmetic (logarithms, spline curves) into one; display_glsl.cpp writes the
// same lookup in GLSL. Pure arithmetic: no OCIO, no device.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mote {

class CurveTable {
public:
  static constexpr std::uint32_t cells_per_sign = 2048, cells = 2 * cells_per_sign;
  static constexpr std::uint32_t shift = 17;        // a cell is 2^17 consecutive bit patterns
  static constexpr std::uint32_t first_cell = 7168; // bits(2^-15) >> shift
  static constexpr float bias = 0x1p-15f;           // added to |x|: the cells next to zero are linear in x
  static constexpr float largest = 131071.9921875f; // the float below 2^17; |x| + bias is cut there

  // `evaluate` maps n RGB triples in place (3 n floats), each channel by itself.
  explicit CurveTable(const std::function<void(std::span<float>)>& evaluate);

  // False when a node is not finite; such a function cannot be baked.
  [[nodiscard]] bool usable() const { return usable_; }
  // 1 when the three channels are the same function, else 3.
  [[nodiscard]] std::uint32_t rows() const { return rows_; }
  // [rows][cells][2]: value at the cell's start, and the rise to the next node. Cells of x >= 0 first.
  [[nodiscard]] const std::vector<float>& data() const { return data_; }
  [[nodiscard]] float operator()(std::uint32_t channel, float x) const; // finite x

private:
  bool usable_{true};
  std::uint32_t rows_{3};
  std::vector<float> data_;
};

} // namespace mote
