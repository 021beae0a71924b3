// SPDX-License-Identifier: MIT
// NumPy's .npy, version 1 to 3, C order: how AOVs and dumped textures leave the program. depth is
// float32 [H, W], id uint32 [H, W], normal float32 [H, W, 3]. Particle data in .npy files are read by
// core/data; this reader serves comparison and tests and gives the values as they are stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace mote {

// "<f4", "<u4", "|u1", ...: NumPy's name of a type on a little-endian machine.
template <class T> constexpr std::string_view npy_type() {
  if constexpr (std::is_same_v<T, float>)
    return "<f4";
  else if constexpr (std::is_same_v<T, double>)
    return "<f8";
  else if constexpr (std::is_same_v<T, std::uint8_t>)
    return "|u1";
  else if constexpr (std::is_same_v<T, std::uint16_t>)
    return "<u2";
  else if constexpr (std::is_same_v<T, std::uint32_t>)
    return "<u4";
  else if constexpr (std::is_same_v<T, std::uint64_t>)
    return "<u8";
  else if constexpr (std::is_same_v<T, std::int32_t>)
    return "<i4";
  else if constexpr (std::is_same_v<T, std::int64_t>)
    return "<i8";
}

// `type`: any NumPy name, e.g. "<f2" for half floats. Failure(Failed) I001..I003; I008 when the bytes
// do not fill the shape.
void write_npy(const std::string& path, std::string_view type, std::span<const std::size_t> shape,
               std::span<const std::byte> bytes);

template <class T>
void write_npy(const std::string& path, std::span<const std::size_t> shape, std::span<const T> values) {
  write_npy(path, npy_type<T>(), shape, std::as_bytes(values));
}

struct NpyArray {
  std::string type{}; // little-endian name, "<f4"
  std::vector<std::size_t> shape{};
  std::vector<std::byte> bytes{};         // C order, little-endian whatever the file had
  [[nodiscard]] std::size_t size() const; // number of values
  // Copies the values out; empty when the type is another one.
  template <class T> [[nodiscard]] std::vector<T> values() const {
    if (type != npy_type<T>()) return {};
    std::vector<T> out(bytes.size() / sizeof(T));
    std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
    return out;
  }
};
// Numbers and bools, either byte order, C or Fortran order. Failure(BadInput) I004, I007.
NpyArray read_npy(const std::string& path);

} // namespace mote
