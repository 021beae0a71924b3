// SPDX-License-Identifier: MIT
// What the readers of field, mesh and raw files share: numbers out of packed bytes, arrays -> columns with
// canonical names, and the one-frame source. Used by reader_*.cpp only.
//
// Counts come out of files and may lie: times() cannot overflow, need_bytes() and need_memory() refuse
// before anything is allocated.
#pragma once

#include "core/data/binary.hpp"
#include "core/data/bytes.hpp"
#include "core/data/names.hpp"
#include "core/data/source.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mote::data {

enum class Scalar : std::uint8_t {
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float16,
  Float32,
  Float64
};
[[nodiscard]] std::size_t size_of(Scalar type);
constexpr bool is_real(Scalar type) { return type >= Scalar::Float16; }

// a * b, or 2^64 - 1 where that does not fit.
[[nodiscard]] std::uint64_t times(std::uint64_t a, std::uint64_t b);
[[nodiscard]] std::uint64_t plus(std::uint64_t a, std::uint64_t b);

// D004 unless `bytes` are at most three quarters of the machine's memory. `what` begins the sentence:
// "the 1000 x 1000 x 1000 points".
void need_memory(std::uint64_t bytes, const SourceLoc& loc, std::string_view what);
// D006 unless `wanted` <= `there`.
void need_bytes(std::uint64_t wanted, std::uint64_t there, const SourceLoc& loc, std::string_view what);

// Values in memory as a file packs them: `rows` of `components` values, rows `stride` bytes apart (0: one
// behind the other). `bytes` must hold them all: the caller has checked.
struct Packed {
  Scalar type{Scalar::Float64};
  Order order{Order::Little};
  std::uint64_t rows{};
  std::uint32_t components{1};
  std::uint64_t stride{};
};
// A Double column for reals, an Int column for integers; unsigned 64-bit values from 2^63 on make it Double.
Column unpack(std::string name, std::string_view bytes, const Packed& packed);

// A column that holds a position and nothing else; `values` are x y z, x y z, ...
Column position_column(std::vector<double> values);
// "a%20b" -> "a b", as VTK writes names; an empty name becomes "unnamed".
[[nodiscard]] std::string decode_percent(std::string_view name);

// Arrays as the file names them -> frame.columns and frame.count, by the same table of names as text
// formats (names.hpp): x y z become position, a diameter a radius. The first array of a name keeps it.
// All arrays must have the same number of rows. D013 without a position.
void assemble(Frame& frame, std::vector<Column> arrays, const Customs& customs, const SourceLoc& loc);

// D073 when a text does not end with a line end: its last number may have lost digits.
void check_last_line(const Bytes& bytes, Diagnostics& warnings);

// A file that is one frame; `parse` reads all of it anew for each read().
using ParseFile = Frame (*)(Bytes&, Diagnostics& warnings);
std::unique_ptr<Source> one_frame(std::string_view format, std::shared_ptr<Bytes> bytes, ParseFile parse);

} // namespace mote::data
