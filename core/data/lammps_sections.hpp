// SPDX-License-Identifier: MIT
// The skeleton of a LAMMPS data file: title, counts, box and where its sections begin. One look through
// the lines; no rows are read. reader_lammps_data.cpp calls it. Errors D008, D012, D013, D014.
#pragma once

#include "core/data/dataset.hpp"
#include "core/data/text.hpp"

#include <map>
#include <string>
#include <string_view>

namespace mote::data {

struct LammpsSections {
  struct Section {
    Line heading{};
    Cursor begin{}; // behind the heading
  };
  std::string title{};
  std::map<std::string, std::uint64_t, std::less<>> counts{}; // "atoms", "bonds", "atom types", "ellipsoids"
  std::map<std::string, Section, std::less<>> sections{};     // "Atoms" is among them
  Box box{};
  [[nodiscard]] std::uint64_t count(std::string_view what) const; // 0 when not stated
};

LammpsSections find_lammps_sections(const std::string& file, std::string_view text);

// A line before and behind its '#', without blanks around.
[[nodiscard]] std::string_view without_comment(std::string_view line);
[[nodiscard]] std::string_view comment_of(std::string_view line);

} // namespace mote::data
