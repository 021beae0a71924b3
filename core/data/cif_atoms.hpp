// SPDX-License-Identifier: MIT
// Rows of the category _atom_site -> columns. reader_mmcif.cpp fills row() with the values of a row and
// calls add(). It knows no files and no models. Errors D012 at the value.
#pragma once

#include "core/data/cif.hpp"
#include "core/data/molecule.hpp"

#include <array>
#include <unordered_map>

namespace mote::data {

class CifAtoms {
public:
  // `items`: what the columns of the loop are called; Cartn_x, Cartn_y and Cartn_z are among them. `by_id`: add_anisou()
  // will be called with rows.
  CifAtoms(const std::string& file, const std::vector<std::string_view>& items, bool by_id);
  [[nodiscard]] std::vector<CifToken>& row() { return row_; }
  void add();
  // Rows of _atom_site_anisotrop belong to the atoms with their id; false when some belong to none.
  bool add_anisou(const CifTable& table);
  void give(Frame& frame) { columns_.give(frame); }

private:
  enum Item : std::size_t {
    X,
    Y,
    Z,
    Occupancy,
    BFactor,
    Id,
    Symbol,
    AuthAtom,
    LabelAtom,
    AuthResidue,
    LabelResidue,
    AuthSequence,
    LabelSequence,
    AuthChain,
    LabelChain,
    Altloc,
    Insertion,
    Group
  };
  static constexpr std::array<std::string_view, 18> wanted{
      "Cartn_x",      "Cartn_y",      "Cartn_z",       "occupancy",    "B_iso_or_equiv",    "id",
      "type_symbol",  "auth_atom_id", "label_atom_id", "auth_comp_id", "label_comp_id",     "auth_seq_id",
      "label_seq_id", "auth_asym_id", "label_asym_id", "label_alt_id", "pdbx_PDB_ins_code", "group_PDB"};

  [[noreturn]] void refuse(const CifToken& where, std::string what) const;
  [[nodiscard]] const CifToken* token(Item item) const; // nullptr: ? or . or no such item
  [[nodiscard]] std::string_view text(Item item) const;
  [[nodiscard]] std::string_view text(Item item, Item otherwise) const;
  [[nodiscard]] double real(Item item, double otherwise, bool needed) const;
  [[nodiscard]] std::int64_t integer(Item item, std::int64_t otherwise) const;

  const std::string& file_;
  bool by_id_{};
  std::array<int, wanted.size()> at_{};
  std::vector<CifToken> row_{};
  AtomColumns columns_{};
  std::unordered_map<std::string_view, std::uint64_t> rows_of_id_{};
};

} // namespace mote::data
