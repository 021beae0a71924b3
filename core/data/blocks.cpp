// SPDX-License-Identifier: MIT
#include "core/data/blocks.hpp"

#include <lzma.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace mote::data {
namespace {

// `window`: 15 = zlib, -15 = deflate without header.
bool inflate_into(std::string_view packed, std::span<char> out, int window) {
  z_stream z{};
  if (inflateInit2(&z, window) != Z_OK) return false;
  std::size_t used = 0, made = 0;
  int state = Z_OK;
  char spare = 0; // zlib wants a place to write to even when nothing comes
  while (state == Z_OK) {
    const std::size_t in = std::min<std::size_t>(packed.size() - used, 1u << 30);
    const std::size_t room = std::min<std::size_t>(out.size() - made, 1u << 30);
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + used));
    z.avail_in = static_cast<uInt>(in);
    z.next_out = reinterpret_cast<Bytef*>(room ? out.data() + made : &spare);
    z.avail_out = static_cast<uInt>(room ? room : 1);
    state = ::inflate(&z, Z_NO_FLUSH);
    if (!room && z.avail_out == 0) state = Z_DATA_ERROR; // more than there should be
    used += in - z.avail_in;
    if (room) made += room - z.avail_out;
  }
  inflateEnd(&z);
  return state == Z_STREAM_END && made == out.size();
}

int value_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

// The lengths of LZ4: 15 means that bytes follow, each adding to it, as long as they are 255.
bool lz4_length(std::string_view packed, std::size_t& at, std::size_t& length) {
  if (length != 15) return true;
  for (;;) {
    if (at >= packed.size()) return false;
    const auto more = static_cast<unsigned char>(packed[at++]);
    length += more;
    if (more != 255) return true;
  }
}

} // namespace

bool unpack_zlib(std::string_view packed, std::span<char> out) { return inflate_into(packed, out, 15); }
bool unpack_deflate(std::string_view packed, std::span<char> out) { return inflate_into(packed, out, -15); }

// lz4/doc/lz4_Block_format.md: token, literals, two-byte offset, match; the last sequence ends behind its
// literals.
bool unpack_lz4(std::string_view packed, std::span<char> out) {
  std::size_t at = 0, made = 0;
  while (at < packed.size()) {
    const auto token = static_cast<unsigned char>(packed[at++]);
    std::size_t literals = token >> 4, match = token & 15;
    if (!lz4_length(packed, at, literals)) return false;
    if (literals > packed.size() - at || literals > out.size() - made) return false;
    std::copy_n(packed.begin() + static_cast<std::ptrdiff_t>(at), literals,
                out.begin() + static_cast<std::ptrdiff_t>(made));
    at += literals;
    made += literals;
    if (at == packed.size()) return made == out.size();
    if (packed.size() - at < 2) return false;
    const std::size_t offset = static_cast<unsigned char>(packed[at]) |
                               static_cast<std::size_t>(static_cast<unsigned char>(packed[at + 1])) << 8;
    at += 2;
    if (!lz4_length(packed, at, match)) return false;
    match += 4;
    if (offset == 0 || offset > made || match > out.size() - made) return false;
    for (; match > 0; --match, ++made) out[made] = out[made - offset];
  }
  return false;
}

bool unpack_lzma(std::string_view packed, std::span<char> out) {
  std::uint64_t memory = std::uint64_t{1} << 30;
  std::size_t used = 0, made = 0;
  const lzma_ret state = lzma_stream_buffer_decode(
      &memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(packed.data()), &used, packed.size(),
      reinterpret_cast<std::uint8_t*>(out.data()), &made, out.size());
  return state == LZMA_OK && made == out.size();
}

bool Base64::next_group() {
  std::uint32_t bits = 0;
  int digits = 0, padding = 0;
  while (digits + padding < 4) {
    while (at_ < text_.size() && (text_[at_] == ' ' || (text_[at_] >= '\t' && text_[at_] <= '\r'))) ++at_;
    if (at_ >= text_.size()) return false;
    const char c = text_[at_];
    const int value = value_of(c);
    if (c == '=' && digits >= 2) {
      ++padding;
    } else if (value < 0 || padding > 0) {
      return false;
    } else {
      bits = bits << 6 | static_cast<std::uint32_t>(value);
      ++digits;
    }
    ++at_;
  }
  bits <<= 6 * padding;
  group_[0] = static_cast<unsigned char>(bits >> 16);
  group_[1] = static_cast<unsigned char>(bits >> 8);
  group_[2] = static_cast<unsigned char>(bits);
  held_ = static_cast<std::size_t>(3 - padding);
  used_ = 0;
  return true;
}

bool Base64::read(std::span<char> out) {
  for (char& to : out) {
    if (used_ == held_ && !next_group()) return false;
    to = static_cast<char>(group_[used_++]);
  }
  return true;
}

} // namespace mote::data
