// SPDX-License-Identifier: MIT
// Small binary trajectories made in memory, so that every byte of them can be chosen, cut and changed.
// Positions are position(frame, atom, axis), in the file's unit.
#pragma once

#include "core/data/binary.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mote::data::test {

// Multiples of 1/8 below 64: exact in every format, and not on XTC's grid of 1/1000 by accident.
inline double position(std::uint64_t frame, std::uint64_t atom, int axis) {
  return 0.125 * static_cast<double>((frame * 31 + atom * 7 + static_cast<std::uint64_t>(axis) * 3) % 500);
}

// Appends numbers in one byte order.
class Maker {
public:
  explicit Maker(Order order) : order_(order) {}
  template <class T> Maker& put(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    const T turned = load_number<T>(raw, order_);
    std::memcpy(raw, &turned, sizeof(T));
    bytes.append(raw, sizeof(T));
    return *this;
  }
  Maker& text(std::string_view words, std::size_t length = 0) {
    bytes.append(words);
    if (words.size() < length) bytes.append(length - words.size(), '\0');
    return *this;
  }
  std::string bytes{};

private:
  Order order_;
};

// Packed (atoms > 9) or plain; `long_size`: the form with the magic number 2023.
std::string make_xtc(std::uint64_t frames, std::uint64_t atoms, bool long_size = false);
// Frames `without` has bit k set for hold velocities only.
std::string make_trr(std::uint64_t frames, std::uint64_t atoms, bool doubles, std::uint64_t without = 0);
struct DcdKind {
  Order order{Order::Little};
  std::uint64_t width{4}; // of record lengths
  bool cell{true};
  std::vector<std::int32_t> free{}; // numbers of free atoms from 1; empty: all are free
};
std::string make_dcd(std::uint64_t frames, std::uint64_t atoms, const DcdKind& kind);
std::string make_gsd(std::uint64_t frames, std::uint64_t atoms, std::uint32_t version);
std::string make_netcdf(std::uint64_t frames, std::uint64_t atoms, std::uint8_t version);

} // namespace mote::data::test
