// SPDX-License-Identifier: MIT
// LAMMPS data files (docs.lammps.org/read_data.html): a title, counts and the box, then sections. Read:
// Atoms, Velocities, Masses, Atom Type Labels, Bonds, Ellipsoids. The atom style stands behind "Atoms #",
// in the title ("atom_style full"), or is guessed from the rows (D048). One frame; positions as in the
// file with `image` beside them; units are those of the simulation and not in the file. A data file
// does not say which boundaries are periodic: all are taken to be.
#include "core/data/codes_molecular.hpp"
#include "core/data/elements.hpp"
#include "core/data/lammps_sections.hpp"
#include "core/data/lammps_styles.hpp"
#include "core/data/molecule.hpp"
#include "core/data/names.hpp"
#include "core/data/registry.hpp"
#include "core/data/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace mote::data {
namespace {

class LammpsDataSource : public Source {
public:
  explicit LammpsDataSource(std::shared_ptr<Bytes> bytes) : bytes_(std::move(bytes)) {
    warnings_.append(bytes_->warnings());
  }
  std::string_view format() const override { return "lammps-data"; }
  std::uint64_t frame_count() override { return 1; }

  Frame read(std::uint64_t index) override {
    if (index > 0)
      fail(Exit::BadInput, code::no_frame, {file()},
           fmt::format("there is no frame {}: the file has 1 frame (0)", index));
    if (file_.sections.empty()) file_ = find_lammps_sections(file(), bytes_->text());
    Frame frame;
    frame.count = file_.count("atoms");
    if (!file_.title.empty()) frame.properties.emplace_back("title", file_.title);
    frame.box = file_.box;
    read_atoms(frame);
    const auto rows = rows_of_ids(frame);
    read_types(frame);
    read_velocities(frame, rows);
    read_ellipsoids(frame, rows);
    read_bonds(frame, rows);
    return frame;
  }

private:
  using Rows = std::unordered_map<std::int64_t, std::uint64_t>;
  [[nodiscard]] const std::string& file() const { return bytes_->name(); }

  // The first row of a section: its words without the comment.
  static std::vector<std::string_view> first_row(Cursor cursor) {
    while (const auto line = cursor.next())
      if (const std::string_view text = without_comment(line->text); !text.empty())
        return split_row(text, ' ');
    return {};
  }

  const LammpsStyle& style_of(const LammpsSections::Section& atoms,
                              const std::vector<std::string_view>& words) {
    std::string_view name = Words(comment_of(atoms.heading.text)).next();
    if (const std::size_t at = file_.title.find("atom_style"); name.empty() && at != std::string::npos)
      name = Words(std::string_view(file_.title).substr(at + 10)).next();
    static constexpr LammpsStyle hybrid{"hybrid", "id type x y z"};
    if (name == "hybrid") return hybrid;
    if (const LammpsStyle* known = find_lammps_style(name)) return *known;
    std::vector<std::string> names;
    for (const LammpsStyle& style : lammps_styles()) names.emplace_back(style.name);
    const SourceLoc loc{file(), atoms.heading.number};
    if (!name.empty())
      fail(Exit::BadInput, molecule_code::atom_style, loc,
           fmt::format("the atom style {} is not read", shown(name)),
           {did_you_mean(name, names), "styles: " + list_of(names)});
    const LammpsStyle* guess = guess_lammps_style(words, file_.count("bonds") > 0, file_.count("atom types"));
    if (!guess)
      fail(Exit::BadInput, molecule_code::atom_style, loc,
           fmt::format("the atom style is not named, and rows of {} values suggest none", words.size()),
           {"name it: 'Atoms # full'", "styles: " + list_of(names)});
    if (!warnings_.has(molecule_code::guessed_style))
      warnings_.warning(molecule_code::guessed_style, loc,
                        fmt::format("the atom style is not named; the first row suggests '{}' ({})",
                                    guess->name, guess->fields));
    return *guess;
  }

  void read_atoms(Frame& frame) {
    const LammpsSections::Section& section = file_.sections.at("Atoms");
    const std::vector<std::string_view> words = first_row(section.begin);
    const LammpsStyle& style = style_of(section, words);
    std::vector<Declared> declared;
    for (const std::string_view field : split_row(style.fields, ' ')) {
      const bool whole = field == "id" || field == "mol" || field == "type" || field.ends_with("flag") ||
                         field.starts_with("template");
      declared.push_back({std::string(field), 1, whole ? Cell::Integer : Cell::Real});
      if (field == "type" && declared.size() <= words.size() &&
          kind_of(words[declared.size() - 1]) == Cell::Text)
        declared.back().kind = Cell::Text; // type labels
    }
    const bool hybrid = style.name == "hybrid";
    const bool images = !hybrid && words.size() == declared.size() + 3;
    if (!words.empty() && words.size() != declared.size() && !images &&
        !(hybrid && words.size() > declared.size()))
      fail(Exit::BadInput, molecule_code::atom_style, {file(), section.heading.number},
           fmt::format("rows of atom style '{}' have {} values ({}), perhaps with three image flags; the "
                       "first row has {}",
                       style.name, declared.size(), style.fields, words.size()));
    for (const char* flag : {"ix", "iy", "iz"})
      if (images) declared.push_back({flag, 1, Cell::Integer});
    RowLayout layout = plan_columns(declared, {});
    frame.columns = rows_of(section, "Atoms", frame.count, layout);
    frame.properties.emplace_back("atom_style", std::string(style.name));
  }

  // `count` rows of a section; comments behind the values are no values.
  std::vector<Column> rows_of(const LammpsSections::Section& section, std::string_view name,
                              std::uint64_t count, RowLayout& layout) {
    layout.comment = '#';
    layout.skip_blank = layout.extra_allowed = true;
    const RowRange range = find_rows(section.begin, count, layout);
    if (range.count < count)
      fail(Exit::BadInput, code::ends_early, {file(), range.end.line()},
           fmt::format("the file ends after {} of {} rows of the section {}", range.count, count, name));
    if (range.end.at_end() && !range.end.all().ends_with('\n') && !warnings_.has(molecule_code::last_line))
      warnings_.warning(molecule_code::last_line, {file(), range.end.line() - 1},
                        "the last line has no line end and may be cut off");
    return parse_rows(file(), range, layout);
  }
  std::vector<Column> rows_of(std::string_view name, std::uint64_t count,
                              std::initializer_list<Declared> declared) {
    const auto section = file_.sections.find(name);
    if (section == file_.sections.end() || count == 0) return {};
    RowLayout layout = plan_columns(std::vector<Declared>(declared), {});
    return rows_of(section->second, name, count, layout);
  }
  static const std::vector<std::int64_t>& integers(const Column& column) {
    return std::get<std::vector<std::int64_t>>(column.values);
  }
  static const std::vector<double>& reals(const Column& column) {
    return std::get<std::vector<double>>(column.values);
  }

  Rows rows_of_ids(const Frame& frame) const {
    Rows rows;
    rows.reserve(frame.count);
    const auto& ids = integers(*frame.find("id"));
    for (std::uint64_t row = 0; row < ids.size(); ++row)
      if (!rows.try_emplace(ids[row], row).second)
        fail(Exit::BadInput, code::duplicate_id, {file(), file_.sections.at("Atoms").heading.number},
             fmt::format("two atoms have the id {}", ids[row]));
    return rows;
  }
  std::uint64_t row_of(const Rows& rows, std::int64_t id, std::string_view section,
                       std::string_view code_word) const {
    const auto found = rows.find(id);
    if (found != rows.end()) return found->second;
    fail(Exit::BadInput, code_word, {file(), file_.sections.find(section)->second.heading.number},
         fmt::format("the section {} names atom {}, which is not there", section, id));
  }

  // Masses and labels of types -> the columns mass and element, where they are not in the rows.
  void read_types(Frame& frame) {
    const std::uint64_t types = file_.count("atom types");
    const std::vector<Column> masses =
        rows_of("Masses", types, {{"type", 1, Cell::Text}, {"mass", 1, Cell::Real}});
    const std::vector<Column> labels =
        rows_of("Atom Type Labels", types, {{"id", 1, Cell::Text}, {"label", 1, Cell::Text}});
    std::map<std::string, double> mass_of;
    std::map<std::string, std::string> label_of;
    Cursor cursor = masses.empty() ? Cursor() : file_.sections.at("Masses").begin;
    for (std::uint64_t row = 0; !masses.empty() && row < types;) {
      const auto line = cursor.next();
      if (!line) break;
      if (without_comment(line->text).empty()) continue;
      const std::string& type = std::get<TextColumn>(masses[0].values).at(row);
      mass_of[type] = masses[1].number(row++);
      label_of[type] = Words(comment_of(line->text)).next();
    }
    for (std::uint64_t row = 0; !labels.empty() && row < types; ++row)
      label_of[std::get<TextColumn>(labels[0].values).at(row)] =
          std::get<TextColumn>(labels[1].values).at(row);
    const Column* type = frame.find("type");
    if (!type || mass_of.empty()) return;
    Labels elements;
    std::vector<double> mass;
    bool all_elements = true;
    std::map<std::string, std::string_view, std::less<>> symbol_of;
    for (const auto& [name, value] : mass_of)
      symbol_of[name] = element_of_type(label_of[name].empty() ? name : label_of[name], value);
    for (std::uint64_t row = 0; row < frame.count; ++row) {
      const auto* text = std::get_if<TextColumn>(&type->values);
      const std::string key = text ? text->at(row) : fmt::format("{}", integers(*type)[row]);
      const auto found = mass_of.find(key);
      if (found == mass_of.end())
        fail(Exit::BadInput, molecule_code::count, {file(), file_.sections.at("Masses").heading.number},
             fmt::format("an atom has type {}, which has no mass", shown(key)));
      mass.push_back(found->second);
      all_elements = all_elements && !symbol_of[key].empty();
      if (all_elements) elements.add(symbol_of[key]);
    }
    if (!frame.find("mass")) frame.columns.push_back(real_column("mass", 1, std::move(mass)));
    if (all_elements) frame.columns.push_back(elements.take("element"));
  }

  // By the label, else by a mass within 0.02 u of an element's (whole numbers are those of models).
  static std::string_view element_of_type(std::string_view label, double mass) {
    if (const Element* known = find_element(label)) return known->symbol;
    if (mass == std::floor(mass)) return {};
    for (const Element& e : elements())
      if (std::abs(e.mass - mass) < 0.02) return e.symbol;
    return {};
  }

  void read_velocities(Frame& frame, const Rows& rows) {
    const std::vector<Column> in = rows_of(
        "Velocities", frame.count,
        {{"id", 1, Cell::Integer}, {"vx", 1, Cell::Real}, {"vy", 1, Cell::Real}, {"vz", 1, Cell::Real}});
    if (in.empty()) return;
    std::vector<double> out(3 * frame.count, 0.0);
    for (std::uint64_t i = 0; i < frame.count; ++i) {
      const std::uint64_t row = row_of(rows, integers(in[0])[i], "Velocities", molecule_code::count);
      for (std::uint64_t k = 0; k < 3; ++k) out[3 * row + k] = reals(in[1])[3 * i + k];
    }
    frame.columns.push_back(real_column("velocity", 3, std::move(out)));
  }

  // Full axes (halved here) and quaternions w i j k; atoms without a row are points.
  void read_ellipsoids(Frame& frame, const Rows& rows) {
    const std::uint64_t count = file_.count("ellipsoids");
    const std::vector<Column> in = rows_of("Ellipsoids", count,
                                           {{"id", 1, Cell::Integer},
                                            {"sx", 1, Cell::Real},
                                            {"sy", 1, Cell::Real},
                                            {"sz", 1, Cell::Real},
                                            {"quatw", 1, Cell::Real},
                                            {"quati", 1, Cell::Real},
                                            {"quatj", 1, Cell::Real},
                                            {"quatk", 1, Cell::Real}});
    if (in.empty()) return;
    std::vector<double> shape(3 * frame.count, 0.0), orientation(4 * frame.count, 0.0);
    for (std::uint64_t row = 0; row < frame.count; ++row) orientation[4 * row] = 1;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t row = row_of(rows, integers(in[0])[i], "Ellipsoids", molecule_code::count);
      for (std::uint64_t k = 0; k < 3; ++k) shape[3 * row + k] = 0.5 * in[1 + k].number(i);
      for (std::uint32_t k = 0; k < 4; ++k) orientation[4 * row + k] = in[4].number(i, k);
    }
    frame.columns.push_back(real_column("shape", 3, std::move(shape)));
    frame.columns.push_back(real_column("orientation", 4, std::move(orientation), "wxyz"));
  }

  void read_bonds(Frame& frame, const Rows& rows) {
    const std::uint64_t count = file_.count("bonds");
    if (count > 0 && !file_.sections.contains("Bonds"))
      fail(Exit::BadInput, code::ends_early, {file()},
           fmt::format("{} bonds are promised, but there is no section Bonds", count));
    std::vector<Column> in = rows_of("Bonds", count,
                                     {{"number", 1, Cell::Integer},
                                      {"kind", 1, Cell::Integer, true},
                                      {"a", 1, Cell::Integer},
                                      {"b", 1, Cell::Integer}});
    if (in.empty()) return;
    BondList bonds;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t a = row_of(rows, integers(in[2])[i], "Bonds", molecule_code::bond),
                          b = row_of(rows, integers(in[3])[i], "Bonds", molecule_code::bond);
      const auto* types = std::get_if<std::vector<std::int64_t>>(&in[1].values); // labels have no number
      bonds.add(a, b, types ? (*types)[i] : 0);
    }
    frame.bonds = bonds.take();
  }

  std::shared_ptr<Bytes> bytes_;
  LammpsSections file_{};
};

// A line "N atoms" and a line "lo hi xlo xhi" before the first section.
Sureness probe(const Probe& file) {
  Cursor cursor(file.head);
  (void)cursor.next();
  bool atoms = false, box = false;
  for (int lines = 0; lines < 100 && !(atoms && box); ++lines) {
    const auto line = cursor.next();
    if (!line) break;
    Words words(without_comment(line->text));
    const std::string_view first = words.next(), second = words.next(), third = words.next();
    std::uint64_t count = 0;
    atoms = atoms || (parse_count(first, count) && second == "atoms" && third.empty());
    box = box || third == "xlo";
  }
  return atoms && box ? Sureness::Certain : atoms ? Sureness::ByName : Sureness::No;
}

} // namespace

Reader lammps_data_reader() {
  return {{"lammps-data", "LAMMPS data file", "data lmp lammps"},
          probe,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<LammpsDataSource>(std::move(bytes));
          }};
}

} // namespace mote::data
