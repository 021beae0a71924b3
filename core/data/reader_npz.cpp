// SPDX-License-Identifier: MIT
// NumPy archives (.npz): each array is a column of its name: (N,) one number, (N, k) k numbers, a structured
// (N,) array gives its parts. position (also pos, xyz, x y z ...) says how many particles there are; without
// one, the only array of shape (N, 3) is it. time, step and box (also cell, lattice; (3,) or (3, 3), a row
// for each vector) describe the frame. Arrays of another length are left out.
#include "core/data/codes_fields.hpp"
#include "core/data/fields.hpp"
#include "core/data/npy_header.hpp"
#include "core/data/registry.hpp"
#include "core/data/text.hpp"
#include "core/data/zip.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::data {
namespace {

Scalar scalar_of(const NpyScalar& type) {
  const std::uint32_t log = type.size == 1 ? 0 : type.size == 2 ? 1 : type.size == 4 ? 2 : 3;
  if (type.kind == 'f') return log == 1 ? Scalar::Float16 : log == 2 ? Scalar::Float32 : Scalar::Float64;
  constexpr std::array<Scalar, 4> with_sign{Scalar::Int8, Scalar::Int16, Scalar::Int32, Scalar::Int64};
  constexpr std::array<Scalar, 4> without{Scalar::UInt8, Scalar::UInt16, Scalar::UInt32, Scalar::UInt64};
  return type.kind == 'i' ? with_sign[log] : without[log];
}

// Fortran order: all first components, then all second ones, ...
template <class T> void to_rows(std::vector<T>& values, std::uint64_t rows, std::uint32_t components) {
  std::vector<T> out(values.size());
  for (std::uint64_t r = 0; r < rows; ++r)
    for (std::uint32_t k = 0; k < components; ++k) out[r * components + k] = values[k * rows + r];
  values = std::move(out);
}

struct Array {
  std::vector<Column> columns{}; // one, or the parts of a structure
  std::vector<std::uint64_t> shape{};
  std::string name{};
};

Array read_array(const Bytes& archive, const ZipMember& member) {
  Array out;
  out.name = member.name.substr(0, member.name.size() - 4);
  const auto bytes =
      Bytes::from_memory(fmt::format("{}:{}", archive.name(), member.name), unzip(archive, member));
  if (!bytes->view().starts_with(npy_magic))
    fail(Exit::BadInput, code::npy_header, byte_place(*bytes, 0), "the member is no .npy array");
  const NpyHeader header = parse_npy_header(*bytes);
  out.shape = header.shape;
  const std::uint64_t rows = header.shape.empty() ? 1 : header.shape[0];
  std::uint64_t width = 1;
  for (std::size_t d = 1; d < header.shape.size(); ++d) width = times(width, header.shape[d]);
  const std::string_view values = bytes->view().substr(header.data_begin);
  need_bytes(times(times(rows, width), header.item_size), values.size(),
             byte_place(*bytes, bytes->view().size()), fmt::format("the array {}", shown(out.name)));
  if (width == 0 || width > max_fields || (header.structured && width != 1)) return out; // left out
  for (const NpyField& field : header.fields) {
    const auto components = static_cast<std::uint32_t>(header.structured ? field.components : width);
    const Order order = field.scalar.big_endian ? Order::Big : Order::Little;
    Column column =
        unpack(header.structured ? field.name : out.name, rows ? values.substr(field.offset) : values,
               {scalar_of(field.scalar), order, rows, components, header.item_size * width});
    if (header.fortran_order && width > 1)
      std::visit(
          [&](auto& held) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(held)>, TextColumn>)
              to_rows(held, rows, components);
          },
          column.values);
    out.columns.push_back(std::move(column));
  }
  return out;
}

// time, step, box: true if `array` was one of them.
bool describes_frame(const Array& array, Frame& frame) {
  if (array.columns.size() != 1) return false;
  const Column& column = array.columns[0];
  const std::string name = lower(array.name);
  if (column.rows() == 1 && column.components == 1) {
    if (name == "time")
      frame.time = column.number(0);
    else if ((name == "step" || name == "timestep") && column.type() == ColumnType::Int)
      frame.step = std::get<std::vector<std::int64_t>>(column.values)[0];
    else
      return false;
    return true;
  }
  if ((name != "box" && name != "cell" && name != "lattice") || column.rows() != 3) return false;
  if (column.components != 1 && column.components != 3) return false;
  Box box;
  for (std::uint32_t v = 0; v < 3; ++v)
    for (std::uint32_t k = 0; k < 3; ++k)
      box.edges[static_cast<int>(v)][static_cast<int>(k)] = column.components == 3 ? column.number(v, k)
                                                            : v == k               ? column.number(v)
                                                                                   : 0.0;
  frame.box = box;
  return true;
}

bool is_position(const Column& column) {
  return canonical_name(column.name, column.components) == "position" ||
         (column.components == 1 && same_word(column.name, "x"));
}

Frame parse_npz(Bytes& bytes, Diagnostics& warnings) {
  std::vector<Column> columns;
  std::vector<std::string> left;
  Frame frame;
  for (const ZipMember& member : zip_members(bytes)) {
    if (!member.name.ends_with(".npy") || member.name.size() == 4) {
      left.push_back(member.name);
      continue;
    }
    Array array = read_array(bytes, member);
    if (describes_frame(array, frame)) continue;
    if (array.columns.empty() || array.shape.empty())
      left.push_back(array.name);
    else
      for (Column& column : array.columns) columns.push_back(std::move(column));
  }
  auto position = std::find_if(columns.begin(), columns.end(), is_position);
  if (position == columns.end()) {
    const auto three = [](const Column& c) { return c.components == 3; };
    position = std::find_if(columns.begin(), columns.end(), three);
    if (position == columns.end() || std::count_if(columns.begin(), columns.end(), three) != 1) {
      std::vector<std::string> names;
      for (const Column& c : columns)
        names.push_back(c.components == 1 ? c.name : fmt::format("{}({})", c.name, c.components));
      fail(Exit::BadInput, code::no_position, {bytes.name()},
           "no array gives the position: one of shape (N, 3) with the name 'position', or x, y and z",
           {"the file has: " + list_of(names)});
    }
    position->name = "position";
  }
  const std::uint64_t rows = position->rows();
  std::erase_if(columns, [&](const Column& c) {
    if (c.rows() != rows) left.push_back(c.name);
    return c.rows() != rows;
  });
  if (!left.empty())
    warnings.note(field_code::left_out, {bytes.name()},
                  fmt::format("arrays of another length than '{}' are left out: {}", rows, list_of(left)));
  assemble(frame, std::move(columns), {}, {bytes.name()});
  return frame;
}

Sureness probe_npz(const Probe& probe) {
  return probe.head.starts_with("PK\3\4") ? Sureness::Likely : Sureness::No;
}

} // namespace

Reader npz_reader();
Reader npz_reader() {
  return {{"npz", "NumPy archive: an array for each column", "npz"},
          probe_npz,
          [](std::shared_ptr<Bytes> bytes) { return one_frame("npz", std::move(bytes), parse_npz); }};
}

} // namespace mote::data
