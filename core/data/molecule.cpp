// SPDX-License-Identifier: MIT
#include "core/data/molecule.hpp"

#include "core/data/elements.hpp"
#include "core/data/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace mote::data {
namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

// The symbol that exactly these letters are, or nothing.
std::string_view symbol_of(std::string_view letters) {
  if (letters.empty() || letters.size() > 2 || !std::all_of(letters.begin(), letters.end(), is_letter))
    return {};
  const Element* found = find_element(letters);
  const bool isotope = same_word(letters, "D") || same_word(letters, "T");
  return found && (isotope || same_word(found->symbol, letters)) ? found->symbol : std::string_view{};
}

std::string_view or_unknown(std::string_view symbol) { return symbol.empty() ? "X" : symbol; }

std::string_view without_mark(std::string_view word) { // "CL-" "NA1" -> "CL" "NA"
  std::size_t end = 0;
  while (end < word.size() && is_letter(word[end])) ++end;
  return word.substr(0, end);
}

} // namespace

void Labels::add(std::string_view word) {
  if (last_ < column_.dictionary.size() && column_.dictionary[last_] == word) {
    column_.codes.push_back(last_);
    return;
  }
  const auto [at, fresh] =
      map_.try_emplace(std::string(word), static_cast<std::uint32_t>(column_.dictionary.size()));
  if (fresh) column_.dictionary.emplace_back(word);
  last_ = at->second;
  column_.codes.push_back(last_);
}

bool BondList::add(std::uint64_t a, std::uint64_t b) {
  if (a > b) std::swap(a, b);
  if (a == b || b > 0xffffffffu || !known_.try_emplace((a << 32) | b, true).second) return false;
  bonds_.rows.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
  return true;
}

bool BondList::add(std::uint64_t a, std::uint64_t b, std::int64_t type) {
  if (!add(a, b)) return false;
  bonds_.types.push_back(type);
  return true;
}

double* AtomColumns::anisou_of(std::uint64_t row) {
  if (anisou.size() < 6 * (row + 1)) anisou.resize(6 * (row + 1), std::numeric_limits<double>::quiet_NaN());
  return anisou.data() + 6 * row;
}

void AtomColumns::give(Frame& frame) {
  frame.count = count;
  auto& out = frame.columns;
  out.push_back(real_column("position", 3, std::move(positions), "A"));
  out.push_back(int_column("id", std::move(ids)));
  out.push_back(elements.take("element"));
  out.push_back(names.take("atom_name"));
  out.push_back(residues.take("residue_name"));
  out.push_back(int_column("residue_id", std::move(residue_ids)));
  if (insertions.any_text()) out.push_back(insertions.take("insertion_code"));
  out.push_back(chains.take("chain"));
  if (chain_labels.any_text()) out.push_back(chain_labels.take("chain_label"));
  if (altlocs.any_text()) out.push_back(altlocs.take("altloc"));
  out.push_back(int_column("hetero", std::move(hetero)));
  out.push_back(real_column("occupancy", 1, std::move(occupancies)));
  out.push_back(real_column("b_factor", 1, std::move(b_factors), "A^2"));
  if (anisou.empty()) return;
  (void)anisou_of(count - 1);
  out.push_back(real_column("anisou", 6, std::move(anisou), "A^2"));
}

std::optional<Box> cell_box(const glm::dvec3& lengths, const glm::dvec3& angles) {
  for (int i = 0; i < 3; ++i)
    if (!(lengths[i] > 0 && std::isfinite(lengths[i]) && angles[i] > 0 && angles[i] < 180))
      return std::nullopt;
  auto cosine = [](double degrees) {
    return degrees == 90.0 ? 0.0 : std::cos(degrees * std::numbers::pi / 180);
  };
  const double ca = cosine(angles.x), cb = cosine(angles.y), cg = cosine(angles.z);
  const double sg = angles.z == 90.0 ? 1.0 : std::sin(angles.z * std::numbers::pi / 180);
  const double cy = (ca - cb * cg) / sg;
  const double cz2 = 1 - cb * cb - cy * cy;
  if (!(cz2 > 0)) return std::nullopt;
  Box box;
  box.edges[0] = {lengths.x, 0, 0};
  box.edges[1] = {lengths.y * cg, lengths.y * sg, 0};
  box.edges[2] = {lengths.z * cb, lengths.z * cy, lengths.z * std::sqrt(cz2)};
  return box;
}

std::string_view element_of_pdb_name(std::string_view four, std::string_view residue) {
  if (four.size() < 2 || four[0] == ' ' || is_digit(four[0])) {
    const std::string_view name = trim(four);
    const std::size_t letter =
        static_cast<std::size_t>(std::find_if(name.begin(), name.end(), is_letter) - name.begin());
    return letter < name.size() ? or_unknown(symbol_of(name.substr(letter, 1))) : "X";
  }
  const bool four_letters = four.size() == 4 && four[3] != ' '; // HG11: a hydrogen that fills all columns
  if (four_letters && (four[0] == 'H' || four[0] == 'D')) return "H";
  if (const std::string_view two = symbol_of(four.substr(0, 2)); !two.empty() && !four_letters) return two;
  return element_of_name(trim(four), residue);
}

std::string_view element_of_name(std::string_view name, std::string_view residue) {
  while (!name.empty() && is_digit(name.front())) name.remove_prefix(1);
  const std::string_view letters = without_mark(name);
  if (same_word(letters, without_mark(residue)) && letters.size() == 2)
    if (const std::string_view ion = symbol_of(letters); !ion.empty()) return ion;
  constexpr std::array<std::string_view, 11> certain{"FE", "ZN", "MG", "MN", "CL", "BR",
                                                     "LI", "SI", "SE", "CU", "AL"};
  for (const std::string_view two : certain)
    if (same_word(letters, two)) return symbol_of(two);
  return or_unknown(symbol_of(letters.substr(0, 1)));
}

} // namespace mote::data
