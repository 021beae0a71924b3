// SPDX-License-Identifier: MIT
#include "core/data/lammps_sections.hpp"

#include "core/data/codes_molecular.hpp"
#include "core/data/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::data {
namespace {

bool is_section(std::string_view text) {
  constexpr std::array<std::string_view, 19> plain{"Atoms",
                                                   "Velocities",
                                                   "Masses",
                                                   "Bonds",
                                                   "Angles",
                                                   "Dihedrals",
                                                   "Impropers",
                                                   "Ellipsoids",
                                                   "Lines",
                                                   "Triangles",
                                                   "Bodies",
                                                   "Atom Type Labels",
                                                   "Bond Type Labels",
                                                   "Angle Type Labels",
                                                   "Dihedral Type Labels",
                                                   "Improper Type Labels",
                                                   "CS-Info",
                                                   "Fix",
                                                   "Special Bonds"};
  return text.ends_with("Coeffs") || std::find(plain.begin(), plain.end(), text) != plain.end();
}

class Skeleton {
public:
  Skeleton(const std::string& file, std::string_view text) : file_(file), cursor_(text) {}

  LammpsSections find() {
    if (const auto first = cursor_.next()) out_.title = trim(first->text);
    while (const auto line = cursor_.next()) read_line(*line);
    if (!out_.sections.contains("Atoms"))
      fail(Exit::BadInput, code::no_position, {file_}, "there is no section Atoms");
    if (out_.count("atoms") == 0)
      fail(Exit::BadInput, code::heading, {file_}, "the number of atoms is missing or 0 ('N atoms')");
    const glm::dvec3 size = high_ - low_;
    out_.box.origin = low_;
    out_.box.edges = glm::dmat3(size.x, 0, 0, tilt_.x, size.y, 0, tilt_.y, tilt_.z, size.z);
    return std::move(out_);
  }

private:
  // A heading begins with a capital; before the first one stand counts and the box.
  void read_line(const Line& line) {
    const std::size_t first = line.text.find_first_not_of(" \t");
    if (first == std::string_view::npos || line.text[first] == '#') return;
    const bool capital = line.text[first] >= 'A' && line.text[first] <= 'Z';
    if (!capital && !out_.sections.empty()) return;
    const std::string_view text = without_comment(line.text);
    if (!capital || !is_section(text)) {
      if (out_.sections.empty()) read_header(line, text);
    } else if (!out_.sections.try_emplace(std::string(text), LammpsSections::Section{line, cursor_}).second) {
      fail(Exit::BadInput, code::heading, {file_, line.number},
           fmt::format("there is a second section '{}'", text));
    }
  }

  double real(const Line& line, std::string_view word) const {
    double value = 0;
    if (!parse_real(word, value) || !std::isfinite(value))
      fail(Exit::BadInput, code::box, place_in(file_, line, word),
           fmt::format("{} in the box is not a number", shown(word)));
    return value;
  }

  // "100 atoms", "2 atom types", "-1.5 1.5 xlo xhi", "0 0 0 xy xz yz"; other lines are not needed.
  void read_header(const Line& line, std::string_view text) {
    const std::vector<std::string_view> words = split_row(text, ' ');
    if (words.size() == 4 && words[2].size() == 3 && words[2].ends_with("lo") && words[2][0] >= 'x' &&
        words[2][0] <= 'z') {
      const int axis = words[2][0] - 'x';
      low_[axis] = real(line, words[0]);
      high_[axis] = real(line, words[1]);
      if (!(high_[axis] >= low_[axis]))
        fail(Exit::BadInput, code::box, {file_, line.number},
             fmt::format("the box ends at {} before it begins at {}", high_[axis], low_[axis]));
    } else if (words.size() == 6 && words[3] == "xy") {
      tilt_ = {real(line, words[0]), real(line, words[1]), real(line, words[2])};
    } else if (words.size() >= 2) {
      read_count(line, words);
    }
  }

  void read_count(const Line& line, const std::vector<std::string_view>& words) {
    std::string key(words[1]);
    if (words.size() == 3 && words[2] == "types") key += " types";
    if (key != "atoms" && key != "bonds" && key != "atom types" && key != "ellipsoids") return;
    std::uint64_t count = 0;
    if (!parse_count(words[0], count))
      fail(Exit::BadInput, code::heading, place_in(file_, line, words[0]),
           fmt::format("the number of {} is {}", key, shown(words[0])));
    out_.counts[key] = count;
  }

  const std::string& file_;
  Cursor cursor_;
  LammpsSections out_{};
  glm::dvec3 low_{-0.5}, high_{0.5}, tilt_{0.0}; // LAMMPS' own defaults
};

} // namespace

std::string_view without_comment(std::string_view line) { return trim(line.substr(0, line.find('#'))); }

std::string_view comment_of(std::string_view line) {
  const std::size_t mark = line.find('#');
  return mark == std::string_view::npos ? std::string_view{} : trim(line.substr(mark + 1));
}

std::uint64_t LammpsSections::count(std::string_view what) const {
  const auto found = counts.find(what);
  return found == counts.end() ? 0 : found->second;
}

LammpsSections find_lammps_sections(const std::string& file, std::string_view text) {
  return Skeleton(file, text).find();
}

} // namespace mote::data
