// SPDX-License-Identifier: MIT
// The atom styles of LAMMPS data files: which values a row of the section Atoms has, in which order
// (docs.lammps.org/read_data.html). reader_lammps_data.cpp calls it. Three image flags may follow.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::data {

struct LammpsStyle {
  std::string_view name{};
  std::string_view fields{}; // between blanks, from the id to the last value
};

[[nodiscard]] std::span<const LammpsStyle> lammps_styles();
[[nodiscard]] const LammpsStyle* find_lammps_style(std::string_view name); // nullptr = unknown
// The style that a first row of `words` (image flags included, no comment) suggests, nullptr = none.
// `bonded`: the file has bonds. `types`: its number of atom types.
[[nodiscard]] const LammpsStyle* guess_lammps_style(std::span<const std::string_view> words, bool bonded,
                                                    std::uint64_t types);

} // namespace mote::data
