// SPDX-License-Identifier: MIT
#include "core/data/lammps_styles.hpp"

#include "core/data/text.hpp"

#include <array>

namespace mote::data {
namespace {

constexpr std::array<LammpsStyle, 22> styles{{
    {"atomic", "id type x y z"},
    {"charge", "id type q x y z"},
    {"bond", "id mol type x y z"},
    {"angle", "id mol type x y z"},
    {"molecular", "id mol type x y z"},
    {"full", "id mol type q x y z"},
    {"sphere", "id type diameter density x y z"},
    {"bpm/sphere", "id mol type diameter density x y z"},
    {"ellipsoid", "id type ellipsoidflag density x y z"},
    {"body", "id type bodyflag mass x y z"},
    {"line", "id mol type lineflag density x y z"},
    {"tri", "id mol type triangleflag density x y z"},
    {"dipole", "id type q x y z mux muy muz"},
    {"dielectric", "id type q x y z mux muy muz area ed em epsilon curvature"},
    {"dpd", "id type theta x y z"},
    {"edpd", "id type edpd_temp edpd_cv x y z"},
    {"mdpd", "id type rho x y z"},
    {"electron", "id type q espin eradius x y z"},
    {"peri", "id type volume density x y z"},
    {"sph", "id type rho esph cv x y z"},
    {"spin", "id type x y z spx spy spz sp"},
    {"template", "id mol template_index template_atom type x y z"},
}};

} // namespace

std::span<const LammpsStyle> lammps_styles() { return styles; }

const LammpsStyle* find_lammps_style(std::string_view name) {
  for (const LammpsStyle& style : styles)
    if (style.name == name) return &style;
  return nullptr;
}

const LammpsStyle* guess_lammps_style(std::span<const std::string_view> words, bool bonded,
                                      std::uint64_t types) {
  if (words.size() < 5) return nullptr;
  std::uint64_t third = 0;
  const bool third_is_type = parse_count(words[2], third) && third >= 1 && third <= types;
  switch (words.size()) {
  case 5:
  case 8: return find_lammps_style("atomic");
  case 6:
  case 9: return find_lammps_style(bonded || third_is_type ? "molecular" : "charge");
  case 7:
  case 10: return find_lammps_style(bonded || third_is_type ? "full" : "sphere");
  default: return nullptr;
  }
}

} // namespace mote::data
