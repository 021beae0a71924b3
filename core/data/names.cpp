// SPDX-License-Identifier: MIT
#include "core/data/names.hpp"

#include "core/data/codes.hpp"
#include "core/data/elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>

namespace mote::data {
namespace {

struct Canonical {
  std::string_view name{}, spellings{}; // lower case, between blanks
  std::uint32_t components{};
};

// Spellings of whole groups (extended XYZ, subarrays) and of single fields.
constexpr std::array<Canonical, 26> canonical_table{{
    {"position", " pos position positions coordinates coords points xyz ", 3},
    {"velocity", " velo vel velocity velocities v ", 3},
    {"force", " force forces f ", 3},
    {"momentum", " momentum momenta ", 3},
    {"dipole", " dipole dipoles mu ", 3},
    {"angular_velocity", " angular_velocity omega ", 3},
    {"angular_momentum", " angular_momentum angmom ", 3},
    {"torque", " torque torques tq ", 3},
    {"image", " image images image_flags pbc_image ", 3},
    {"orientation", " orientation orientations orient quat quaternion q ", 4},
    {"shape", " shape aspherical_shape ", 3},
    {"color", " color colour rgb ", 3},
    {"normal", " normal normals normal_vector normal_vectors ", 3},
    {"stress", " stress virial stresses stress_tensor ", 6},
    {"stress", " stress virial stresses stress_tensor ", 9},
    {"id", " id ids particle_id particle_identifier particleid tag atom_id index ", 1},
    {"type", " type types particle_type atom_types typeid typelabel ", 1},
    {"element", " element elements species symbol symbols atomic_symbol ", 1},
    {"atomic_number", " z_number atomic_number atomic_numbers numbers ", 1},
    {"radius", " radius r rad radii particle_radius ", 1},
    {"diameter", " diameter diameters diam d ", 1},
    {"mass", " mass masses m ", 1},
    {"charge", " charge charges q initial_charges ", 1},
    {"molecule", " mol molecule molecule_id molid mol_id molecule_identifier ", 1},
    {"transparency", " transparency ", 1},
    {"selection", " selection ", 1},
}};

// Single fields that are one component of a group, by themselves.
struct Part {
  std::string_view group{}, fields{}; // fields in the order of the components
  std::uint32_t components{};
};
constexpr std::array<Part, 20> parts{{
    {"position", "x y z", 3},
    {"position_scaled", "xs ys zs", 3},
    {"position_unwrapped", "xu yu zu", 3},
    {"position_scaled_unwrapped", "xsu ysu zsu", 3},
    {"velocity", "vx vy vz", 3},
    {"force", "fx fy fz", 3},
    {"image", "ix iy iz", 3},
    {"dipole", "mux muy muz", 3},
    {"angular_velocity", "omegax omegay omegaz", 3},
    {"angular_momentum", "angmomx angmomy angmomz", 3},
    {"torque", "tqx tqy tqz", 3},
    {"orientation", "quatw quati quatj quatk", 4},
    {"orientation", "qw qx qy qz", 4},
    {"orientation", "quat_w quat_x quat_y quat_z", 4},
    {"orientation", "orientation_w orientation_x orientation_y orientation_z", 4},
    {"shape", "shapex shapey shapez", 3},
    {"normal", "nx ny nz", 3},
    {"color", "r g b", 3},
    {"color", "red green blue", 3},
    {"stress", "sxx syy szz sxy sxz syz", 6},
}};

// Quantities that are doubles even where a file happens to hold whole numbers.
constexpr std::string_view real_quantities =
    " position position_scaled position_unwrapped position_scaled_unwrapped velocity force momentum dipole "
    "angular_velocity angular_momentum torque orientation shape normal stress radius diameter mass charge "
    "transparency ";

bool has_spelling(std::string_view spellings, std::string_view word) {
  return spellings.find(fmt::format(" {} ", word)) != std::string_view::npos;
}

// "name_x", "name.y", "name:z", "name[1]", "name:0" -> ("name", component as written, from 0 or 1).
struct Indexed {
  std::string base{};
  std::int64_t index{};
  bool letter{};
};
std::optional<Indexed> indexed(std::string_view name) {
  if (name.size() >= 3) {
    const char letter = static_cast<char>(name.back() | 0x20);
    const char mark = name[name.size() - 2];
    if (letter >= 'x' && letter <= 'z' && (mark == '_' || mark == '.' || mark == ':' || mark == ' '))
      return Indexed{std::string(name.substr(0, name.size() - 2)), letter - 'x', true};
  }
  const std::size_t open = name.ends_with(']') ? name.rfind('[') : name.rfind(':');
  if (open == std::string_view::npos || open == 0) return std::nullopt;
  const std::string_view digits = name.substr(open + 1, name.size() - open - (name.ends_with(']') ? 2 : 1));
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (error != std::errc{} || end != digits.data() + digits.size() || index < 0) return std::nullopt;
  return Indexed{std::string(name.substr(0, open)), index, false};
}

// A unit at the end of a table's heading: "x (nm)", "x [nm]", "x/nm"; an index such as [1] is none.
std::string take_unit(std::string& name) {
  std::size_t open = std::string::npos;
  std::string unit;
  if (name.ends_with(')')) open = name.rfind('(');
  if (name.ends_with(']') && !indexed(name)) open = name.rfind('[');
  if (open != std::string::npos && open > 0) {
    unit = name.substr(open + 1, name.size() - open - 2);
  } else if (open = name.rfind('/'); open != std::string::npos && open > 0) {
    unit = name.substr(open + 1);
  } else {
    return {};
  }
  name = std::string(trim(std::string_view(name).substr(0, open)));
  return unit;
}

// Builds the layout field by field; see plan_columns().
class Planner {
public:
  Planner(std::span<const Declared> declared, const Customs& customs) : customs_(customs) {
    for (const Declared& d : declared) {
      names_.push_back(d.name);
      units_.push_back(customs.units_in_names ? take_unit(names_.back()) : std::string{});
    }
    declared_ = declared;
    owner_.assign(declared.size(), {-1, 0});
    for (const Part& part : parts) group_part(part);
    group_indexed();
    RowLayout& out = layout_;
    for (std::size_t d = 0; d < declared.size(); ++d) place(d, out);
  }
  RowLayout take() { return std::move(layout_); }

private:
  struct Group {
    std::string name{}, unit{};
    std::uint32_t components{};
    int column{-1};
  };

  bool free_single(std::size_t d) const { return owner_[d].first < 0 && declared_[d].components == 1; }

  // All fields of `part` present -> one group of them. The first field of a name counts.
  void group_part(const Part& part) {
    std::vector<std::size_t> found;
    Words words(part.fields);
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
      for (std::size_t d = 0; d < names_.size(); ++d)
        if (free_single(d) && same_word(names_[d], word)) {
          found.push_back(d);
          break;
        }
    if (found.size() == part.components) add_group(std::string(part.group), found);
  }

  void add_group(std::string name, const std::vector<std::size_t>& fields) {
    const bool text = std::any_of(fields.begin(), fields.end(),
                                  [&](std::size_t d) { return declared_[d].kind == Cell::Text; });
    if (text && name != "position")
      return; // words do not form vectors; for a position that is an error later
    const int group = static_cast<int>(groups_.size());
    groups_.push_back(
        {std::move(name), units_[fields.front()], static_cast<std::uint32_t>(fields.size()), -1});
    for (std::size_t k = 0; k < fields.size(); ++k)
      owner_[fields[k]] = {group, static_cast<std::uint32_t>(k)};
  }

  // name[1..k], name:0.., name_x.. when complete and starting at 0 or 1.
  void group_indexed() {
    std::map<std::pair<std::string, bool>, std::map<std::int64_t, std::size_t>> sets;
    for (std::size_t d = 0; d < names_.size(); ++d)
      if (const auto part = indexed(names_[d]); part && free_single(d))
        sets[{part->base, part->letter}].try_emplace(part->index, d);
    for (const auto& [key, members] : sets) {
      const std::int64_t first = members.begin()->first;
      const bool complete = members.rbegin()->first - first + 1 == static_cast<std::int64_t>(members.size());
      if (!complete || first > 1 || members.size() < 2 || (key.second && (members.size() != 3 || first != 0)))
        continue;
      std::vector<std::size_t> fields;
      for (const auto& [index, d] : members) fields.push_back(d);
      add_group(computed_name(key.first, static_cast<std::uint32_t>(fields.size())), fields);
    }
  }

  // LAMMPS's computes, fixes and variables (c_ f_ v_): known words lose the prefix.
  static std::string computed_name(const std::string& base, std::uint32_t components) {
    const bool prefixed =
        base.size() > 2 && base[1] == '_' && (base[0] == 'c' || base[0] == 'f' || base[0] == 'v');
    if (prefixed && components > 1) {
      const std::string inner = base.substr(2);
      const std::string name = canonical_name(inner, components);
      if (name == "stress" || name == "orientation" || name == "shape") return name;
      return base;
    }
    return base;
  }

  void place(std::size_t d, RowLayout& out) {
    const auto [group, component] = owner_[d];
    if (group >= 0) {
      Group& members = groups_[static_cast<std::size_t>(group)];
      if (members.column < 0)
        members.column = add_column(members.name, members.components, members.unit, declared_[d], out);
      add_field(d, static_cast<std::uint32_t>(members.column), component, out);
      return;
    }
    const int column = add_column(names_[d], declared_[d].components, units_[d], declared_[d], out);
    for (std::uint32_t k = 0; k < declared_[d].components; ++k)
      add_field(d, static_cast<std::uint32_t>(column), k, out);
  }

  void add_field(std::size_t d, std::uint32_t column, std::uint32_t component, RowLayout& out) {
    const bool turned =
        customs_.quaternion_is_xyzw && out.columns[column].name == "orientation" && owner_[d].first < 0;
    Cell kind = declared_[d].kind;
    if (has_spelling(real_quantities, out.columns[column].name)) kind = Cell::Real;
    out.fields.push_back({kind, column, turned ? (component + 1) % 4 : component,
                          declared_[d].components == 1
                              ? declared_[d].name
                              : fmt::format("{}[{}]", declared_[d].name, component + 1)});
  }

  int add_column(const std::string& raw, std::uint32_t components, const std::string& unit,
                 const Declared& from, RowLayout& out) {
    RowColumn column{canonical_name(raw, components), components, 1.0, unit, from.promote};
    if (column.name == "diameter" && !wants("radius")) {
      column.name = "radius";
      column.scale = 0.5;
    }
    if (column.name == "shape" && customs_.shape_is_diameter) column.scale = 0.5;
    if (column.name == "orientation") column.unit = "wxyz";
    if (has_spelling(real_quantities, column.name)) column.promote = false;
    if (taken(column.name, out)) column.name = raw; // the first one keeps the canonical name
    for (int n = 2; taken(column.name, out); ++n) column.name = fmt::format("{}_{}", raw, n);
    out.columns.push_back(std::move(column));
    return static_cast<int>(out.columns.size() - 1);
  }
  static bool taken(std::string_view name, const RowLayout& out) {
    return std::any_of(out.columns.begin(), out.columns.end(),
                       [&](const RowColumn& c) { return c.name == name; });
  }
  bool wants(std::string_view canonical) const {
    for (std::size_t d = 0; d < names_.size(); ++d)
      if (canonical_name(names_[d], declared_[d].components) == canonical && owner_[d].first < 0) return true;
    return false;
  }

  Customs customs_;
  std::span<const Declared> declared_{};
  std::vector<std::string> names_{}, units_{};
  std::vector<std::pair<int, std::uint32_t>> owner_{}; // group and component of each declared field
  std::vector<Group> groups_{};
  RowLayout layout_{};
};

} // namespace

std::string canonical_name(std::string_view name, std::uint32_t components) {
  std::string word = lower(name);
  std::replace(word.begin(), word.end(), ' ', '_');
  std::replace(word.begin(), word.end(), '-', '_');
  for (const Canonical& entry : canonical_table)
    if (entry.components == components && has_spelling(entry.spellings, word)) return std::string(entry.name);
  if (components == 1 && name == "Z") return "atomic_number";
  return std::string(name);
}

RowLayout plan_columns(std::span<const Declared> declared, const Customs& customs) {
  return Planner(declared, customs).take();
}

void require_position(const RowLayout& layout, std::span<const Declared> declared, const SourceLoc& loc) {
  const bool there = std::any_of(layout.columns.begin(), layout.columns.end(), [](const RowColumn& c) {
    return c.name == "position" && c.components == 3;
  });
  if (there) return;
  std::vector<std::string> names;
  for (const Declared& d : declared) {
    if (names.size() == 20) {
      names.push_back("...");
      break;
    }
    names.push_back(d.components == 1 ? d.name : fmt::format("{}({})", d.name, d.components));
  }
  fail(Exit::BadInput, code::no_position, loc, "no columns give the position (x, y and z)",
       {fmt::format("the file has: {}", list_of(names))});
}

void finish_columns(std::vector<Column>& columns) {
  auto has = [&](std::string_view name) {
    return std::any_of(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  };
  const bool has_type = has("type");
  bool has_element = has("element");
  for (Column& column : columns) {
    if (column.name == "element" && !has_type) {
      const auto* text = std::get_if<TextColumn>(&column.values);
      const bool symbols =
          text && std::all_of(text->dictionary.begin(), text->dictionary.end(), [](const std::string& label) {
            return find_element(label) || label == "X" || label == "Xx";
          });
      if (!symbols) column.name = "type", has_element = false;
    }
    const auto* numbers = std::get_if<std::vector<std::int64_t>>(&column.values);
    if (column.name != "atomic_number" || has_element || !numbers) continue;
    if (!std::all_of(numbers->begin(), numbers->end(), [](std::int64_t z) { return z == 0 || element(z); }))
      continue;
    TextColumn symbols;
    std::array<std::int64_t, 119> codes{};
    for (const std::int64_t z : *numbers) {
      std::int64_t& known = codes[static_cast<std::size_t>(z)];
      if (known == 0) {
        symbols.dictionary.emplace_back(z == 0 ? "X" : element(z)->symbol);
        known = static_cast<std::int64_t>(symbols.dictionary.size());
      }
      symbols.codes.push_back(static_cast<std::uint32_t>(known - 1));
    }
    column.values = std::move(symbols);
    column.name = "element";
  }
}

} // namespace mote::data
