// SPDX-License-Identifier: MIT
#include "core/data/fields.hpp"

#include "core/data/codes_fields.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <type_traits>

namespace mote::data {
namespace {

// IEEE 754 binary16.
double half_to_double(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 0x1f;
  const int fraction = bits & 0x3ff;
  double magnitude = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(fraction + 1024, exponent - 25);
  if (exponent == 31) magnitude = fraction ? std::nan("") : HUGE_VAL;
  return bits & 0x8000 ? -magnitude : magnitude;
}

template <class T, class Out>
void copy_rows(std::string_view bytes, const Packed& packed, std::vector<Out>& out) {
  const std::uint64_t stride = packed.stride ? packed.stride : sizeof(T) * packed.components;
  out.resize(packed.rows * packed.components);
  Out* to = out.data();
  for (std::uint64_t row = 0; row < packed.rows; ++row) {
    const char* from = bytes.data() + row * stride;
    for (std::uint32_t k = 0; k < packed.components; ++k)
      *to++ = static_cast<Out>(load_number<T>(from + k * sizeof(T), packed.order));
  }
}

template <class T> void unpack_as(Column& column, std::string_view bytes, const Packed& packed) {
  if constexpr (std::is_floating_point_v<T>) {
    copy_rows<T>(bytes, packed, column.values.emplace<std::vector<double>>());
  } else {
    auto& whole = column.values.emplace<std::vector<std::int64_t>>();
    copy_rows<T>(bytes, packed, whole);
    if constexpr (std::is_same_v<T, std::uint64_t>)
      if (std::any_of(whole.begin(), whole.end(), [](std::int64_t v) { return v < 0; }))
        copy_rows<T>(bytes, packed, column.values.emplace<std::vector<double>>());
  }
}

// One column of the layout: which arrays and components it is made of.
struct Piece {
  std::size_t array{};
  std::uint32_t component{};
};

std::string as_mebibytes(std::uint64_t bytes) { return fmt::format("{} MiB", (bytes >> 20) + 1); }

// All pieces are one array in order: it can be taken as it is.
bool is_whole(const std::vector<Piece>& pieces, const std::vector<Column>& arrays) {
  const Column& first = arrays[pieces.front().array];
  if (first.components != pieces.size()) return false;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (pieces[k].array != pieces.front().array || pieces[k].component != k) return false;
  return true;
}

Column gather(const std::vector<Piece>& pieces, std::vector<Column>& arrays, const RowColumn& plan,
              std::uint64_t rows) {
  Column out;
  const auto components = static_cast<std::uint32_t>(pieces.size());
  const bool whole_numbers = plan.name != "position" && plan.scale == 1.0 &&
                             std::all_of(pieces.begin(), pieces.end(), [&](const Piece& p) {
                               return arrays[p.array].type() == ColumnType::Int;
                             });
  const bool real_position =
      plan.name == "position" && arrays[pieces.front().array].type() == ColumnType::Double;
  if (is_whole(pieces, arrays) && plan.scale == 1.0 && (plan.name != "position" || real_position)) {
    out = std::move(arrays[pieces.front().array]);
  } else if (whole_numbers) {
    auto& values = out.values.emplace<std::vector<std::int64_t>>(rows * components);
    for (std::uint32_t k = 0; k < components; ++k) {
      const Column& from = arrays[pieces[k].array];
      const auto& held = std::get<std::vector<std::int64_t>>(from.values);
      for (std::uint64_t r = 0; r < rows; ++r)
        values[r * components + k] = held[r * from.components + pieces[k].component];
    }
  } else {
    auto& values = out.values.emplace<std::vector<double>>(rows * components);
    for (std::uint32_t k = 0; k < components; ++k)
      for (std::uint64_t r = 0; r < rows; ++r)
        values[r * components + k] = arrays[pieces[k].array].number(r, pieces[k].component) * plan.scale;
  }
  out.name = plan.name;
  out.components = components;
  if (!plan.unit.empty()) out.unit = plan.unit;
  return out;
}

class OneFrame final : public Source {
public:
  OneFrame(std::string_view format, std::shared_ptr<Bytes> bytes, ParseFile parse)
      : format_(format), bytes_(std::move(bytes)), parse_(parse) {}
  [[nodiscard]] std::string_view format() const override { return format_; }
  [[nodiscard]] std::uint64_t frame_count() override { return 1; }
  [[nodiscard]] Frame read(std::uint64_t frame) override {
    if (frame != 0)
      fail(Exit::BadInput, code::no_frame, {bytes_->name()},
           fmt::format("there is no frame {}: the file has 1 frame (0 to 0)", frame));
    warnings_ = bytes_->warnings();
    try {
      return parse_(*bytes_, warnings_);
    } catch (const std::bad_alloc&) {
      fail(Exit::BadInput, code::memory, {bytes_->name()}, "there is not enough memory for the content");
    }
  }

private:
  std::string_view format_;
  std::shared_ptr<Bytes> bytes_;
  ParseFile parse_;
};

} // namespace

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 11> sizes{1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t top = std::numeric_limits<std::uint64_t>::max();
  return b != 0 && a > top / b ? top : a * b;
}
std::uint64_t plus(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t top = std::numeric_limits<std::uint64_t>::max();
  return a > top - b ? top : a + b;
}

void need_memory(std::uint64_t bytes, const SourceLoc& loc, std::string_view what) {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page = ::sysconf(_SC_PAGESIZE);
  const std::uint64_t limit =
      pages > 0 && page > 0 ? static_cast<std::uint64_t>(pages) / 4 * 3 * static_cast<std::uint64_t>(page)
                            : std::uint64_t{1} << 32;
  if (bytes > limit)
    fail(Exit::BadInput, code::memory, loc,
         fmt::format("{} need {} of memory, but {} may be used", what, as_mebibytes(bytes),
                     as_mebibytes(limit)));
}

void need_bytes(std::uint64_t wanted, std::uint64_t there, const SourceLoc& loc, std::string_view what) {
  if (wanted > there)
    fail(Exit::BadInput, code::ends_early, loc,
         fmt::format("the file ends early: {} needs {} bytes, but {} are left", what, wanted, there));
}

Column unpack(std::string name, std::string_view bytes, const Packed& packed) {
  Column column{std::move(name), packed.components, {}, {}};
  switch (packed.type) {
  case Scalar::Int8: unpack_as<std::int8_t>(column, bytes, packed); break;
  case Scalar::UInt8: unpack_as<std::uint8_t>(column, bytes, packed); break;
  case Scalar::Int16: unpack_as<std::int16_t>(column, bytes, packed); break;
  case Scalar::UInt16: unpack_as<std::uint16_t>(column, bytes, packed); break;
  case Scalar::Int32: unpack_as<std::int32_t>(column, bytes, packed); break;
  case Scalar::UInt32: unpack_as<std::uint32_t>(column, bytes, packed); break;
  case Scalar::Int64: unpack_as<std::int64_t>(column, bytes, packed); break;
  case Scalar::UInt64: unpack_as<std::uint64_t>(column, bytes, packed); break;
  case Scalar::Float16: {
    unpack_as<std::uint16_t>(column, bytes, packed);
    const auto bits = std::get<std::vector<std::int64_t>>(std::move(column.values));
    auto& values = column.values.emplace<std::vector<double>>(bits.size());
    std::transform(bits.begin(), bits.end(), values.begin(),
                   [](std::int64_t half) { return half_to_double(static_cast<std::uint16_t>(half)); });
    break;
  }
  case Scalar::Float32: unpack_as<float>(column, bytes, packed); break;
  case Scalar::Float64: unpack_as<double>(column, bytes, packed); break;
  }
  return column;
}

Column position_column(std::vector<double> values) { return {"position", 3, std::move(values), {}}; }

std::string decode_percent(std::string_view name) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'                     ? c - '0'
           : (c | 0x20) >= 'a' && (c | 0x20) <= 'f' ? (c | 0x20) - 'a' + 10
                                                    : -1;
  };
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '%' && i + 2 < name.size() && digit(name[i + 1]) >= 0 && digit(name[i + 2]) >= 0) {
      out += static_cast<char>(digit(name[i + 1]) * 16 + digit(name[i + 2]));
      i += 2;
    } else {
      out += name[i];
    }
  }
  return out.empty() ? "unnamed" : out;
}

void assemble(Frame& frame, std::vector<Column> arrays, const Customs& customs, const SourceLoc& loc) {
  std::vector<Declared> declared;
  for (const Column& array : arrays) {
    constexpr std::array<Cell, 3> kinds{Cell::Real, Cell::Integer, Cell::Text};
    declared.push_back({array.name, array.components, kinds[array.values.index()], false});
  }
  const RowLayout layout = plan_columns(declared, customs);
  require_position(layout, declared, loc);
  std::vector<std::vector<Piece>> pieces(layout.columns.size());
  std::size_t field = 0;
  for (std::size_t a = 0; a < arrays.size(); ++a)
    for (std::uint32_t k = 0; k < arrays[a].components; ++k, ++field) {
      auto& column = pieces[layout.fields[field].column];
      if (column.size() <= layout.fields[field].component) column.resize(layout.fields[field].component + 1);
      column[layout.fields[field].component] = {a, k};
    }
  frame.count = arrays.front().rows();
  for (std::size_t c = 0; c < layout.columns.size(); ++c)
    frame.columns.push_back(gather(pieces[c], arrays, layout.columns[c], frame.count));
  finish_columns(frame.columns);
}

void check_last_line(const Bytes& bytes, Diagnostics& warnings) {
  const std::string_view all = bytes.view();
  if (!all.ends_with('\n'))
    warnings.warning(field_code::end_mark, byte_place(bytes, all.size()),
                     "the last line has no line end: the file may be cut off");
}

std::unique_ptr<Source> one_frame(std::string_view format, std::shared_ptr<Bytes> bytes, ParseFile parse) {
  return std::make_unique<OneFrame>(format, std::move(bytes), parse);
}

} // namespace mote::data
