// SPDX-License-Identifier: MIT
// LAMMPS text dumps (dump atom, dump custom): ITEM sections, columns named in any order, boxes that are
// rectangular, triclinic (bounding box and tilts) or general (abc origin), scaled or unwrapped
// positions, image flags. Rows stay in the order of the file. Format: docs.lammps.org/dump.html.
#include "core/data/codes.hpp"
#include "core/data/names.hpp"
#include "core/data/registry.hpp"
#include "core/data/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::data {
namespace {

// quat and c_q[1..4] are w i j k; shapes are full axes.
constexpr Customs lammps_customs{
    .quaternion_is_xyzw = false, .shape_is_diameter = true, .units_in_names = false};
constexpr std::string_view item = "ITEM:";

struct Header {
  std::optional<std::uint64_t> count{};
  std::optional<Box> box{};
  bool has_step{};
  Line atoms{}; // the line "ITEM: ATOMS ..."
};

// The four ways to give positions, in order of preference.
struct PositionForm {
  std::string_view group{}, fields{};
  bool scaled{};
};
constexpr std::array<PositionForm, 4> position_forms{{{"position", "x y z", false},
                                                      {"position_scaled", "xs ys zs", true},
                                                      {"position_unwrapped", "xu yu zu", false},
                                                      {"position_scaled_unwrapped", "xsu ysu zsu", true}}};

// What a column is by its name. Unknown names: a guess from the first row that may widen.
Declared declare(std::string_view name, std::string_view first_value) {
  constexpr std::string_view integers = " id type mol proc procp1 ix iy iz ";
  constexpr std::string_view texts = " element typelabel ";
  const std::string padded = fmt::format(" {} ", name);
  const bool computed =
      name.size() > 2 && name[1] == '_' && std::string_view("cfvd").find(name[0]) != std::string_view::npos;
  if (integers.find(padded) != std::string_view::npos) return {std::string(name), 1, Cell::Integer};
  if (texts.find(padded) != std::string_view::npos) return {std::string(name), 1, Cell::Text};
  if (computed || canonical_name(name, 1) != name) return {std::string(name), 1, Cell::Real};
  const Cell guess = first_value.empty() ? Cell::Real : kind_of(first_value);
  return {std::string(name), 1, guess == Cell::Skip ? Cell::Text : guess, true};
}

class LammpsDumpSource : public TextTrajectory {
public:
  explicit LammpsDumpSource(std::shared_ptr<Bytes> bytes) : TextTrajectory(std::move(bytes)) {}
  std::string_view format() const override { return "lammps-dump"; }

protected:
  // Finds the count and the ATOMS section, whatever else stands there.
  Step skip_frame(Cursor& cursor) const override {
    std::uint64_t count = 0;
    bool counted = false;
    while (const auto line = cursor.next()) {
      if (line->text.starts_with("ITEM: NUMBER OF ATOMS")) {
        const auto value = cursor.next();
        if (!value) return Step::Cut;
        if (counted || !parse_count(trim(value->text), count)) return Step::Broken;
        counted = true;
      } else if (line->text.starts_with("ITEM: ATOMS")) {
        if (!counted) return Step::Broken;
        return cursor.skip(count) == count ? Step::Whole : Step::Cut;
      }
    }
    return Step::Cut;
  }

  Frame read_frame(Cursor cursor) override {
    Frame frame;
    const Header header = read_header(cursor, frame);
    std::vector<Declared> declared = read_names(header.atoms, cursor);
    RowLayout layout = plan_columns(declared, lammps_customs);
    const PositionForm* form = choose_position(layout);
    require_position(layout, declared, {file(), header.atoms.number});
    const RowRange range = find_rows(cursor, *header.count, layout);
    if (range.count < *header.count)
      fail(
          Exit::BadInput, code::ends_early, {file(), range.end.line()},
          fmt::format("the frame promises {} atoms, but the file ends after {}", *header.count, range.count));
    frame.count = *header.count;
    frame.columns = parse_rows(file(), range, layout);
    frame.box = header.box;
    if (form) frame.properties.emplace_back("position_columns", std::string(form->fields));
    if (form && form->scaled) unscale(frame);
    finish_columns(frame.columns);
    check_ids(frame, header.atoms);
    check_follower(range.end, *header.count);
    check_last_line(range.end);
    return frame;
  }

private:
  [[noreturn]] void refuse(std::string_view code, const Line& line, std::string text,
                           std::vector<std::string> hints = {}) const {
    fail(Exit::BadInput, code, {file(), line.number}, std::move(text), std::move(hints));
  }
  Line value_line(Cursor& cursor, std::string_view section) const {
    const auto line = cursor.next();
    if (!line)
      fail(Exit::BadInput, code::ends_early, {file(), cursor.line()},
           fmt::format("the file ends within section '{}'", section));
    return *line;
  }

  // All sections up to ITEM: ATOMS. The cursor then stands on the first row.
  Header read_header(Cursor& cursor, Frame& frame) const {
    Header header;
    for (;;) {
      const auto line = cursor.next();
      if (!line)
        fail(Exit::BadInput, code::ends_early, {file(), cursor.line()},
             "the file ends before section 'ITEM: ATOMS'");
      const std::string_view text = trim(line->text);
      if (!text.starts_with(item))
        refuse(code::heading, *line,
               fmt::format("{} stands where a section that begins with 'ITEM:' is needed", shown(text)));
      const std::string_view name = trim(text.substr(item.size()));
      if (name == "TIMESTEP") {
        read_step(value_line(cursor, "TIMESTEP"), frame);
        header.has_step = true;
      } else if (name == "NUMBER OF ATOMS") {
        header.count = read_count(value_line(cursor, "NUMBER OF ATOMS"));
      } else if (name.starts_with("BOX BOUNDS")) {
        header.box = read_box(*line, name.substr(10), cursor);
      } else if (name == "UNITS") {
        frame.properties.emplace_back("units", std::string(trim(value_line(cursor, "UNITS").text)));
      } else if (name == "TIME") {
        read_time(value_line(cursor, "TIME"), frame);
      } else if (name == "ATOMS" || name.starts_with("ATOMS ")) {
        header.atoms = *line;
        check_complete(header);
        return header;
      } else {
        refuse(code::heading, *line, fmt::format("section {} is unknown", shown(text)),
               {"sections: TIMESTEP, NUMBER OF ATOMS, BOX BOUNDS, ATOMS, and UNITS, TIME; dumps of grids and "
                "of local entries are not particles"});
      }
    }
  }

  void check_complete(const Header& header) const {
    const char* missing = !header.has_step ? "TIMESTEP"
                          : !header.count  ? "NUMBER OF ATOMS"
                          : !header.box    ? "BOX BOUNDS"
                                           : nullptr;
    if (missing)
      refuse(code::heading, header.atoms,
             fmt::format("section 'ITEM: {}' is missing before 'ITEM: ATOMS'", missing));
  }

  void read_step(const Line& line, Frame& frame) const {
    std::int64_t step = 0;
    if (!parse_integer(trim(line.text), step))
      refuse(code::heading, line,
             fmt::format("the time step is {}, which is no integer", shown(trim(line.text))));
    frame.step = step;
  }
  void read_time(const Line& line, Frame& frame) const {
    double time = 0;
    if (!parse_real(trim(line.text), time))
      refuse(code::heading, line, fmt::format("the time is {}, which is no number", shown(trim(line.text))));
    frame.time = time;
  }
  std::uint64_t read_count(const Line& line) const {
    std::uint64_t count = 0;
    if (!parse_count(trim(line.text), count))
      refuse(code::heading, line,
             fmt::format("the number of atoms is {}, which is no count", shown(trim(line.text))));
    return count;
  }

  std::vector<double> box_numbers(Cursor& cursor, std::size_t wanted) const {
    const Line line = value_line(cursor, "BOX BOUNDS");
    std::vector<double> numbers;
    for (const std::string_view word : split_row(line.text, ' ')) {
      double number = 0;
      if (!parse_real(word, number) || !std::isfinite(number))
        fail(Exit::BadInput, code::box, place_in(file(), line, word),
             fmt::format("{} in the box bounds is not a finite number", shown(word)));
      numbers.push_back(number);
    }
    if (numbers.size() != wanted)
      refuse(code::box, line,
             fmt::format("a line of the box bounds has {} numbers, but this box needs {}", numbers.size(),
                         wanted));
    return numbers;
  }

  // `words` is what follows BOX BOUNDS: "pp pp ff", "xy xz yz pp pp pp", "abc origin pp pp pp" or
  // nothing (old files: periodic). A boundary is periodic when both of its letters are p.
  Box read_box(const Line& heading, std::string_view words, Cursor& cursor) const {
    Box box;
    bool tilted = false, general = false;
    int axis = 0;
    for (const std::string_view word : split_row(words, ' ')) {
      if (word == "xy" || word == "xz" || word == "yz") {
        tilted = true;
      } else if (word == "abc" || word == "origin") {
        general = true;
      } else if (axis < 3 && word.size() <= 2 && word.find_first_not_of("pfsm") == std::string_view::npos) {
        box.periodic[axis++] = word == "pp" || word == "p";
      } else {
        refuse(code::box, heading, fmt::format("{} in the box bounds is unknown", shown(word)));
      }
    }
    std::array<std::vector<double>, 3> rows;
    for (auto& row : rows) row = box_numbers(cursor, general ? 4 : tilted ? 3 : 2);
    if (general)
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k)
          box.edges[i][k] = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
        box.origin[i] = rows[static_cast<std::size_t>(i)][3];
      }
    else
      fill_box(heading, rows, tilted, box);
    return box;
  }

  // lo and hi of a triclinic box bound all eight corners: the tilts are taken off again
  // (docs.lammps.org/Howto_triclinic.html).
  void fill_box(const Line& heading, const std::array<std::vector<double>, 3>& rows, bool tilted,
                Box& box) const {
    const double xy = tilted ? rows[0][2] : 0, xz = tilted ? rows[1][2] : 0, yz = tilted ? rows[2][2] : 0;
    const glm::dvec3 low(rows[0][0] - std::min({0.0, xy, xz, xy + xz}), rows[1][0] - std::min(0.0, yz),
                         rows[2][0]);
    const glm::dvec3 high(rows[0][1] - std::max({0.0, xy, xz, xy + xz}), rows[1][1] - std::max(0.0, yz),
                          rows[2][1]);
    for (int k = 0; k < 3; ++k)
      if (!(high[k] >= low[k]))
        refuse(code::box, heading,
               fmt::format("the box has a negative length along {}: from {} to {}{}", "xyz"[k], low[k],
                           high[k], tilted ? " when the tilts are taken off" : ""));
    box.origin = low;
    box.edges = glm::dmat3({high.x - low.x, 0, 0}, {xy, high.y - low.y, 0}, {xz, yz, high.z - low.z});
  }

  std::vector<Declared> read_names(const Line& atoms, const Cursor& cursor) const {
    std::vector<std::string_view> names = split_row(trim(atoms.text).substr(item.size()), ' ');
    names.erase(names.begin()); // ATOMS
    if (names.size() > max_fields)
      refuse(code::many_columns, atoms,
             fmt::format("the frame has {} columns; at most {} are read", names.size(), max_fields));
    const auto row = cursor.peek();
    const std::vector<std::string_view> first =
        row && !row->text.starts_with(item) ? split_row(row->text, ' ') : std::vector<std::string_view>{};
    std::vector<Declared> declared;
    for (std::size_t i = 0; i < names.size(); ++i)
      declared.push_back(declare(names[i], i < first.size() ? first[i] : ""));
    return declared;
  }

  // The preferred form there is becomes `position`; the others stay as further columns.
  static const PositionForm* choose_position(RowLayout& layout) {
    for (const PositionForm& form : position_forms)
      for (std::uint32_t c = 0; c < layout.columns.size(); ++c) {
        if (layout.columns[c].name != form.group || layout.columns[c].components != 3) continue;
        layout.columns[c].name = "position";
        layout.columns[c].promote = false;
        for (Field& field : layout.fields)
          if (field.column == c) field.kind = Cell::Real;
        return &form;
      }
    return nullptr;
  }

  static void unscale(Frame& frame) {
    for (Column& column : frame.columns) {
      if (column.name != "position") continue;
      auto& values = std::get<std::vector<double>>(column.values);
      for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
        const glm::dvec3 p =
            frame.box->origin + frame.box->edges * glm::dvec3(values[i], values[i + 1], values[i + 2]);
        for (int k = 0; k < 3; ++k) values[i + static_cast<std::size_t>(k)] = p[k];
      }
    }
  }

  void check_ids(const Frame& frame, const Line& atoms) const {
    const Column* column = frame.find("id");
    const auto* ids = column ? std::get_if<std::vector<std::int64_t>>(&column->values) : nullptr;
    if (!ids || ids->size() < 2) return;
    std::vector<std::int64_t> sorted;
    const auto [low, high] = std::minmax_element(ids->begin(), ids->end());
    const std::uint64_t span = static_cast<std::uint64_t>(*high) - static_cast<std::uint64_t>(*low);
    std::vector<bool> seen(span / 32 <= ids->size() ? span + 1 : 0); // dense ids: one bit each
    if (seen.empty()) {
      sorted = *ids;
      std::sort(sorted.begin(), sorted.end());
      const auto twin = std::adjacent_find(sorted.begin(), sorted.end());
      if (twin != sorted.end()) duplicate(*twin, *ids, atoms);
      return;
    }
    for (const std::int64_t id : *ids) {
      const std::uint64_t bit = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(*low);
      if (seen[bit]) duplicate(id, *ids, atoms);
      seen[bit] = true;
    }
  }
  [[noreturn]] void duplicate(std::int64_t id, const std::vector<std::int64_t>& ids,
                              const Line& atoms) const {
    const auto first = std::find(ids.begin(), ids.end(), id);
    const auto second = std::find(first + 1, ids.end(), id);
    const auto line = [&](auto at) {
      return atoms.number + 1 + static_cast<std::uint64_t>(at - ids.begin());
    };
    fail(Exit::BadInput, code::duplicate_id, {file(), line(second)},
         fmt::format("id '{}' is taken already by the atom of line {}", id, line(first)));
  }

  // Behind the atoms: the end, or the sections of a next frame (UNITS and TIME stand before TIMESTEP).
  void check_follower(Cursor cursor, std::uint64_t count) const {
    std::string_view open;
    for (cursor.skip_blank(); const auto line = cursor.next(); cursor.skip_blank()) {
      const std::string_view text = trim(line->text);
      if (text == "ITEM: TIMESTEP") return;
      if (cursor.at_end() && std::string_view("ITEM: TIMESTEP").starts_with(text)) return; // a cut next frame
      if (text != "ITEM: UNITS" && text != "ITEM: TIME")
        refuse(
            code::follows, *line,
            fmt::format("{} follows the {} atoms that the frame promises, where only a next frame can stand",
                        shown(text), count));
      open = text;
      (void)cursor.next();
    }
    if (!open.empty())
      fail(Exit::BadInput, code::follows, {file(), cursor.line()},
           fmt::format("section '{}' stands behind the atoms, and no frame follows it", open));
  }
};

Sureness probe_lammps_dump(const Probe& probe) {
  Cursor cursor(probe.head);
  cursor.skip_blank();
  const auto first = cursor.next();
  if (first && trim(first->text).starts_with("ITEM: ")) return Sureness::Certain;
  return probe.head.find("\nITEM: ") != std::string_view::npos ? Sureness::Likely : Sureness::ByName;
}

} // namespace

Reader lammps_dump_reader();
Reader lammps_dump_reader() {
  return {{"lammps-dump", "LAMMPS text dump (atom, custom), one or many frames", "lammpstrj dump lammpsdump"},
          probe_lammps_dump,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<LammpsDumpSource>(std::move(bytes));
          }};
}

} // namespace mote::data
