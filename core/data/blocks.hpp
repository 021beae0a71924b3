// SPDX-License-Identifier: MIT
// Decoders of packed blocks whose unpacked size is known beforehand (VTK arrays, zip entries). Each fills
// `out` exactly or answers false: nothing is written outside, whatever the bytes are.
#pragma once

#include <span>
#include <string_view>

namespace mote::data {

[[nodiscard]] bool unpack_zlib(std::string_view packed, std::span<char> out);    // RFC 1950
[[nodiscard]] bool unpack_deflate(std::string_view packed, std::span<char> out); // RFC 1951
[[nodiscard]] bool unpack_lz4(std::string_view packed, std::span<char> out);     // one LZ4 block
[[nodiscard]] bool unpack_lzma(std::string_view packed, std::span<char> out);    // one .xz stream

// Base64 (RFC 4648) out of a text with white space in it; several encoded pieces, each with its own
// padding, may follow each other.
class Base64 {
public:
  explicit Base64(std::string_view text) : text_(text) {}
  // Fills `out`; false when the text ends before or holds another character. `at()` is then the place.
  [[nodiscard]] bool read(std::span<char> out);
  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }

private:
  bool next_group();
  std::string_view text_;
  std::size_t at_{};
  unsigned char group_[3]{};
  std::size_t held_{}, used_{};
};

} // namespace mote::data
