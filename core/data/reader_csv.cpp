// SPDX-License-Identifier: MIT
// Tables: values between commas, semicolons, tabs or blanks, with or without a row of names, with
// comments behind '#'. Without names the columns are x y z and, if there are four, the radius.
#include "core/data/codes.hpp"
#include "core/data/codes_fields.hpp"
#include "core/data/fields.hpp"
#include "core/data/names.hpp"
#include "core/data/registry.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::data {
namespace {

constexpr Customs csv_customs{
    .quaternion_is_xyzw = false, .shape_is_diameter = false, .units_in_names = true};

bool is_comment(std::string_view line) { return line.starts_with('#'); }

// What the first lines tell about a table.
struct Guess {
  char delimiter{' '};
  std::vector<std::string> names{}; // empty: no row of names
  SourceLoc names_at{};
  Cursor rows{};                         // on the first row of values
  std::vector<std::string_view> first{}; // its fields
};

std::vector<std::string_view> fields_of(std::string_view line, char delimiter) {
  std::vector<std::string_view> fields = split_row(trim(line), delimiter);
  if (fields.size() > 1 && delimiter != ' ' && fields.back().empty()) fields.pop_back();
  return fields;
}

// ';' before ',' because decimal commas go with it; a delimiter must give at least two fields.
char guess_delimiter(std::string_view line) {
  for (const char delimiter : {';', '\t', ','})
    if (fields_of(line, delimiter).size() > 1) return delimiter;
  return ' ';
}

bool names_position(const std::vector<std::string_view>& words) {
  std::vector<Declared> declared;
  for (const std::string_view word : words) declared.push_back({std::string(word)});
  const RowLayout layout = plan_columns(declared, csv_customs);
  return std::any_of(layout.columns.begin(), layout.columns.end(),
                     [](const RowColumn& c) { return c.name == "position" && c.components == 3; });
}

// A row is a row of names when none of its fields is a number.
bool is_names(const std::vector<std::string_view>& fields) {
  return std::none_of(fields.begin(), fields.end(), [](std::string_view f) {
    const Cell kind = kind_of(f);
    return kind == Cell::Integer || kind == Cell::Real;
  });
}

Guess look_at(const std::string& file, std::string_view text) {
  Guess guess;
  Cursor cursor(text);
  Line comment;
  std::optional<Line> line;
  for (line = cursor.peek(); line; line = cursor.peek()) {
    const std::string_view inner = trim(line->text);
    if (!inner.empty() && !is_comment(inner)) break;
    if (is_comment(inner)) comment = *line;
    (void)cursor.next();
  }
  guess.rows = cursor;
  if (!line) return guess;
  guess.delimiter = guess_delimiter(line->text);
  guess.first = fields_of(line->text, guess.delimiter);
  guess.names_at = {file, line->number};
  std::vector<std::string_view> names;
  if (is_names(guess.first)) {
    names = guess.first;
    (void)guess.rows.next();
    Cursor next = guess.rows;
    guess.first.clear();
    for (auto row = next.next(); row && guess.first.empty(); row = next.next())
      if (!trim(row->text).empty() && !is_comment(trim(row->text)))
        guess.first = fields_of(row->text, guess.delimiter);
  } else if (!comment.text.empty()) { // "# x y z" right above the values, if it has as many words
    const std::string_view inner = trim(trim(comment.text).substr(1));
    for (const char delimiter : {guess.delimiter, ' '})
      if (names.empty() && fields_of(inner, delimiter).size() == guess.first.size() &&
          is_names(fields_of(inner, delimiter)))
        names = fields_of(inner, delimiter);
    if (!names_position(names)) names.clear();
    if (!names.empty()) guess.names_at.line = comment.number;
  }
  guess.names.assign(names.begin(), names.end());
  return guess;
}

class CsvSource : public Source {
public:
  explicit CsvSource(std::shared_ptr<Bytes> bytes) : bytes_(std::move(bytes)), text_(bytes_->text()) {
    warnings_.append(bytes_->warnings());
  }
  std::string_view format() const override { return "csv"; }
  std::uint64_t frame_count() override { return 1; }

  Frame read(std::uint64_t frame) override {
    if (frame != 0)
      fail(Exit::BadInput, code::no_frame, {bytes_->name()},
           fmt::format("there is no frame {}: a table is one frame (0)", frame));
    Guess guess = look_at(bytes_->name(), text_);
    if (guess.first.empty() && guess.names.empty())
      fail(Exit::BadInput, code::empty, {bytes_->name()}, "the table has no rows");
    const std::vector<Declared> declared = declare(guess);
    RowLayout layout = plan_columns(declared, csv_customs);
    layout.delimiter = guess.delimiter;
    layout.comment = '#';
    layout.skip_blank = true;
    layout.missing_is_nan = true;
    require_position(layout, declared, guess.names_at);
    Frame out;
    const RowRange range = find_rows(guess.rows, ~std::uint64_t{0}, layout);
    out.columns = parse_rows(bytes_->name(), range, layout);
    out.count = range.count;
    finish_columns(out.columns);
    if (!warnings_.has(field_code::end_mark)) check_last_line(*bytes_, warnings_);
    return out;
  }

private:
  std::vector<Declared> declare(const Guess& guess) {
    const std::size_t fields = guess.names.empty() ? guess.first.size() : guess.names.size();
    if (fields > max_fields)
      fail(Exit::BadInput, code::many_columns, guess.names_at,
           fmt::format("the table has {} columns; at most {} are read", fields, max_fields));
    std::vector<Declared> declared;
    for (std::size_t i = 0; i < fields; ++i) {
      const Cell kind = i < guess.first.size() ? kind_of(guess.first[i]) : Cell::Real;
      declared.push_back({name_of(guess, i, fields), 1, kind == Cell::Skip ? Cell::Real : kind, true});
    }
    if (guess.names.empty() && fields > 4 && !warned_) {
      warned_ = true;
      warnings_.warning(
          code::unnamed, guess.names_at,
          fmt::format(
              "the table has {} columns and no row of names: they are read as x, y, z, column_4 to column_{}",
              fields, fields),
          {"a first row of names says what they are: x,y,z,vx,vy,vz,radius"});
    }
    return declared;
  }
  static std::string name_of(const Guess& guess, std::size_t i, std::size_t fields) {
    if (!guess.names.empty())
      return guess.names[i].empty() ? fmt::format("column_{}", i + 1) : guess.names[i];
    if (fields < 3) return fmt::format("column_{}", i + 1);
    if (i < 3) return std::string(1, "xyz"[i]);
    return fields == 4 ? "radius" : fmt::format("column_{}", i + 1);
  }

  std::shared_ptr<Bytes> bytes_;
  std::string_view text_;
  bool warned_{};
};

// Likely: names with x, y, z among them, or three rows of at least three numbers, all of one length.
Sureness probe_csv(const Probe& probe) {
  const std::string_view head = probe.head;
  if (head.find('\0') != std::string_view::npos) return Sureness::No;
  Guess guess = look_at({}, head);
  if (!guess.names.empty()) {
    std::vector<std::string_view> words(guess.names.begin(), guess.names.end());
    return words.size() <= max_fields && names_position(words) ? Sureness::Likely : Sureness::ByName;
  }
  if (guess.first.size() < 3) return Sureness::ByName;
  int rows = 0;
  for (auto line = guess.rows.next(); line && rows < 3; line = guess.rows.next()) {
    if (trim(line->text).empty() || is_comment(trim(line->text))) continue;
    if (guess.rows.at_end() && head.size() >= (1 << 16)) break; // cut by the probe
    const auto fields = fields_of(line->text, guess.delimiter);
    const bool numbers = fields.size() == guess.first.size() &&
                         std::all_of(fields.begin(), fields.begin() + 3,
                                     [](std::string_view f) { return kind_of(f) != Cell::Text; });
    if (!numbers) return Sureness::ByName;
    ++rows;
  }
  return Sureness::Likely;
}

} // namespace

Reader csv_reader();
Reader csv_reader() {
  return {{"csv", "table with or without a row of names (CSV, TSV, blanks): x y z [radius]",
           "csv tsv txt dat tab"},
          probe_csv,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<CsvSource>(std::move(bytes));
          }};
}

} // namespace mote::data
