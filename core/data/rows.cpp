// SPDX-License-Identifier: MIT
#include "core/data/rows.hpp"

#include "core/base/parallel.hpp"
#include "core/data/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <new>
#include <unordered_map>

namespace mote::data {
namespace {

constexpr std::uint64_t rows_per_block = 8192;
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void refuse(std::string_view code, const std::string& file, const Line& line,
                         std::string_view part, std::string text, std::vector<std::string> hints = {}) {
  fail(Exit::BadInput, code, place_in(file, line, part), std::move(text), std::move(hints));
}

bool is_row(std::string_view line, const RowLayout& layout) {
  if (layout.comment == '\0' && !layout.skip_blank) return true;
  const std::string_view inner = trim(line);
  if (inner.empty()) return !layout.skip_blank;
  return layout.comment == '\0' || inner.front() != layout.comment;
}

// Cuts fields one by one, by white space or by a delimiter with quotes.
class Fields {
public:
  Fields(std::string_view line, char delimiter) : words_(line), rest_(line), delimiter_(delimiter) {}
  // The next field; `end` when there is none left. An unclosed quote sets open_quote().
  std::string_view next(bool& end) {
    if (delimiter_ == ' ') {
      const std::string_view word = words_.next();
      end = word.empty();
      return word;
    }
    end = done_;
    return done_ ? std::string_view{} : delimited();
  }
  [[nodiscard]] bool open_quote() const { return open_quote_; }

private:
  std::string_view delimited() {
    std::size_t begin = 0;
    while (begin < rest_.size() && rest_[begin] != delimiter_ && is_space(rest_[begin])) ++begin;
    if (begin < rest_.size() && rest_[begin] == '"') return in_quotes(begin + 1);
    const std::size_t stop = std::min(rest_.find(delimiter_, begin), rest_.size());
    return take(rest_.substr(begin, stop - begin), stop);
  }
  std::string_view in_quotes(std::size_t begin) {
    std::size_t close = rest_.find('"', begin);
    while (close != std::string_view::npos && close + 1 < rest_.size() && rest_[close + 1] == '"')
      close = rest_.find('"', close + 2);
    if (close == std::string_view::npos) {
      open_quote_ = true;
      close = rest_.size();
    }
    const std::size_t stop =
        std::min(rest_.find(delimiter_, std::min(close + 1, rest_.size())), rest_.size());
    return take(rest_.substr(begin, close - begin), stop);
  }
  std::string_view take(std::string_view field, std::size_t stop) {
    done_ = stop == rest_.size();
    rest_.remove_prefix(done_ ? stop : stop + 1);
    while (!field.empty() && is_space(field.back())) field.remove_suffix(1);
    return field;
  }
  Words words_;
  std::string_view rest_;
  char delimiter_;
  bool done_{}, open_quote_{};
};

// The words of one text column that one block met, in the order of their first appearance.
struct Dictionary {
  std::vector<std::string_view> words{};
  std::unordered_map<std::string_view, std::uint32_t> codes{};
  std::uint32_t last{};
  std::uint32_t code_of(std::string_view word) {
    if (last < words.size() && words[last] == word) return last;
    const auto [at, fresh] = codes.try_emplace(word, static_cast<std::uint32_t>(words.size()));
    if (fresh) words.push_back(word);
    return last = at->second;
  }
};

std::string without_double_quotes(std::string_view word) {
  std::string out(word);
  for (std::size_t at = out.find("\"\""); at != std::string::npos; at = out.find("\"\"", at + 1))
    out.erase(at, 1);
  return out;
}

std::string_view kind_words(Cell kind) {
  if (kind == Cell::Integer) return "an integer";
  return kind == Cell::Logical ? "a truth value (T or F)" : "a number";
}

// One pass over all rows into columns of the types that the layout says now.
class Pass {
public:
  Pass(const std::string& file, const RowRange& range, const RowLayout& layout)
      : file_(file), range_(range), layout_(layout), needed_(layout.columns.size()) {
    for (std::atomic<Cell>& cell : needed_) cell = Cell::Skip;
    allocate();
    dictionaries_.resize(range.blocks.size());
    for_each_block(range.blocks.size(), [this](std::size_t block) { parse_block(block); });
  }
  [[nodiscard]] Cell needed(std::size_t column) const { return needed_[column]; }
  std::vector<Column> take() {
    for (std::size_t c = 0; c < columns_.size(); ++c)
      if (auto* text = std::get_if<TextColumn>(&columns_[c].values)) merge(*text, c);
    return std::move(columns_);
  }

private:
  struct Target {
    Cell kind{};
    double* reals{};
    std::int64_t* integers{};
    std::uint32_t* codes{};
    std::uint32_t stride{};
    double scale{1.0};
  };

  void allocate() {
    columns_.resize(layout_.columns.size());
    try {
      for (std::size_t c = 0; c < columns_.size(); ++c) allocate(c);
    } catch (const std::bad_alloc&) {
      fail(Exit::BadInput, code::memory, {file_},
           fmt::format("there is not enough memory for {} rows of {} fields", range_.count,
                       layout_.fields.size()));
    }
    for (const Field& field : layout_.fields) targets_.push_back(target_of(field));
  }
  void allocate(std::size_t c) {
    const RowColumn& wanted = layout_.columns[c];
    Cell widest = Cell::Skip;
    for (const Field& field : layout_.fields)
      if (field.kind != Cell::Skip && field.column == c) widest = std::max(widest, field.kind);
    const std::uint64_t values = range_.count * wanted.components;
    columns_[c] = {wanted.name, wanted.components, std::vector<double>{}, wanted.unit};
    if (widest == Cell::Text) {
      columns_[c].values = TextColumn{std::vector<std::uint32_t>(values), {}};
    } else if (widest == Cell::Real || wanted.scale != 1.0) {
      columns_[c].values = std::vector<double>(values);
    } else {
      columns_[c].values = std::vector<std::int64_t>(values);
    }
  }
  Target target_of(const Field& field) {
    Target target{field.kind};
    if (field.kind == Cell::Skip) return target;
    Column& column = columns_[field.column];
    target.stride = column.components;
    target.scale = layout_.columns[field.column].scale;
    if (auto* reals = std::get_if<std::vector<double>>(&column.values))
      target.reals = reals->data() + field.component;
    if (auto* whole = std::get_if<std::vector<std::int64_t>>(&column.values))
      target.integers = whole->data() + field.component;
    if (auto* text = std::get_if<TextColumn>(&column.values)) target.codes = text->codes.data();
    return target;
  }

  void parse_block(std::size_t block) {
    const RowRange::Block& begin = range_.blocks[block];
    const std::uint64_t end_row =
        block + 1 < range_.blocks.size() ? range_.blocks[block + 1].row : range_.count;
    dictionaries_[block].resize(columns_.size());
    Cursor cursor(range_.end.all(), begin.offset, begin.line);
    for (std::uint64_t row = begin.row; row < end_row;) {
      const auto line = cursor.next();
      if (!line) break;
      if (!is_row(line->text, layout_)) continue;
      parse_row(*line, row++, dictionaries_[block]);
    }
  }

  void parse_row(const Line& line, std::uint64_t row, std::vector<Dictionary>& dictionaries) {
    Fields fields(line.text, layout_.delimiter);
    bool end = false;
    for (std::size_t f = 0; f < targets_.size(); ++f) {
      const std::string_view word = fields.next(end);
      if (end) too_few(line, f);
      if (fields.open_quote())
        refuse(code::quote, file_, line, word,
               fmt::format("the quote before {} is not closed", shown(word)));
      store(line, word, row, f, dictionaries);
    }
    if (layout_.extra_allowed) return;
    const std::string_view extra = fields.next(end);
    if (!end && !(layout_.delimiter != ' ' && extra.empty() && at_line_end(line, extra)))
      too_many(line, extra);
  }
  // A delimiter at the very end of a row adds no field.
  static bool at_line_end(const Line& line, std::string_view extra) {
    const std::string_view inner = trim(line.text);
    return extra.data() >= inner.data() + inner.size();
  }

  void store(const Line& line, std::string_view word, std::uint64_t row, std::size_t f,
             std::vector<Dictionary>& dictionaries) {
    const Target& target = targets_[f];
    const std::uint64_t at = row * target.stride;
    bool logical = false;
    double real = 0;
    std::int64_t integer = 0;
    switch (target.kind) {
    case Cell::Skip: return;
    case Cell::Text: target.codes[row] = dictionaries[layout_.fields[f].column].code_of(word); return;
    case Cell::Real:
      if (!parse_real(word, real)) {
        if (layout_.missing_is_nan && is_missing(word)) {
          real = nan_value;
        } else if (!promoted(f, word)) {
          wrong(line, word, f);
        }
      }
      target.reals[at] = real * target.scale;
      return;
    case Cell::Integer:
      if (!parse_integer(word, integer) && !promoted(f, word)) wrong(line, word, f);
      break;
    case Cell::Logical:
      if (!parse_logical(word, logical)) wrong(line, word, f);
      integer = logical ? 1 : 0;
      break;
    }
    if (target.integers)
      target.integers[at] = integer;
    else
      target.reals[at] = static_cast<double>(integer) * target.scale;
  }

  // True when the column may become wider to hold `word`; notes how wide.
  bool promoted(std::size_t f, std::string_view word) {
    const Field& field = layout_.fields[f];
    const bool missing = layout_.missing_is_nan && is_missing(word);
    const Cell wanted = missing ? Cell::Real : std::max(kind_of(word), Cell::Real);
    const RowColumn& column = layout_.columns[field.column];
    const bool allowed =
        wanted == Cell::Real ? column.promote || missing : column.promote && column.components == 1;
    if (!allowed) return false;
    Cell seen = needed_[field.column];
    while (seen < wanted && !needed_[field.column].compare_exchange_weak(seen, wanted)) {
    }
    return true;
  }

  [[noreturn]] void too_few(const Line& line, std::size_t found) const {
    refuse(code::too_few, file_, line, line.text.substr(line.text.size()),
           fmt::format("the row has {} {}, but {} are needed: '{}' is missing", found,
                       found == 1 ? "value" : "values", targets_.size(), layout_.fields[found].name));
  }
  [[noreturn]] void too_many(const Line& line, std::string_view extra) const {
    refuse(code::too_many, file_, line, extra,
           fmt::format("the row goes on with {} after its {} values", shown(extra), targets_.size()));
  }
  [[noreturn]] void wrong(const Line& line, std::string_view word, std::size_t f) const {
    const bool comma = word.find(',') != std::string_view::npos;
    refuse(code::not_a_value, file_, line, word,
           fmt::format("{} is not {} ('{}')", shown(word), kind_words(layout_.fields[f].kind),
                       layout_.fields[f].name),
           {comma ? std::string("numbers have a decimal point: 1.5") : std::string{}});
  }

  void merge(TextColumn& column, std::size_t c) {
    std::unordered_map<std::string, std::uint32_t> all;
    for (std::size_t block = 0; block < dictionaries_.size(); ++block) {
      std::vector<std::uint32_t> renamed;
      for (const std::string_view word : dictionaries_[block][c].words) {
        std::string clean = layout_.delimiter == ' ' ? std::string(word) : without_double_quotes(word);
        const auto [at, fresh] = all.try_emplace(clean, static_cast<std::uint32_t>(column.dictionary.size()));
        if (fresh) column.dictionary.push_back(std::move(clean));
        renamed.push_back(at->second);
      }
      const std::uint64_t end =
          block + 1 < range_.blocks.size() ? range_.blocks[block + 1].row : range_.count;
      for (std::uint64_t row = range_.blocks[block].row; row < end; ++row)
        column.codes[row] = renamed[column.codes[row]];
    }
  }

  const std::string& file_;
  const RowRange& range_;
  const RowLayout& layout_;
  std::vector<Column> columns_{};
  std::vector<Target> targets_{};
  std::vector<std::vector<Dictionary>> dictionaries_{}; // [block][column]
  std::vector<std::atomic<Cell>> needed_;
};

// A row of n fields has at least 2 n - 1 bytes. Where the text is shorter than that some row is too
// short: it is found and reported before any memory is asked for.
void check_size(const std::string& file, const RowRange& range, const RowLayout& layout) {
  if (range.blocks.empty()) return;
  const std::uint64_t bytes = range.end.offset() - range.blocks.front().offset;
  const std::uint64_t fields = layout.fields.size();
  if (range.count == 0 || bytes / range.count + 1 >= fields) return;
  Cursor cursor(range.end.all(), range.blocks.front().offset, range.blocks.front().line);
  for (std::uint64_t row = 0; row < range.count;) {
    const auto line = cursor.next();
    if (!line) return;
    if (!is_row(line->text, layout)) continue;
    ++row;
    const std::size_t found = split_row(line->text, layout.delimiter).size();
    if (found < fields)
      refuse(code::too_few, file, *line, line->text.substr(line->text.size()),
             fmt::format("the row has {} {}, but {} are needed: '{}' is missing", found,
                         found == 1 ? "value" : "values", fields, layout.fields[found].name));
  }
}

} // namespace

RowRange find_rows(const Cursor& begin, std::uint64_t count, const RowLayout& layout) {
  RowRange range;
  range.end = begin;
  const bool all_lines = layout.comment == '\0' && !layout.skip_blank;
  while (range.count < count && !range.end.at_end()) {
    RowRange::Block block{range.end.offset(), range.end.line(), range.count};
    const std::uint64_t wanted = std::min(rows_per_block, count - range.count);
    if (all_lines) {
      range.count += range.end.skip(wanted);
    } else {
      for (std::uint64_t found = 0; found < wanted;) {
        const auto line = range.end.next();
        if (!line) break;
        if (is_row(line->text, layout)) ++found, ++range.count;
      }
    }
    if (range.count > block.row) range.blocks.push_back(block);
  }
  return range;
}

std::vector<Column> parse_rows(const std::string& file, const RowRange& range, RowLayout& layout) {
  check_size(file, range, layout);
  for (;;) {
    Pass pass(file, range, layout);
    bool again = false;
    for (Field& field : layout.fields) {
      if (field.kind == Cell::Skip || pass.needed(field.column) <= field.kind) continue;
      field.kind = pass.needed(field.column);
      again = true;
    }
    if (!again) return pass.take();
  }
}

std::vector<std::string_view> split_row(std::string_view line, char delimiter) {
  std::vector<std::string_view> out;
  Fields fields(line, delimiter);
  bool end = false;
  for (std::string_view word = fields.next(end); !end; word = fields.next(end)) out.push_back(word);
  return out;
}

bool is_missing(std::string_view word) {
  return word.empty() || word == "-" || same_word(word, "na") || same_word(word, "n/a") ||
         same_word(word, "null") || same_word(word, "none");
}

Cell kind_of(std::string_view word) {
  std::int64_t integer = 0;
  double real = 0;
  if (is_missing(word)) return Cell::Skip;
  if (parse_integer(word, integer)) return Cell::Integer;
  return parse_real(word, real) ? Cell::Real : Cell::Text;
}

} // namespace mote::data
