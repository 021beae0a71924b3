// SPDX-License-Identifier: MIT
// NumPy arrays (.npy). Shapes: (N, 3) = x y z, (N, 4) = x y z radius, (T, N, 3) and (T, N, 4) = T frames
// of them, (N,) of a structured type = columns by the names of its parts. C and Fortran order, all
// float and integer types, both byte orders; columns are doubles (a structure's integers stay so).
#include "core/base/parallel.hpp"
#include "core/data/codes.hpp"
#include "core/data/names.hpp"
#include "core/data/npy_header.hpp"
#include "core/data/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <new>

namespace mote::data {
namespace {

constexpr Customs npy_customs{
    .quaternion_is_xyzw = false, .shape_is_diameter = false, .units_in_names = false};
constexpr std::uint64_t rows_per_block = 1 << 16;

template <class T> T load(const char* from, bool swap) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), from, sizeof(T));
  if (swap) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

// IEEE 754 binary16.
double half_to_double(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 0x1f;
  const int fraction = bits & 0x3ff;
  double magnitude = std::ldexp(fraction + 1024, exponent - 25);
  if (exponent == 0) magnitude = std::ldexp(fraction, -24);
  if (exponent == 31) magnitude = fraction ? std::nan("") : HUGE_VAL;
  return bits & 0x8000 ? -magnitude : magnitude;
}

// `count` numbers, `step` bytes apart, to out[0], out[stride], ...
template <class T, class Out>
void convert(const char* from, std::uint64_t step, bool swap, std::uint64_t count, Out* out,
             std::uint64_t stride) {
  for (std::uint64_t i = 0; i < count; ++i)
    out[i * stride] = static_cast<Out>(load<T>(from + i * step, swap));
}

template <class Out>
void convert(const NpyScalar& scalar, const char* from, std::uint64_t step, std::uint64_t count, Out* out,
             std::uint64_t stride) {
  const bool swap = scalar.big_endian != (std::endian::native == std::endian::big);
  const int size = static_cast<int>(scalar.size);
  switch (scalar.kind * 16 + size) {
  case 'f' * 16 + 2:
    for (std::uint64_t i = 0; i < count; ++i)
      out[i * stride] = static_cast<Out>(half_to_double(load<std::uint16_t>(from + i * step, swap)));
    return;
  case 'f' * 16 + 4: return convert<float>(from, step, swap, count, out, stride);
  case 'f' * 16 + 8: return convert<double>(from, step, swap, count, out, stride);
  case 'i' * 16 + 1: return convert<std::int8_t>(from, step, swap, count, out, stride);
  case 'i' * 16 + 2: return convert<std::int16_t>(from, step, swap, count, out, stride);
  case 'i' * 16 + 4: return convert<std::int32_t>(from, step, swap, count, out, stride);
  case 'i' * 16 + 8: return convert<std::int64_t>(from, step, swap, count, out, stride);
  case 'b' * 16 + 1:
  case 'u' * 16 + 1: return convert<std::uint8_t>(from, step, swap, count, out, stride);
  case 'u' * 16 + 2: return convert<std::uint16_t>(from, step, swap, count, out, stride);
  case 'u' * 16 + 4: return convert<std::uint32_t>(from, step, swap, count, out, stride);
  default: return convert<std::uint64_t>(from, step, swap, count, out, stride);
  }
}

class NpySource : public Source {
public:
  explicit NpySource(std::shared_ptr<Bytes> bytes)
      : bytes_(std::move(bytes)), header_(parse_npy_header(*bytes_)) {
    warnings_.append(bytes_->warnings());
    find_shape();
    check_length();
  }
  std::string_view format() const override { return "npy"; }
  std::uint64_t frame_count() override { return frames_; }

  Frame read(std::uint64_t frame) override {
    if (frame >= frames_)
      fail(Exit::BadInput, code::no_frame, {bytes_->name()},
           fmt::format("there is no frame {}: the file has {} {} (0 to {})", frame, frames_,
                       frames_ == 1 ? "frame" : "frames", frames_ - 1));
    Frame out;
    out.count = rows_;
    try {
      if (header_.structured)
        read_structure(out);
      else
        read_array(frame, out);
    } catch (const std::bad_alloc&) {
      fail(Exit::BadInput, code::memory, {bytes_->name()},
           fmt::format("there is not enough memory for {} rows", rows_));
    }
    return out;
  }

private:
  std::string shape_text() const {
    std::string out;
    for (const std::uint64_t size : header_.shape) out += fmt::format("{}{}", out.empty() ? "" : ", ", size);
    return fmt::format("({}{})", out, header_.shape.size() == 1 ? "," : "");
  }
  [[noreturn]] void wrong_shape(std::string_view hint) const {
    fail(Exit::BadInput, code::npy_shape, {bytes_->name()},
         fmt::format("an array of shape '{}' does not hold particles", shape_text()),
         {"shapes: (N, 3) = x y z, (N, 4) = x y z radius, (T, N, 3) and (T, N, 4) = T frames, (N,) of a "
          "structure",
          std::string(hint)});
  }

  void find_shape() {
    const auto& shape = header_.shape;
    if (header_.structured) {
      if (shape.size() != 1) wrong_shape("");
      rows_ = shape[0];
      width_ = 1;
      return;
    }
    if (shape.size() != 2 && shape.size() != 3) wrong_shape("");
    width_ = shape.back();
    rows_ = shape[shape.size() - 2];
    frames_ = shape.size() == 3 ? shape[0] : 1;
    if (width_ != 3 && width_ != 4)
      wrong_shape(rows_ == 3 || rows_ == 4 ? "the array seems to be transposed: save array.T" : "");
    if (frames_ == 0) wrong_shape("");
  }

  void check_length() {
    const std::uint64_t there = bytes_->view().size() - header_.data_begin;
    std::uint64_t need = header_.item_size;
    bool beyond = false;
    for (const std::uint64_t factor : {frames_, rows_, width_})
      beyond |= __builtin_mul_overflow(need, factor, &need);
    if (beyond || need > there)
      fail(Exit::BadInput, code::ends_early, byte_place(*bytes_, bytes_->view().size()),
           fmt::format("the shape '{}' needs {} bytes, but {} are there", shape_text(),
                       beyond ? "more than 2^64" : fmt::format("{}", need), there));
    if (need < there)
      warnings_.warning(code::trailing, byte_place(*bytes_, header_.data_begin + need),
                        fmt::format("{} bytes behind the array are ignored", there - need));
  }

  // Element (frame, row, k) lies at frame * f + row * r + k * w elements.
  void read_array(std::uint64_t frame, Frame& out) const {
    const bool fortran = header_.fortran_order;
    const std::uint64_t size = header_.item_size;
    const std::uint64_t row_step = (fortran ? frames_ : width_) * size;
    const std::uint64_t part_step = (fortran ? frames_ * rows_ : 1) * size;
    const std::uint64_t frame_step = (fortran ? 1 : rows_ * width_) * size;
    const char* base = bytes_->view().data() + header_.data_begin + frame * frame_step;
    std::vector<double> position(rows_ * 3), radius(width_ == 4 ? rows_ : 0);
    for_each_block((rows_ + rows_per_block - 1) / rows_per_block, [&](std::size_t block) {
      const std::uint64_t begin = block * rows_per_block;
      const std::uint64_t count = std::min(rows_per_block, rows_ - begin);
      for (std::uint64_t k = 0; k < width_; ++k)
        convert(header_.fields[0].scalar, base + begin * row_step + k * part_step, row_step, count,
                k == 3 ? radius.data() + begin : position.data() + 3 * begin + k,
                k == 3 ? std::uint64_t{1} : std::uint64_t{3});
    });
    out.columns.push_back({"position", 3, std::move(position)});
    if (width_ == 4) out.columns.push_back({"radius", 1, std::move(radius)});
  }

  void read_structure(Frame& out) const {
    std::vector<Declared> declared;
    for (const NpyField& field : header_.fields)
      declared.push_back(
          {field.name, field.components, field.scalar.kind == 'f' ? Cell::Real : Cell::Integer});
    const RowLayout layout = plan_columns(declared, npy_customs);
    require_position(layout, declared, {bytes_->name()});
    for (std::size_t c = 0; c < layout.columns.size(); ++c) out.columns.push_back(empty_column(layout, c));
    std::size_t f = 0;
    for (const NpyField& field : header_.fields)
      for (std::uint32_t k = 0; k < field.components; ++k, ++f) {
        const Field& target = layout.fields[f];
        Column& column = out.columns[target.column];
        const char* from =
            bytes_->view().data() + header_.data_begin + field.offset + std::uint64_t{k} * field.scalar.size;
        std::visit(
            [&](auto& values) {
              if constexpr (!std::is_same_v<std::decay_t<decltype(values)>, TextColumn>)
                convert(field.scalar, from, header_.item_size, rows_, values.data() + target.component,
                        column.components);
            },
            column.values);
      }
    for (std::size_t c = 0; c < layout.columns.size(); ++c)
      if (auto* values = std::get_if<std::vector<double>>(&out.columns[c].values);
          values && layout.columns[c].scale != 1.0)
        for (double& value : *values) value *= layout.columns[c].scale;
    finish_columns(out.columns);
  }
  Column empty_column(const RowLayout& layout, std::size_t c) const {
    const RowColumn& wanted = layout.columns[c];
    const bool whole = wanted.scale == 1.0 &&
                       std::all_of(layout.fields.begin(), layout.fields.end(), [c](const Field& field) {
                         return field.column != c || field.kind == Cell::Integer;
                       });
    Column column{wanted.name, wanted.components, std::vector<double>{}, wanted.unit};
    if (whole)
      column.values = std::vector<std::int64_t>(rows_ * wanted.components);
    else
      column.values = std::vector<double>(rows_ * wanted.components);
    return column;
  }

  std::shared_ptr<Bytes> bytes_;
  NpyHeader header_;
  std::uint64_t frames_{1}, rows_{}, width_{};
};

Sureness probe_npy(const Probe& probe) {
  return probe.head.starts_with(npy_magic) ? Sureness::Certain : Sureness::No;
}

} // namespace

Reader npy_reader();
Reader npy_reader() {
  return {{"npy", "NumPy array: (N, 3), (N, 4) = x y z radius, (T, N, 3), or a structure", "npy"},
          probe_npy,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<NpySource>(std::move(bytes));
          }};
}

} // namespace mote::data
