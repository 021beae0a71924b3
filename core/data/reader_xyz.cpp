// SPDX-License-Identifier: MIT
// XYZ and extended XYZ. Line 1: the count; line 2: a comment, in the extended form with key=value
// pairs (Properties, Lattice, pbc, Origin, ...); then one line for each particle. Frames follow each
// other. Specification: github.com/libAtoms/extxyz. Lattice rows are the cell vectors.
#include "core/data/codes.hpp"
#include "core/data/key_values.hpp"
#include "core/data/names.hpp"
#include "core/data/registry.hpp"
#include "core/data/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote::data {
namespace {

// OVITO writes `orientation` as x y z w into these files.
constexpr Customs xyz_customs{
    .quaternion_is_xyzw = true, .shape_is_diameter = false, .units_in_names = false};

// The word of a line that holds nothing else.
bool lone_count(std::string_view line, std::uint64_t& count) { return parse_count(trim(line), count); }

class XyzSource : public TextTrajectory {
public:
  explicit XyzSource(std::shared_ptr<Bytes> bytes) : TextTrajectory(std::move(bytes)) {}
  std::string_view format() const override { return "xyz"; }

protected:
  Step skip_frame(Cursor& cursor) const override {
    const auto line = cursor.next();
    std::uint64_t count = 0;
    if (!line || !lone_count(line->text, count)) return Step::Broken;
    if (!cursor.next()) return Step::Cut;
    return cursor.skip(count) == count ? Step::Whole : Step::Cut;
  }

  Frame read_frame(Cursor cursor) override {
    const std::uint64_t count = read_count(cursor);
    const auto comment = cursor.next();
    if (!comment)
      fail(Exit::BadInput, code::ends_early, {file(), cursor.line()},
           fmt::format("the file ends before the comment line of {} particles", count));
    Frame frame;
    std::vector<Declared> declared;
    bool extended = is_extended(comment->text);
    if (extended) {
      declared = read_pairs(*comment, frame);
      extended = !declared.empty();
    } else if (!trim(comment->text).empty()) {
      frame.properties.emplace_back("comment", std::string(trim(comment->text)));
    }
    if (!extended) declared = plain_columns(cursor);
    read_rows(cursor, count, *comment, declared, extended, frame);
    return frame;
  }

private:
  std::uint64_t read_count(Cursor& cursor) const {
    const auto line = cursor.next();
    std::uint64_t count = 0;
    if (!line || !lone_count(line->text, count))
      fail(Exit::BadInput, code::heading, {file(), line ? line->number : cursor.line()},
           fmt::format("the first line of a frame is {}, but the number of particles is needed there",
                       shown(trim(line ? line->text : ""))));
    return count;
  }

  static bool is_extended(std::string_view comment) {
    const std::string text = lower(comment);
    for (const std::string_view key : {"properties", "lattice"})
      for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
        std::size_t end = at + key.size();
        while (end < text.size() && is_space(text[end])) ++end;
        if (end < text.size() && text[end] == '=') return true;
      }
    return false;
  }

  // Fills box, time, step and properties; returns the columns of Properties (none: plain columns).
  std::vector<Declared> read_pairs(const Line& comment, Frame& frame) const {
    std::vector<Declared> declared;
    std::optional<glm::bvec3> periodic;
    glm::dvec3 origin(0.0);
    double number = 0;
    for (KeyValue& pair : parse_key_values(file(), comment)) {
      const SourceLoc loc = place_in(file(), comment, pair.at);
      if (same_word(pair.key, "Properties")) {
        declared = read_properties(pair.value, loc);
      } else if (same_word(pair.key, "Lattice")) {
        frame.box = read_lattice(pair.value, loc);
      } else if (same_word(pair.key, "pbc")) {
        periodic = read_periodic(pair.value, loc);
      } else if (same_word(pair.key, "Origin")) {
        origin = read_origin(pair.value, loc);
      } else if (same_word(pair.key, "time") && parse_real(pair.value, number)) {
        frame.time = number;
      } else if ((same_word(pair.key, "step") || same_word(pair.key, "timestep")) &&
                 read_step(pair.value, frame)) {
      } else {
        frame.properties.emplace_back(std::move(pair.key), std::move(pair.value));
      }
    }
    if (frame.box) {
      frame.box->origin = origin;
      frame.box->periodic = periodic.value_or(glm::bvec3(true));
    }
    return declared;
  }

  static bool read_step(std::string_view value, Frame& frame) {
    std::int64_t step = 0;
    if (!parse_integer(value, step)) return false;
    frame.step = step;
    return true;
  }

  // name:TYPE:columns triples (TYPE: S text, I integer, R real, L truth value).
  std::vector<Declared> read_properties(std::string_view value, const SourceLoc& loc) const {
    std::vector<std::string_view> parts;
    for (std::string_view rest = value;;) {
      const std::size_t colon = rest.find(':');
      parts.push_back(rest.substr(0, colon));
      if (colon == std::string_view::npos) break;
      rest.remove_prefix(colon + 1);
    }
    auto refuse = [&](std::string_view code, std::string text) {
      fail(Exit::BadInput, code, loc, std::move(text),
           {"Properties are name:TYPE:columns, name:TYPE:columns, ... with TYPE S, I, R or L"});
    };
    if (parts.size() % 3 != 0)
      refuse(code::properties, fmt::format("Properties {} have {} parts, which is no multiple of three",
                                           shown(value), parts.size()));
    std::vector<Declared> out;
    std::uint64_t fields = 0;
    for (std::size_t i = 0; i < parts.size(); i += 3) {
      std::uint64_t columns = 0;
      if (parts[i].empty())
        refuse(code::properties, fmt::format("a name is missing in Properties {}", shown(value)));
      if (parts[i + 1].size() != 1 ||
          std::string_view("SIRL").find(parts[i + 1][0]) == std::string_view::npos)
        refuse(code::properties, fmt::format("the type of '{}' is {}, which is none of S, I, R, L", parts[i],
                                             shown(parts[i + 1])));
      if (!parse_count(parts[i + 2], columns) || columns == 0)
        refuse(code::properties,
               fmt::format("the number of columns of '{}' is {}", parts[i], shown(parts[i + 2])));
      fields += std::min<std::uint64_t>(columns, max_fields + 1);
      if (fields > max_fields)
        refuse(code::many_columns, fmt::format("Properties ask for more than {} columns", max_fields));
      add_property(std::string(parts[i]), parts[i + 1][0], static_cast<std::uint32_t>(columns), out);
    }
    return out;
  }

  static void add_property(std::string name, char type, std::uint32_t columns, std::vector<Declared>& out) {
    if (type == 'S' && columns > 1) {
      for (std::uint32_t k = 1; k <= columns; ++k)
        out.push_back({fmt::format("{}[{}]", name, k), 1, Cell::Text});
      return;
    }
    const Cell kind = type == 'S'   ? Cell::Text
                      : type == 'I' ? Cell::Integer
                      : type == 'L' ? Cell::Logical
                                    : Cell::Real;
    out.push_back({std::move(name), columns, kind});
  }

  // Nine numbers (rows are the cell vectors) or three (a rectangular cell); all zero: no cell.
  std::optional<Box> read_lattice(std::string_view value, const SourceLoc& loc) const {
    std::vector<double> n;
    const bool numbers = parse_reals(value, n);
    if (!numbers || (n.size() != 9 && n.size() != 3) ||
        !std::all_of(n.begin(), n.end(), [](double v) { return std::isfinite(v); }))
      fail(Exit::BadInput, code::box, loc,
           fmt::format("Lattice {} is not nine (or three) finite numbers", shown(value)));
    if (std::all_of(n.begin(), n.end(), [](double v) { return v == 0; })) return std::nullopt;
    Box box;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        box.edges[i][k] = n.size() == 9 ? n[static_cast<std::size_t>(3 * i + k)]
                                        : (i == k ? n[static_cast<std::size_t>(i)] : 0.0);
    return box;
  }

  glm::dvec3 read_origin(std::string_view value, const SourceLoc& loc) const {
    std::vector<double> n;
    if (!parse_reals(value, n) || n.size() != 3 || !std::isfinite(n[0] + n[1] + n[2]))
      fail(Exit::BadInput, code::box, loc,
           fmt::format("Origin {} is not three finite numbers", shown(value)));
    return {n[0], n[1], n[2]};
  }

  glm::bvec3 read_periodic(std::string_view value, const SourceLoc& loc) const {
    std::string plain(value);
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == ',' || c == '[' || c == ']'; }, ' ');
    Words words(plain);
    glm::bvec3 out(false);
    bool good = true;
    for (int k = 0; k < 3 && good; ++k) {
      const std::string_view word = words.next();
      bool flag = false;
      good = parse_logical(word, flag) || word == "0" || word == "1";
      out[k] = flag || word == "1";
    }
    if (!good || !words.next().empty())
      fail(Exit::BadInput, code::box, loc, fmt::format("pbc {} is not three of T and F", shown(value)));
    return out;
  }

  // Without Properties: a label and x y z; the rest of a row is ignored. The label may be a number (a
  // type) or be left out.
  static std::vector<Declared> plain_columns(const Cursor& cursor) {
    const auto row = cursor.peek();
    const std::vector<std::string_view> words =
        row ? split_row(row->text.substr(0, 256), ' ') : std::vector<std::string_view>{};
    std::vector<Declared> out;
    const bool numbers = !words.empty() && kind_of(words[0]) <= Cell::Real && kind_of(words[0]) != Cell::Skip;
    if (words.size() != 3 || !numbers)
      out.push_back(numbers ? Declared{"type", 1, Cell::Integer, true} : Declared{"element", 1, Cell::Text});
    for (const char* name : {"x", "y", "z"}) out.push_back({name, 1, Cell::Real});
    return out;
  }

  void read_rows(const Cursor& cursor, std::uint64_t count, const Line& comment,
                 const std::vector<Declared>& declared, bool extended, Frame& frame) {
    RowLayout layout = plan_columns(declared, xyz_customs);
    layout.extra_allowed = !extended;
    require_position(layout, declared, {file(), comment.number});
    const RowRange range = find_rows(cursor, count, layout);
    if (range.count < count)
      fail(Exit::BadInput, code::ends_early, {file(), range.end.line()},
           fmt::format("the frame promises {} particles, but the file ends after {}", count, range.count));
    frame.columns = parse_rows(file(), range, layout);
    frame.count = count;
    finish_columns(frame.columns);
    check_follower(range.end, count);
    check_last_line(range.end);
  }

  void check_follower(Cursor cursor, std::uint64_t count) const {
    cursor.skip_blank();
    const auto line = cursor.next();
    std::uint64_t ignored = 0;
    if (line && !lone_count(line->text, ignored))
      fail(Exit::BadInput, code::follows, {file(), line->number},
           fmt::format("{} follows the {} particles that the frame promises, where only the count of a next "
                       "frame can stand",
                       shown(trim(line->text)), count));
  }
};

Sureness probe_xyz(const Probe& probe) {
  Cursor cursor(probe.head);
  cursor.skip_blank();
  const auto first = cursor.next();
  std::uint64_t count = 0;
  if (!first || !lone_count(first->text, count)) return Sureness::ByName;
  if (const auto second = cursor.next()) {
    const std::string text = lower(second->text);
    if (text.find("properties=") != std::string::npos || text.find("lattice=") != std::string::npos)
      return Sureness::Certain;
  }
  return Sureness::Likely;
}

} // namespace

Reader xyz_reader();
Reader xyz_reader() {
  return {{"xyz", "XYZ and extended XYZ, one or many frames", "xyz extxyz exyz"},
          probe_xyz,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<XyzSource>(std::move(bytes));
          }};
}

} // namespace mote::data
