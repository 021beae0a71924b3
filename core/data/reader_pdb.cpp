// SPDX-License-Identifier: MIT
// PDB, the fixed-column format of the Protein Data Bank (format 3.3; wwpdb.org/documentation). Models
// (MODEL, or texts one behind the other, each ended by END) are frames. Read: ATOM and HETATM, ANISOU,
// CONECT, CRYST1, REMARK 350. Positions as in the file (ORIGX, SCALE and MTRIX are not applied), all
// alternate locations. Lengths in A.
#include "core/data/codes_molecular.hpp"
#include "core/data/elements.hpp"
#include "core/data/molecule.hpp"
#include "core/data/pdb_header.hpp"
#include "core/data/registry.hpp"
#include "core/data/trajectory.hpp"

#include <fmt/format.h>

#include <array>

namespace mote::data {
namespace {

bool is_atom(std::string_view line) { return line.starts_with("ATOM  ") || line.starts_with("HETATM"); }

// Numbers too long for their columns: hybrid-36 (A0000 is 100000), otherwise nothing.
std::optional<std::int64_t> wide_number(std::string_view field) {
  std::int64_t value = 0;
  const std::string_view word = trim(field);
  if (parse_integer(word, value)) return value;
  if (word.size() != field.size() || word.empty() || word[0] < 'A' || word[0] > 'Z') return std::nullopt;
  std::int64_t power = 1, decimal = 1;
  for (std::size_t k = 1; k < word.size(); ++k) power *= 36, decimal *= 10;
  for (const char c : word) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit && (c < 'A' || c > 'Z')) return std::nullopt;
    value = value * 36 + (digit ? c - '0' : c - 'A' + 10);
  }
  return value - 10 * power + 10 * decimal;
}

class PdbSource : public TextTrajectory {
public:
  explicit PdbSource(std::shared_ptr<Bytes> bytes) : TextTrajectory(std::move(bytes)) {}
  std::string_view format() const override { return "pdb"; }

protected:
  // A frame ends behind ENDMDL or END, or before the next MODEL; what holds no atoms at the end of the
  // file belongs to the last frame.
  Step skip_frame(Cursor& cursor) const override {
    bool atoms = false, open = false;
    while (const auto line = cursor.peek()) {
      const std::string_view record = pdb_record(line->text);
      if (record == "MODEL") {
        if (atoms) return Step::Whole;
        open = true;
      }
      atoms = atoms || is_atom(line->text);
      (void)cursor.next();
      if (!atoms || (record != "ENDMDL" && record != "END")) continue;
      skip_tail(cursor);
      return Step::Whole;
    }
    if (!atoms) return Step::Broken;
    return open || ends_within_line(cursor.all()) ? Step::Cut : Step::Whole;
  }

  Frame read_frame(Cursor cursor) override {
    if (!header_) {
      header_ = read_pdb_header(file(), Cursor(cursor.all()));
      last_conect_ = find_last_conect(cursor.all());
    }
    Frame frame;
    const PdbHeader own = cursor.offset() > 0 ? read_pdb_header(file(), cursor) : *header_;
    frame.box = own.box ? own.box : header_->box;
    frame.assemblies = own.assemblies.empty() ? header_->assemblies : own.assemblies;
    if (!header_->title.empty()) frame.properties.emplace_back("title", header_->title);
    if (!header_->identifier.empty()) frame.properties.emplace_back("identifier", header_->identifier);
    if (!header_->space_group.empty()) frame.properties.emplace_back("space_group", header_->space_group);
    AtomColumns atoms;
    std::vector<Line> bonds;
    read_atoms(cursor, atoms, bonds, frame);
    if (atoms.count == 0)
      fail(Exit::BadInput, code::no_position, {file(), cursor.line()}, "there are no ATOM or HETATM records");
    if (bonds.empty()) bonds = lines_from(last_conect_);
    frame.bonds = read_bonds(bonds, atoms.ids);
    atoms.give(frame);
    return frame;
  }

private:
  // Over what belongs to the frame that ended; to the end of the text when no atoms follow.
  static void skip_tail(Cursor& cursor) {
    Cursor ahead = cursor;
    bool tail = true;
    while (const auto line = ahead.peek()) {
      if (is_atom(line->text)) return;
      const std::string_view record = pdb_record(line->text);
      tail = tail && (record == "CONECT" || record == "END" || record == "MASTER" || record == "TER" ||
                      record.empty());
      (void)ahead.next();
      if (tail) cursor = ahead;
    }
    cursor = ahead;
  }

  // A last line without line end that is a coordinate shorter than the one before it has lost columns.
  static bool ends_within_line(std::string_view all) {
    if (all.empty() || all.ends_with('\n')) return false;
    const std::size_t begin = all.rfind('\n');
    if (begin == std::string_view::npos) return false;
    const std::string_view last = all.substr(begin + 1);
    std::string_view before = all.substr(0, begin);
    before.remove_prefix(before.rfind('\n') + 1);
    if (before.ends_with('\r')) before.remove_suffix(1);
    const bool pair = is_atom(before) || before.starts_with("ANISOU");
    const bool begun = last.size() < 6 && (std::string_view("ATOM  ").starts_with(last) ||
                                           std::string_view("HETATM").starts_with(last) ||
                                           std::string_view("ANISOU").starts_with(last));
    return begun || (pair && (is_atom(last) || last.starts_with("ANISOU")) && last.size() < before.size());
  }

  void read_atoms(Cursor& cursor, AtomColumns& atoms, std::vector<Line>& bonds, Frame& frame) {
    bool ended = false, open = false;
    std::string_view last_atom;
    const bool whole = !ends_within_line(cursor.all());
    while (const auto line = cursor.peek()) {
      const std::string_view record = pdb_record(line->text);
      const bool atom = is_atom(line->text);
      if ((ended && record != "CONECT") || (record == "MODEL" && atoms.count > 0)) break;
      (void)cursor.next();
      if (!whole && cursor.at_end() && (atom || record == "ANISOU"))
        fail(Exit::BadInput, code::ends_early, {file(), line->number}, "the file ends within this record");
      if (atom) {
        add_atom(*line, atoms);
        last_atom = line->text;
      } else if (record == "ANISOU") {
        add_anisou(*line, last_atom, atoms);
      } else if (record == "CONECT") {
        bonds.push_back(*line);
      } else if (record == "MODEL") {
        open = true;
        frame.properties.emplace_back("model", std::string(trim(pdb_columns(line->text, 7, 20))));
      }
      ended = ended || (atoms.count > 0 && (record == "ENDMDL" || record == "END"));
    }
    if (open && !ended && cursor.at_end())
      fail(Exit::BadInput, code::ends_early, {file(), cursor.line()},
           "the file ends within a model: ENDMDL is missing");
  }

  void add_atom(const Line& line, AtomColumns& atoms) const {
    const std::string_view text = line.text;
    if (text.size() < 54)
      fail(Exit::BadInput, code::too_few, {file(), line.number},
           fmt::format("the record has {} columns, but the positions reach to column 54", text.size()));
    for (const std::size_t first : {31u, 39u, 47u})
      atoms.positions.push_back(real(line, first, first + 7, 0, false));
    atoms.occupancies.push_back(real(line, 55, 60, 1, true));
    atoms.b_factors.push_back(real(line, 61, 66, 0, true));
    const std::int64_t before = atoms.ids.empty() ? 0 : atoms.ids.back();
    atoms.ids.push_back(wide_number(pdb_columns(text, 7, 11)).value_or(before + 1));
    atoms.residue_ids.push_back(residue_id(line, atoms));
    atoms.hetero.push_back(text[0] == 'H' ? 1 : 0);
    const std::string_view residue = trim(pdb_columns(text, 18, 21)); // four letters: CHARMM and others
    atoms.names.add(trim(pdb_columns(text, 13, 16)));
    atoms.residues.add(residue);
    atoms.chains.add(trim(pdb_columns(text, 22, 22)));
    atoms.altlocs.add(trim(pdb_columns(text, 17, 17)));
    atoms.insertions.add(trim(pdb_columns(text, 27, 27)));
    const std::string_view letters = trim(pdb_columns(text, 77, 78));
    const Element* known = letters.empty() ? nullptr : find_element(letters);
    atoms.elements.add(known ? known->symbol : element_of_pdb_name(pdb_columns(text, 13, 16), residue));
    ++atoms.count;
  }

  std::int64_t residue_id(const Line& line, const AtomColumns& atoms) const {
    const std::string_view field = pdb_columns(line.text, 23, 26);
    if (const auto number = wide_number(field)) return *number;
    const std::int64_t before = atoms.residue_ids.empty() ? 0 : atoms.residue_ids.back();
    if (trim(field).empty() || field.find_first_not_of('*') == std::string_view::npos) return before;
    fail(Exit::BadInput, code::not_a_value, place_in(file(), line, field),
         fmt::format("the residue number is {}, not an integer", shown(trim(field))));
  }

  double real(const Line& line, std::size_t first, std::size_t last, double missing, bool may_miss) const {
    const std::string_view field = pdb_columns(line.text, first, last), word = trim(field);
    double value = missing;
    if ((!word.empty() || !may_miss) && !parse_real(word, value))
      fail(Exit::BadInput, code::not_a_value, place_in(file(), line, field),
           fmt::format("{} in columns {} to {} is not a number", shown(word), first, last));
    return value;
  }

  void add_anisou(const Line& line, std::string_view atom, AtomColumns& atoms) {
    if (atom.empty() || pdb_columns(line.text, 7, 27) != pdb_columns(atom, 7, 27)) {
      if (!warnings_.has(molecule_code::anisotropy))
        warnings_.warning(molecule_code::anisotropy, {file(), line.number},
                          "an ANISOU record does not follow its atom and is ignored");
      return;
    }
    double* const out = atoms.anisou_of(atoms.count - 1);
    for (std::size_t k = 0; k < 6; ++k) {
      const std::string_view field = pdb_columns(line.text, 29 + 7 * k, 35 + 7 * k);
      std::int64_t value = 0;
      if (!parse_integer(trim(field), value))
        fail(Exit::BadInput, code::not_a_value, place_in(file(), line, field),
             fmt::format("{} in ANISOU is not an integer", shown(trim(field))));
      out[k] = static_cast<double>(value) * 1e-4;
    }
  }

  // Many files have the bonds of all models at their very end.
  static std::optional<Cursor> find_last_conect(std::string_view all) {
    std::size_t begin = all.size(), found = std::string_view::npos;
    while (begin > 0) {
      const std::size_t before = begin >= 2 ? all.rfind('\n', begin - 2) : std::string_view::npos;
      const std::size_t start = before == std::string_view::npos ? 0 : before + 1;
      const std::string_view record = pdb_record(all.substr(start, begin - start));
      if (record == "CONECT")
        found = start;
      else if (record != "MASTER" && record != "END" && !record.empty())
        break;
      begin = start;
    }
    return found == std::string_view::npos ? std::nullopt : std::optional(Cursor(all, found));
  }
  static std::vector<Line> lines_from(std::optional<Cursor> cursor) {
    std::vector<Line> out;
    while (const auto line = cursor ? cursor->next() : std::nullopt) out.push_back(*line);
    return out;
  }

  // CONECT a b c d e: a is bound to b..e. Numbers end at fixed columns; a cut number is left out.
  Bonds read_bonds(const std::vector<Line>& lines, const std::vector<std::int64_t>& ids) {
    BondList bonds;
    std::unordered_map<std::int64_t, std::uint64_t> rows;
    for (std::uint64_t row = 0; !lines.empty() && row < ids.size(); ++row) rows.try_emplace(ids[row], row);
    std::uint64_t unknown = 0;
    for (const Line& line : lines) {
      if (pdb_record(line.text) != "CONECT") continue;
      const auto from = rows.find(wide_number(pdb_columns(line.text, 7, 11)).value_or(-1));
      for (std::size_t first = 12; first <= 27; first += 5) {
        const std::string_view field = pdb_columns(line.text, first, first + 4);
        if (field.size() < 5 || trim(field).empty()) continue;
        const auto to = rows.find(wide_number(field).value_or(-1));
        if (from == rows.end() || to == rows.end())
          ++unknown;
        else
          bonds.add(from->second, to->second);
      }
    }
    if (unknown > 0 && !warnings_.has(molecule_code::bond))
      warnings_.warning(
          molecule_code::bond, {file()},
          fmt::format("{} bonds of CONECT records name atoms that are not there and are left out", unknown));
    return bonds.take();
  }

  std::optional<PdbHeader> header_{};
  std::optional<Cursor> last_conect_{};
};

Sureness probe(const Probe& file) {
  Cursor cursor(file.head);
  cursor.skip_blank();
  const auto first = cursor.peek();
  if (!first) return Sureness::No;
  constexpr std::array<std::string_view, 14> records{"HEADER", "TITLE ", "COMPND", "REMARK", "CRYST1",
                                                     "MODEL ", "ATOM  ", "HETATM", "AUTHOR", "SEQRES",
                                                     "OBSLTE", "EXPDTA", "NUMMDL", "ORIGX1"};
  bool known = false;
  for (const std::string_view record : records) known = known || first->text.substr(0, 6) == record;
  while (const auto line = cursor.next()) {
    double value = 0;
    if (!is_atom(line->text) || line->text.size() < 54) continue;
    if (parse_real(trim(pdb_columns(line->text, 31, 38)), value) &&
        parse_real(trim(pdb_columns(line->text, 47, 54)), value))
      return known ? Sureness::Certain : Sureness::Likely;
  }
  return known ? Sureness::Likely : Sureness::ByName;
}

} // namespace

Reader pdb_reader() {
  return {{"pdb", "Protein Data Bank, fixed columns (A)", "pdb ent pdb1"},
          probe,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<PdbSource>(std::move(bytes));
          }};
}

} // namespace mote::data
