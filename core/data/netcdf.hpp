// SPDX-License-Identifier: MIT
// The header of a NetCDF file of the classic kinds: CDF-1 (32-bit offsets), CDF-2 (64-bit offsets) and
// CDF-5 (64-bit data). Big-endian; everything is stated before the data, and the place of every value
// follows by arithmetic ("The NetCDF Classic Format Specification", Unidata). reader_netcdf.cpp calls
// it. HDF5-based NetCDF-4 is another format. It knows no conventions: no names, no units.
#pragma once

#include "core/data/binary.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mote::data {

enum class NcType : std::uint8_t {
  None,
  Byte,
  Char,
  Short,
  Int,
  Float,
  Double,
  UByte,
  UShort,
  UInt,
  Int64,
  UInt64
};
[[nodiscard]] std::uint64_t width_of(NcType type);

struct NcAttribute {
  std::string name{};
  NcType type{};
  std::string_view raw{}; // as in the file
};

struct NcVariable {
  std::string name{};
  std::vector<std::uint32_t> dimensions{}; // indices, slowest first
  std::vector<NcAttribute> attributes{};
  NcType type{};
  bool record{};          // its first dimension is the unlimited one
  std::uint64_t values{}; // in one record, or in all
  std::uint64_t at{};     // of the first value
  [[nodiscard]] std::string text(std::string_view attribute) const;             // "" = none
  [[nodiscard]] std::optional<double> number(std::string_view attribute) const; // its first value
};

struct NcHeader {
  struct Dimension {
    std::string name{};
    std::uint64_t length{}; // 0: unlimited
  };
  std::vector<Dimension> dimensions{};
  std::vector<NcAttribute> attributes{};
  std::vector<NcVariable> variables{};
  std::uint64_t records{};        // that the file holds completely
  std::uint64_t stated_records{}; // as in the file; all ones: not known to the writer
  std::uint64_t record_size{};    // bytes from one record to the next
  std::uint64_t records_at{};     // of the first record
  [[nodiscard]] const NcVariable* find(std::string_view name) const;
  [[nodiscard]] std::string text(std::string_view attribute) const;
};

// D006, D040, D042, D043. Sizes are checked against the file: the values of all fixed variables and of
// `records` records are there.
NcHeader read_netcdf_header(const Bytes& bytes);

// Value number `index` of `variable` in record `record` (0 for fixed variables).
[[nodiscard]] double netcdf_number(const Bytes& bytes, const NcHeader& header, const NcVariable& variable,
                                   std::uint64_t record, std::uint64_t index);
// All values of one record, times `scale`.
[[nodiscard]] std::vector<double> netcdf_reals(const Bytes& bytes, const NcHeader& header,
                                               const NcVariable& variable, std::uint64_t record,
                                               double scale);

} // namespace mote::data
