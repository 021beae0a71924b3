// SPDX-License-Identifier: MIT
// The compressed coordinates of GROMACS' XTC files ("3dfcoord"): whole numbers in units of
// 1/precision, packed as digits of mixed radix, water molecules as short differences to their first
// atom. reader_xtc.cpp calls it. It knows no frames and no units.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace mote::data {

// What stands before the packed bits of a frame.
struct XtcPacking {
  float precision{};          // 1 / unit of the whole numbers
  std::int32_t smallest[3]{}; // bounding box of the whole numbers
  std::int32_t largest[3]{};
  std::int32_t small_index{}; // into the table of sizes for differences
};

// Unpacks out.size() / 3 positions x y z in the file's unit (nm). Nothing is read outside `packed`.
// Returns an empty text, or what is wrong.
[[nodiscard]] std::string_view unpack_xtc(const XtcPacking& packing, std::string_view packed,
                                          std::span<double> out);

} // namespace mote::data
