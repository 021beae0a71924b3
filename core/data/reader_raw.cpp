// SPDX-License-Identifier: MIT
// Raw numbers described by a small TOML file (.moteraw or .toml that says mote_raw = 1): one or more files,
// binary records or text columns, read side by side as columns of the same particles.
//
//   mote_raw = 1
//   box = [20.0, 20.0, 20.0]          # optional: edge lengths of a periodic cell at the origin
//   time = 0.0                        # optional
//   [[file]]
//   path = "galaxy.bin"               # relative to this file
//   kind = "binary"                   # or "text"; binary is the default
//   endian = "little"                 # or "big"
//   header = 32                       # bytes (text: lines) in front of the first record
//   count = 2500                      # optional: to the end of the file
//   layout = ["mass f4", "position f4 3 kpc", "- u1 4"]   # name type [components [unit]]; "-" is skipped
//   [[file.records]]                  # instead of count and layout: kinds of records, one behind the other
//   name = "dark"                     # becomes the column `type`
//   count = 2500
//   layout = [...]
//
// Types: i1 u1 i2 u2 i4 u4 i8 u8 f2 f4 f8; in text files integer and real. A column `id` in several files
// must be the same in all of them.
#include "core/data/codes_fields.hpp"
#include "core/data/fields.hpp"
#include "core/data/registry.hpp"
#include "core/data/text.hpp"
#include "core/toml/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace mote::data {
namespace {

constexpr config::Codes raw_codes{field_code::raw_key, field_code::raw_value, field_code::raw_value,
                                  field_code::raw_value, field_code::raw_key};
constexpr std::array<std::pair<std::string_view, Scalar>, 11> binary_types{{
    {"i1", Scalar::Int8},
    {"u1", Scalar::UInt8},
    {"i2", Scalar::Int16},
    {"u2", Scalar::UInt16},
    {"i4", Scalar::Int32},
    {"u4", Scalar::UInt32},
    {"i8", Scalar::Int64},
    {"u8", Scalar::UInt64},
    {"f2", Scalar::Float16},
    {"f4", Scalar::Float32},
    {"f8", Scalar::Float64},
}};

struct Item {
  std::string name{}, unit{};
  Scalar type{Scalar::Float64};
  std::uint32_t components{1};
  [[nodiscard]] bool skipped() const { return name == "-"; }
};

struct Record {
  std::string name{};
  std::optional<std::uint64_t> count{};
  std::vector<Item> items{};
  SourceLoc loc{};
};

struct RawFile {
  std::string path{};
  bool text{};
  Order order{Order::Little};
  std::uint64_t header{};
  std::vector<Record> records{};
  SourceLoc loc{};
};

Item read_item(const config::Node& node, bool text) {
  Item out;
  if (node.kind != config::Kind::Text)
    fail(Exit::BadInput, field_code::raw_layout, node.loc,
         fmt::format("a layout entry is a text such as \"position f4 3\", not {}", config::to_text(node)));
  Words words(node.text);
  out.name = words.next();
  const std::string_view type = words.next(), components = words.next(), unit = words.next();
  std::vector<std::string> known;
  bool good = false;
  for (const auto& [word, scalar] : binary_types) {
    if (text) break;
    known.emplace_back(word);
    if (word == type) out.type = scalar, good = true;
  }
  if (text) {
    known = {"integer", "real"};
    good = type == "integer" || type == "real";
    out.type = type == "integer" ? Scalar::Int64 : Scalar::Float64;
  }
  if (!good)
    fail(Exit::BadInput, field_code::raw_layout, node.loc,
         fmt::format("the layout entry {} has no known type: {}", shown(node.text), shown(type)),
         {did_you_mean(type, known), "types: " + list_of(known)});
  std::uint64_t count = 1;
  if (!components.empty() && (!parse_count(components, count) || count == 0 || count > max_fields))
    fail(Exit::BadInput, field_code::raw_layout, node.loc,
         fmt::format("the layout entry {} has an impossible number of components: {}", shown(node.text),
                     shown(components)));
  if (!words.next().empty())
    fail(Exit::BadInput, field_code::raw_layout, node.loc,
         fmt::format("the layout entry {} has more than name, type, components and unit", shown(node.text)));
  out.components = static_cast<std::uint32_t>(count);
  out.unit = unit;
  return out;
}

Record read_record(config::TableReader& table, bool text) {
  Record out;
  out.loc = table.node().loc;
  if (const auto count = table.integer("count")) {
    if (*count < 0)
      table.diagnostics().error(
          field_code::raw_value, table.find("count")->loc,
          fmt::format("{} is '{}'; a count is not negative", table.name_of("count"), *count));
    else
      out.count = static_cast<std::uint64_t>(*count);
  }
  const config::Node* layout = table.find("layout");
  if (!layout)
    table.missing("layout", "it says what a record is made of");
  else if (layout->kind != config::Kind::Array || layout->items.empty())
    table.wrong_type(*layout, "layout", "a list of texts");
  else
    for (const config::Node& item : layout->items) out.items.push_back(read_item(item, text));
  std::uint64_t fields = 0;
  for (const Item& item : out.items) fields += item.components;
  if (fields > max_fields)
    fail(Exit::BadInput, code::many_columns, out.loc,
         fmt::format("a record of {} numbers is too wide; {} are possible", fields, max_fields));
  return out;
}

RawFile read_file(const config::Node& node, const std::string& path, Diagnostics& problems) {
  config::TableReader table(node, path, raw_codes, problems);
  RawFile out;
  out.loc = node.loc;
  if (const auto name = table.text("path"))
    out.path = *name;
  else if (!table.find("path"))
    table.missing("path", "it names the file with the numbers");
  const std::vector<std::string> kinds{"binary", "text"}, orders{"little", "big"};
  out.text = table.word("kind", kinds).value_or(0) == 1;
  if (table.word("endian", orders).value_or(0) == 1) out.order = Order::Big;
  if (const auto header = table.integer("header")) {
    if (*header < 0)
      problems.error(field_code::raw_value, table.find("header")->loc,
                     fmt::format("{} is '{}'; it is not negative", table.name_of("header"), *header));
    else
      out.header = static_cast<std::uint64_t>(*header);
  }
  const auto records = table.tables("records");
  for (std::size_t i = 0; i < records.size(); ++i) {
    config::TableReader record(*records[i], fmt::format("{}.records[{}]", path, i), raw_codes, problems);
    out.records.push_back(read_record(record, out.text));
    out.records.back().name = record.text("name").value_or("");
    record.finish();
  }
  if (records.empty()) out.records.push_back(read_record(table, out.text));
  table.finish();
  return out;
}

struct Raw {
  std::vector<RawFile> files{};
  std::optional<std::array<double, 3>> box{};
  std::optional<double> time{};
};

Raw read_description(Bytes& bytes) {
  const config::Node root = config::parse(bytes.text(), bytes.name(), field_code::raw_syntax);
  Diagnostics problems;
  config::TableReader table(root, "", raw_codes, problems);
  Raw out;
  if (const auto version = table.integer("mote_raw"); version && *version != 1)
    problems.error(field_code::raw_value, table.find("mote_raw")->loc,
                   fmt::format("mote_raw is '{}'; the version 1 is known", *version));
  out.box = table.numbers<3>("box", config::positive);
  out.time = table.number("time");
  const auto files = table.tables("file");
  for (std::size_t i = 0; i < files.size(); ++i)
    out.files.push_back(read_file(*files[i], fmt::format("file[{}]", i), problems));
  if (files.empty()) table.missing("file", "it names a file with numbers: [[file]]");
  table.finish();
  problems.sort_by_place();
  for (const Diagnostic& problem : problems.list())
    if (problem.severity == Severity::Error)
      fail(Exit::BadInput, problem.code, problem.loc, problem.text, problem.hints);
  return out;
}

// The columns of one kind of record, `bytes` being all its records.
std::vector<Column> binary_columns(const Record& record, Order order, std::string_view bytes,
                                   std::uint64_t rows, std::uint64_t stride) {
  std::vector<Column> out;
  std::uint64_t offset = 0;
  for (const Item& item : record.items) {
    if (!item.skipped()) {
      out.push_back(unpack(item.name, bytes.substr(rows ? offset : 0),
                           {item.type, order, rows, item.components, stride}));
      out.back().unit = item.unit;
    }
    offset += size_of(item.type) * item.components;
  }
  return out;
}

std::vector<Column> text_columns(const Record& record, const Bytes& bytes, Cursor& cursor) {
  RowLayout layout;
  layout.skip_blank = layout.extra_allowed = true;
  layout.comment = '#';
  for (const Item& item : record.items) {
    const auto column = static_cast<std::uint32_t>(layout.columns.size());
    for (std::uint32_t k = 0; k < item.components; ++k)
      layout.fields.push_back({item.skipped()       ? Cell::Skip
                               : is_real(item.type) ? Cell::Real
                                                    : Cell::Integer,
                               column, k, item.name});
    if (!item.skipped()) layout.columns.push_back({item.name, item.components, 1.0, item.unit, false});
  }
  const RowRange range =
      find_rows(cursor, record.count.value_or(std::numeric_limits<std::uint64_t>::max()), layout);
  if (record.count && range.count != *record.count)
    fail(Exit::BadInput, code::ends_early, {bytes.name(), range.end.line()},
         fmt::format("the file ends early: {} rows are wanted, {} are there", *record.count, range.count));
  cursor = range.end;
  return parse_rows(bytes.name(), range, layout);
}

// The rows of `more` behind those of `all`; a column that one of them lacks is NaN there.
void stack(std::vector<Column>& all, std::uint64_t rows, std::vector<Column> more, std::uint64_t more_rows,
           const SourceLoc& loc) {
  const auto as_reals = [](Column& column) -> std::vector<double>& {
    if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&column.values)) {
      std::vector<double> values(whole->begin(), whole->end());
      column.values = std::move(values);
    }
    return std::get<std::vector<double>>(column.values);
  };
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  for (Column& column : more) {
    const auto same =
        std::find_if(all.begin(), all.end(), [&](const Column& c) { return c.name == column.name; });
    if (same == all.end()) {
      if (rows > 0) {
        auto& values = as_reals(column);
        values.insert(values.begin(), rows * column.components, nothing);
      }
      all.push_back(std::move(column));
    } else if (same->components != column.components) {
      fail(Exit::BadInput, field_code::raw_layout, loc,
           fmt::format("{} has {} components here and {} in the records before", shown(column.name),
                       column.components, same->components));
    } else if (same->type() == ColumnType::Int && column.type() == ColumnType::Int) {
      auto& values = std::get<std::vector<std::int64_t>>(same->values);
      const auto& add = std::get<std::vector<std::int64_t>>(column.values);
      values.insert(values.end(), add.begin(), add.end());
    } else {
      auto& values = as_reals(*same);
      const auto& add = as_reals(column);
      values.insert(values.end(), add.begin(), add.end());
    }
  }
  for (Column& column : all)
    if (column.rows() == rows && more_rows > 0)
      as_reals(column).resize((rows + more_rows) * column.components, nothing);
}

class RawReader {
public:
  RawReader(const std::string& description, Diagnostics& warnings)
      : folder_(std::filesystem::path(description).parent_path()), warnings_(warnings) {}

  // All columns of one file; `rows` is set.
  std::vector<Column> read(const RawFile& file, std::uint64_t& rows) {
    const auto bytes = Bytes::load(folder_ / file.path);
    warnings_.append(bytes->warnings());
    std::vector<Column> all;
    TextColumn kinds;
    rows = 0;
    std::uint64_t at = file.header;
    Cursor cursor(bytes->text());
    if (file.text)
      cursor.skip(file.header);
    else
      need_bytes(file.header, bytes->view().size(), byte_place(*bytes, bytes->view().size()), "the header");
    for (const Record& record : file.records) {
      std::vector<Column> columns =
          file.text ? text_columns(record, *bytes, cursor) : binary_part(file, record, *bytes, at);
      const std::uint64_t more = columns.empty() ? 0 : columns.front().rows();
      stack(all, rows, std::move(columns), more, record.loc);
      rows += more;
      kinds.dictionary.push_back(record.name);
      kinds.codes.resize(rows, static_cast<std::uint32_t>(kinds.dictionary.size() - 1));
    }
    const std::uint64_t size = file.text ? bytes->text().size() : bytes->view().size();
    if (file.text) cursor.skip_blank();
    if (const std::uint64_t end = file.text ? cursor.offset() : at; end < size)
      warnings_.warning(code::trailing,
                        file.text ? SourceLoc{bytes->name(), cursor.line(), 1} : byte_place(*bytes, end),
                        fmt::format("{} bytes behind the last record are ignored", size - end));
    if (std::any_of(kinds.dictionary.begin(), kinds.dictionary.end(),
                    [](const std::string& name) { return !name.empty(); }))
      all.push_back({"type", 1, std::move(kinds), {}});
    return all;
  }

private:
  static std::vector<Column> binary_part(const RawFile& file, const Record& record, const Bytes& bytes,
                                         std::uint64_t& at) {
    std::uint64_t stride = 0;
    for (const Item& item : record.items) stride += size_of(item.type) * item.components;
    const std::uint64_t left = bytes.view().size() - at;
    const std::uint64_t rows = record.count.value_or(left / stride);
    need_bytes(times(rows, stride), left, byte_place(bytes, bytes.view().size()),
               fmt::format("{} records of {} bytes", rows, stride));
    if (!record.count && left % stride != 0)
      fail(Exit::BadInput, field_code::length, byte_place(bytes, at + rows * stride),
           fmt::format("the {} bytes from here are no whole record: a record has {} bytes", left % stride,
                       stride));
    auto out = binary_columns(record, file.order, bytes.view().substr(at, rows * stride), rows, stride);
    at += rows * stride;
    return out;
  }

  std::filesystem::path folder_;
  Diagnostics& warnings_;
};

// Columns of the same particles. An id that is there twice must agree.
void join(std::vector<Column>& all, std::vector<Column> more, const RawFile& file) {
  for (Column& column : more) {
    const auto id = [](const Column& c) { return canonical_name(c.name, c.components) == "id"; };
    const auto first = std::find_if(all.begin(), all.end(), id);
    if (!id(column) || first == all.end()) {
      all.push_back(std::move(column));
      continue;
    }
    for (std::uint64_t r = 0; r < column.rows(); ++r)
      if (column.number(r) != first->number(r))
        fail(Exit::BadInput, field_code::raw_join, file.loc,
             fmt::format(
                 "the files do not hold the same particles: row {} has id {} in {}, but {} in the first file",
                 r + 1, column.number(r), shown(file.path), first->number(r)));
  }
}

Frame parse_raw(Bytes& bytes, Diagnostics& warnings) {
  const Raw raw = read_description(bytes);
  RawReader reader(bytes.name(), warnings);
  std::vector<Column> columns;
  std::uint64_t rows = 0;
  for (std::size_t f = 0; f < raw.files.size(); ++f) {
    std::uint64_t count = 0;
    std::vector<Column> more = reader.read(raw.files[f], count);
    if (f > 0 && count != rows)
      fail(Exit::BadInput, field_code::raw_join, raw.files[f].loc,
           fmt::format("the files do not hold the same particles: {} has {} rows, the first file {}",
                       shown(raw.files[f].path), count, rows));
    rows = count;
    join(columns, std::move(more), raw.files[f]);
  }
  Frame frame;
  assemble(frame, std::move(columns), {}, raw.files.front().loc);
  frame.time = raw.time;
  if (raw.box) {
    frame.box.emplace();
    for (int a = 0; a < 3; ++a) frame.box->edges[a][a] = (*raw.box)[static_cast<std::size_t>(a)];
  }
  return frame;
}

// A line that begins with "mote_raw".
Sureness probe_raw(const Probe& probe) {
  const bool there =
      probe.head.starts_with("mote_raw") || probe.head.find("\nmote_raw") != std::string_view::npos;
  return there ? Sureness::Certain : Sureness::No;
}

} // namespace

Reader raw_reader();
Reader raw_reader() {
  return {{"raw", "raw binary or text numbers, described by a TOML file with mote_raw = 1", "moteraw toml"},
          probe_raw,
          [](std::shared_ptr<Bytes> bytes) { return one_frame("raw", std::move(bytes), parse_raw); }};
}

} // namespace mote::data
