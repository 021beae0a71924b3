// SPDX-License-Identifier: MIT
#include "core/data/cif_atoms.hpp"

#include "core/data/codes_molecular.hpp"
#include "core/data/elements.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

namespace mote::data {

CifAtoms::CifAtoms(const std::string& file, const std::vector<std::string_view>& items, bool by_id) : file_(file), by_id_(by_id) {
  CifTable names;
  names.items = items;
  for (std::size_t k = 0; k < wanted.size(); ++k) at_[k] = names.item(wanted[k]);
  row_.resize(items.size());
}

void CifAtoms::add() {
  for (const Item axis : {X, Y, Z}) columns_.positions.push_back(real(axis, 0, true));
  columns_.occupancies.push_back(real(Occupancy, 1, false));
  columns_.b_factors.push_back(real(BFactor, 0, false));
  const std::string_view name = text(AuthAtom, LabelAtom), residue = text(AuthResidue, LabelResidue);
  if (by_id_) rows_of_id_.try_emplace(text(Id), columns_.count); // a third of the time of reading
  columns_.ids.push_back(integer(Id, static_cast<std::int64_t>(columns_.count + 1)));
  const Element* known = find_element(text(Symbol));
  columns_.elements.add(known ? known->symbol : element_of_name(name, residue));
  columns_.names.add(name);
  columns_.residues.add(residue);
  columns_.residue_ids.push_back(integer(token(AuthSequence) ? AuthSequence : LabelSequence, 0));
  columns_.chains.add(text(AuthChain, LabelChain));
  columns_.chain_labels.add(text(LabelChain, AuthChain));
  columns_.altlocs.add(text(Altloc));
  columns_.insertions.add(text(Insertion));
  columns_.hetero.push_back(text(Group) == "HETATM" ? 1 : 0);
  ++columns_.count;
}

bool CifAtoms::add_anisou(const CifTable& table) {
  constexpr std::array<std::string_view, 6> items{"U[1][1]", "U[2][2]", "U[3][3]",
                                                  "U[1][2]", "U[1][3]", "U[2][3]"};
  bool all = true;
  for (std::uint64_t row = 0; row < table.rows(); ++row) {
    const CifToken* id = table.value(row, "id");
    const auto atom = id ? rows_of_id_.find(id->text) : rows_of_id_.end();
    if (atom == rows_of_id_.end()) {
      all = false;
      continue;
    }
    double* const out = columns_.anisou_of(atom->second);
    for (std::size_t k = 0; k < 6; ++k)
      if (const CifToken* value = table.value(row, items[k]); value && !cif_real(*value, out[k]))
        refuse(*value, fmt::format("{} is {}, not a number", items[k], shown(value->text)));
  }
  return all;
}

void CifAtoms::refuse(const CifToken& where, std::string what) const {
  fail(Exit::BadInput, code::not_a_value, {file_, where.line, where.column}, std::move(what));
}

const CifToken* CifAtoms::token(Item item) const {
  if (at_[item] < 0) return nullptr;
  const CifToken& found = row_[static_cast<std::size_t>(at_[item])];
  return found.missing() ? nullptr : &found;
}

std::string_view CifAtoms::text(Item item) const {
  const CifToken* found = token(item);
  return found ? found->text : std::string_view{};
}

std::string_view CifAtoms::text(Item item, Item otherwise) const {
  return token(item) ? text(item) : text(otherwise);
}

double CifAtoms::real(Item item, double otherwise, bool needed) const {
  const CifToken* found = token(item);
  double value = otherwise;
  if (found ? !cif_real(*found, value) : needed)
    refuse(found ? *found : row_[static_cast<std::size_t>(at_[item])],
           fmt::format("{} is {}, not a number", wanted[item], found ? shown(found->text) : "missing"));
  return value;
}

std::int64_t CifAtoms::integer(Item item, std::int64_t otherwise) const {
  const CifToken* found = token(item);
  std::int64_t value = otherwise;
  if (found && !parse_integer(found->text, value))
    refuse(*found, fmt::format("{} is {}, not an integer", wanted[item], shown(found->text)));
  return value;
}

} // namespace mote::data
