// SPDX-License-Identifier: MIT
// Rows of values -> columns: the inner loop of every text format. A reader says which field of a row
// goes to which column (RowLayout), names the lines (RowRange) and gets columns, read by all cores at
// once. It knows nothing of formats: no names, no units, no meaning.
//
// Errors name the line and column of the first bad value of the file, whatever thread met it: D006
// (too few lines), D010, D011 (too few, too many values), D012 (not a value), D021 (open quote).
#pragma once

#include "core/data/dataset.hpp"
#include "core/data/text.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace mote::data {

enum class Cell : std::uint8_t { Skip, Integer, Logical, Real, Text };

// One field of a row, in the order of the file.
struct Field {
  Cell kind{Cell::Real};
  std::uint32_t column{};    // of RowLayout::columns
  std::uint32_t component{}; // of that column
  std::string name{};        // for messages: what the file calls it
};

// What the fields fill. A column whose fields are all Integer or Logical becomes Int; mixed kinds
// among the components become Double.
struct RowColumn {
  std::string name{};
  std::uint32_t components{1};
  double scale{1.0}; // multiplies Real values (a diameter halved); such a column is always Double
  std::string unit{};
  bool promote{}; // a value that does not fit turns the column into Double, then into Text
};

struct RowLayout {
  std::vector<Field> fields{};
  std::vector<RowColumn> columns{};
  char delimiter{' '};   // ' ' = runs of white space
  char comment{'\0'};    // lines that begin with it are no rows ('\0': none)
  bool skip_blank{};     // blank lines are no rows
  bool extra_allowed{};  // values behind the last field are ignored
  bool missing_is_nan{}; // an empty field, NA, null, none, -: NaN (an Integer column becomes Double)
};

// The rows of one frame, cut into blocks for the cores; made by find_rows().
struct RowRange {
  struct Block {
    std::uint64_t offset{}, line{}, row{};
  };
  std::vector<Block> blocks{};
  std::uint64_t count{};
  Cursor end{}; // behind the last row
};

// Where the next `count` rows begin and end; fewer when the text ends (the caller decides whether that
// is an error).
RowRange find_rows(const Cursor& begin, std::uint64_t count, const RowLayout& layout);

// Reads all rows of `range`. `file` is for messages. May change `layout` where columns were promoted.
std::vector<Column> parse_rows(const std::string& file, const RowRange& range, RowLayout& layout);

// One row as words, by the layout's delimiter; quotes are taken off. For headers and guesses.
std::vector<std::string_view> split_row(std::string_view line, char delimiter);
// The narrowest kind that holds `word`: Integer, Real or Text; Skip for a missing value.
[[nodiscard]] Cell kind_of(std::string_view word);
[[nodiscard]] bool is_missing(std::string_view word);

} // namespace mote::data
