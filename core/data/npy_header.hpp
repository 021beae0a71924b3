// SPDX-License-Identifier: MIT
// The header of a NumPy .npy file, versions 1 to 3: a Python dictionary with descr (element type),
// fortran_order and shape. Format: numpy.org/doc/stable/reference/generated/numpy.lib.format.html.
// Parses text only; what the array means is decided by the reader.
#pragma once

#include "core/data/bytes.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace mote::data {

// One number in an array element: kind f i u b (float, signed, unsigned, boolean), size in bytes.
struct NpyScalar {
  char kind{};
  std::uint32_t size{};
  bool big_endian{};
};

// A named part of a structured element; a plain array has one without name.
struct NpyField {
  std::string name{};
  NpyScalar scalar{};
  std::uint32_t components{1};
  std::uint64_t offset{}; // bytes from the begin of the element
};

struct NpyHeader {
  std::vector<NpyField> fields{};
  bool structured{};
  bool fortran_order{};
  std::vector<std::uint64_t> shape{};
  std::uint64_t item_size{};  // bytes of one element
  std::uint64_t data_begin{}; // byte offset of the first element
};

inline constexpr std::string_view npy_magic = "\x93NUMPY";

// D018 (malformed), D019 (element types other than the above).
NpyHeader parse_npy_header(const Bytes& bytes);

} // namespace mote::data
