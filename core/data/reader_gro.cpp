// SPDX-License-Identifier: MIT
// GRO, GROMACS' structure file: a title (perhaps with "t= 1.0 step= 5"), the count, one line for each
// atom in fixed columns, the box with 3 or 9 numbers; frames follow each other. Columns 1-20: residue
// number, residue name, atom name, atom number (both numbers wrap at 100 000, so that no id is given).
// The width of the numbers behind them is the distance between their decimal points, so that any
// precision is read. nm and nm/ps.
#include "core/base/parallel.hpp"
#include "core/data/codes_molecular.hpp"
#include "core/data/molecule.hpp"
#include "core/data/registry.hpp"
#include "core/data/rows.hpp"
#include "core/data/trajectory.hpp"

#include <fmt/format.h>

#include <unordered_map>

namespace mote::data {
namespace {

constexpr std::size_t first_number = 20;

// Width of the number columns of an atom line: from the first decimal point to the next; 0 = none.
std::size_t number_width(std::string_view line) {
  const std::size_t one = line.find('.', first_number);
  const std::size_t two = one == std::string_view::npos ? one : line.find('.', one + 1);
  const std::size_t three = two == std::string_view::npos ? two : line.find('.', two + 1);
  return three == std::string_view::npos || three - two != two - one || two - one < 2 ? 0 : two - one;
}

// The atoms of a frame: numbers in their places, words block by block.
struct GroAtoms {
  struct Words {
    Labels residues{}, names{}, elements{};
  };
  std::vector<double> positions{}, velocities{};
  std::vector<std::int64_t> residue_ids{};
  std::vector<Words> blocks{};
};

// Codes by first appearance in the file, whatever the blocks.
Column joined(std::vector<GroAtoms::Words>& blocks, Labels GroAtoms::Words::* words, std::string name) {
  TextColumn all;
  std::unordered_map<std::string, std::uint32_t> known;
  for (GroAtoms::Words& block : blocks) {
    const Column column = (block.*words).take({});
    const auto& text = std::get<TextColumn>(column.values);
    std::vector<std::uint32_t> code_of;
    for (const std::string& word : text.dictionary) {
      const auto [at, fresh] = known.try_emplace(word, static_cast<std::uint32_t>(all.dictionary.size()));
      if (fresh) all.dictionary.push_back(word);
      code_of.push_back(at->second);
    }
    for (const std::uint32_t code : text.codes) all.codes.push_back(code_of[code]);
  }
  return {std::move(name), 1, std::move(all), {}};
}

class GroSource : public TextTrajectory {
public:
  explicit GroSource(std::shared_ptr<Bytes> bytes) : TextTrajectory(std::move(bytes)) {}
  std::string_view format() const override { return "gro"; }

protected:
  Step skip_frame(Cursor& cursor) const override {
    (void)take_title(cursor);
    const auto line = cursor.next();
    std::uint64_t count = 0;
    if (!line) return Step::Cut;
    if (!parse_count(trim(line->text), count)) return Step::Broken;
    if (cursor.skip(count) != count) return Step::Cut;
    const auto box = cursor.next();
    if (!box) return Step::Cut;
    return cut_box(cursor, *box) ? Step::Cut : Step::Whole;
  }

  Frame read_frame(Cursor cursor) override {
    Frame frame;
    read_title(take_title(cursor), frame);
    frame.count = read_count(cursor);
    const auto first = cursor.peek();
    const std::size_t width = frame.count > 0 && first ? number_width(first->text) : 0;
    if (frame.count > 0 && width == 0 && first)
      fail(Exit::BadInput, code::heading, {file(), first->number},
           fmt::format(
               "three numbers with decimal points at equal distances are needed behind column 20, not {}",
               shown(first->text.substr(std::min(first_number, first->text.size())))));
    read_atoms(cursor, width, frame);
    read_box(cursor, frame);
    frame.properties.emplace_back("time_unit", "ps");
    return frame;
  }

private:
  // The title; blank lines before a frame are passed over, and so a blank title may be missing.
  static std::string_view take_title(Cursor& cursor) {
    Cursor behind = cursor;
    const auto line = behind.next();
    const auto second = behind.peek();
    std::uint64_t count = 0;
    if (!line) return {};
    if (parse_count(trim(line->text), count) && second && number_width(second->text) > 0) return {};
    cursor = behind;
    return line->text;
  }

  // "... t= 10.0 step= 5": what GROMACS writes behind the title.
  static void read_title(std::string_view title, Frame& frame) {
    frame.properties.emplace_back("title", std::string(trim(title)));
    auto word_behind = [&](std::string_view key) {
      const std::size_t at = title.rfind(key);
      return at == std::string_view::npos ? std::string_view{} : Words(title.substr(at + key.size())).next();
    };
    double time = 0;
    std::int64_t step = 0;
    if (parse_real(word_behind("t="), time)) frame.time = time;
    if (parse_integer(word_behind("step="), step)) frame.step = step;
  }

  std::uint64_t read_count(Cursor& cursor) const {
    const auto line = cursor.next();
    std::uint64_t count = 0;
    if (!line)
      fail(Exit::BadInput, code::ends_early, {file(), cursor.line()},
           "the file ends before the number of atoms");
    if (!parse_count(trim(line->text), count))
      fail(Exit::BadInput, code::heading, {file(), line->number},
           fmt::format("the second line of a frame is {}, but the number of atoms is needed there",
                       shown(trim(line->text))));
    constexpr std::uint64_t shortest = 27; // an atom line has 20 columns and three numbers
    if (count > cursor.rest().size() / shortest)
      fail(Exit::BadInput, code::ends_early, {file(), line->number},
           fmt::format("{} atoms are promised, but the file ends before so many", count));
    return count;
  }

  // Lines stand alone: all cores read them, block by block.
  void read_atoms(Cursor& cursor, std::size_t width, Frame& frame) const {
    const auto first = cursor.peek();
    const bool moving = first && first->text.size() >= first_number + 6 * width && first->text.find('.', first_number + 3 * width) != std::string_view::npos;
    const RowRange range = find_rows(cursor, frame.count, {});
    GroAtoms atoms{std::vector<double>(3 * range.count), std::vector<double>(moving ? 3 * range.count : 0), std::vector<std::int64_t>(range.count),
                   std::vector<GroAtoms::Words>(range.blocks.size())};
    for_each_block(range.blocks.size(), [&](std::size_t block) {
      const RowRange::Block& begin = range.blocks[block];
      Cursor lines(cursor.all(), begin.offset, begin.line);
      const std::uint64_t end = block + 1 < range.blocks.size() ? range.blocks[block + 1].row : range.count;
      for (std::uint64_t row = begin.row; row < end; ++row) read_atom(lines, row, width, atoms, atoms.blocks[block]);
    });
    cursor = range.end;
    if (range.count < frame.count)
      fail(Exit::BadInput, code::ends_early, {file(), cursor.line()}, fmt::format("the file ends after {} of {} atoms", range.count, frame.count));
    frame.columns.push_back(real_column("position", 3, std::move(atoms.positions), "nm"));
    if (moving) frame.columns.push_back(real_column("velocity", 3, std::move(atoms.velocities), "nm/ps"));
    frame.columns.push_back(joined(atoms.blocks, &GroAtoms::Words::elements, "element"));
    frame.columns.push_back(joined(atoms.blocks, &GroAtoms::Words::names, "atom_name"));
    frame.columns.push_back(joined(atoms.blocks, &GroAtoms::Words::residues, "residue_name"));
    frame.columns.push_back(int_column("residue_id", std::move(atoms.residue_ids)));
  }

  void read_atom(Cursor& cursor, std::uint64_t row, std::size_t width, GroAtoms& atoms, GroAtoms::Words& words) const {
    const Line line = cursor.next().value_or(Line{});
    const std::string_view text = line.text;
    const bool moving = !atoms.velocities.empty();
    if (cursor.at_end()) // the box is missing at least
      fail(Exit::BadInput, code::ends_early, {file(), line.number}, fmt::format("the file ends within or behind atom {}", row + 1));
    if (text.size() < first_number + 3 * width)
      fail(Exit::BadInput, code::too_few, {file(), line.number},
           fmt::format("the line of atom {} has {} columns, but {} are needed", row + 1, text.size(), first_number + 3 * width));
    if (moving && text.size() < first_number + 6 * width)
      fail(Exit::BadInput, code::too_few, {file(), line.number}, fmt::format("the line of atom {} has no velocity, but the first one has", row + 1));
    atoms.residue_ids[row] = integer(line, text.substr(0, 5), "the residue number");
    const std::string_view residue = trim(text.substr(5, 5)), name = trim(text.substr(10, 5));
    words.residues.add(residue);
    words.names.add(name);
    words.elements.add(element_of_name(name, residue));
    for (std::size_t k = 0; k < 3; ++k) atoms.positions[3 * row + k] = real(line, text.substr(first_number + k * width, width));
    for (std::size_t k = 0; moving && k < 3; ++k) atoms.velocities[3 * row + k] = real(line, text.substr(first_number + (3 + k) * width, width));
  }

  std::int64_t integer(const Line& line, std::string_view field, std::string_view what) const {
    std::int64_t value = 0;
    const std::string_view word = trim(field);
    if (!word.empty() && !parse_integer(word, value))
      fail(Exit::BadInput, code::not_a_value, place_in(file(), line, field),
           fmt::format("{} is {}, not an integer", what, shown(word)));
    return value;
  }

  double real(const Line& line, std::string_view field) const {
    double value = 0;
    if (!parse_real(trim(field), value))
      fail(Exit::BadInput, code::not_a_value, place_in(file(), line, field),
           fmt::format("{} is not a number", shown(field)));
    return value;
  }

  // A last line without line end may have lost digits: GROMACS writes all numbers alike.
  static bool cut_box(const Cursor& behind, const Line& line) {
    if (!behind.at_end() || behind.all().ends_with('\n')) return false;
    std::size_t first = 0, last = 0, numbers = 0;
    Words words(line.text);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      const std::size_t point = word.find('.');
      last = point == std::string_view::npos ? 0 : word.size() - point;
      if (numbers++ == 0) first = last;
    }
    return (numbers != 3 && numbers != 9) || first != last;
  }

  // v1x v2y v3z [v1y v1z v2x v2z v3x v3y]
  void read_box(Cursor& cursor, Frame& frame) {
    const auto line = cursor.next();
    if (!line)
      fail(Exit::BadInput, code::ends_early, {file(), cursor.line()}, "the file ends before the box");
    if (cut_box(cursor, *line))
      fail(Exit::BadInput, code::ends_early, {file(), line->number},
           fmt::format("the file ends within the box {}", shown(trim(line->text))));
    check_last_line(cursor);
    std::vector<double> v;
    Words words(line->text);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      double value = 0;
      if (!parse_real(word, value))
        fail(Exit::BadInput, code::box, place_in(file(), *line, word),
             fmt::format("{} in the box is not a number", shown(word)));
      v.push_back(value);
    }
    if (v.size() != 3 && v.size() != 9)
      fail(Exit::BadInput, code::box, {file(), line->number},
           fmt::format("the box has {} numbers, but 3 or 9 are needed", v.size()));
    v.resize(9, 0.0);
    if (v[0] == 0 && v[1] == 0 && v[2] == 0) return; // no box
    frame.box.emplace();
    frame.box->edges = glm::dmat3(v[0], v[3], v[4], v[5], v[1], v[6], v[7], v[8], v[2]);
  }
};

// The second line is a count, the third has numbers where they must be.
Sureness probe(const Probe& file) {
  Cursor cursor(file.head);
  (void)cursor.next();
  const auto count_line = cursor.next();
  std::uint64_t count = 0;
  if (!count_line || !parse_count(trim(count_line->text), count)) return Sureness::No;
  const auto atom = cursor.next();
  if (!atom || count == 0) return Sureness::ByName;
  if (atom->text.size() < 44 || number_width(atom->text) == 0) return Sureness::ByName;
  std::int64_t residue = 0;
  return parse_integer(trim(atom->text.substr(0, 5)), residue) ? Sureness::Likely : Sureness::ByName;
}

} // namespace

Reader gro_reader() {
  return {{"gro", "GROMACS structure or trajectory as text (nm, ps)", "gro"},
          probe,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<GroSource>(std::move(bytes));
          }};
}

} // namespace mote::data
