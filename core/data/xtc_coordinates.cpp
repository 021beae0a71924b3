// SPDX-License-Identifier: MIT
#include "core/data/xtc_coordinates.hpp"

#include "core/data/binary.hpp"

#include <array>
#include <bit>

namespace mote::data {
namespace {

__extension__ using Wide = unsigned __int128; // three digits of 24 bits do not fit 64

// Sizes of the cubes for differences: entry i is about 2^(i/3), so that three digits of this radix
// take i bits. The values are part of the format.
constexpr std::array<std::uint32_t, 73> cube_sizes{
    0,       0,       0,       0,       0,        0,        0,       0,       0,       8,       10,
    12,      16,      20,      25,      32,       40,       50,      64,      80,      101,     128,
    161,     203,     256,     322,     406,      512,      645,     812,     1024,    1290,    1625,
    2048,    2580,    3250,    4096,    5060,     6501,     8192,    10321,   13003,   16384,   20642,
    26007,   32768,   41285,   52015,   65536,    82570,    104031,  131072,  165140,  208063,  262144,
    330280,  416127,  524287,  660561,  832255,   1048576,  1321122, 1664510, 2097152, 2642245, 3329021,
    4194304, 5284491, 6658042, 8388607, 10568983, 13316085, 16777216};
constexpr std::int32_t first_size = 9;

using Triple = std::array<std::int64_t, 3>;

// Bits from the most significant one of each byte on. Behind the end it gives zeros and remembers it.
class BitReader {
public:
  explicit BitReader(std::string_view bytes) : bytes_(bytes), bits_(bytes.size() * 8) {}
  [[nodiscard]] bool overrun() const { return at_ > bits_; }
  std::uint64_t bits(unsigned count) { // at most 56
    const std::uint64_t word = word_at(at_ >> 3);
    const unsigned shift = 64 - static_cast<unsigned>(at_ & 7) - count;
    at_ += count;
    return (word >> shift) & ((std::uint64_t{1} << count) - 1);
  }
  // A number whose bytes come the least significant first; the last one may have fewer than 8 bits.
  std::uint64_t little(unsigned count) { // at most 56
    const unsigned whole = count & ~7u, rest = count & 7u;
    std::uint64_t value = 0;
    if (whole) value = __builtin_bswap64(bits(whole) << (64 - whole));
    return rest ? value | (bits(rest) << whole) : value;
  }

private:
  [[nodiscard]] std::uint64_t word_at(std::uint64_t byte) const {
    if (byte + 8 <= bytes_.size()) return load_number<std::uint64_t>(bytes_.data() + byte, Order::Big);
    std::uint64_t word = 0;
    for (std::uint64_t i = 0; i < 8; ++i)
      word = (word << 8) | (byte + i < bytes_.size() ? static_cast<unsigned char>(bytes_[byte + i]) : 0u);
    return word;
  }
  std::string_view bytes_;
  std::uint64_t bits_, at_{};
};

// Three digits of mixed radix: v = (d0 * s1 + d1) * s2 + d2, in `count` bits.
class Digits {
public:
  Digits(std::uint32_t s0, std::uint32_t s1, std::uint32_t s2) : s1_(s1), s2_(s2) {
    const Wide product = Wide{s0} * s1 * s2;
    const auto high = static_cast<std::uint64_t>(product >> 64);
    count_ = high ? 64 + static_cast<unsigned>(std::bit_width(high))
                  : static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(product)));
  }
  Digits(std::uint32_t size, unsigned count) : s1_(size), s2_(size), count_(count) {}
  [[nodiscard]] Triple read(BitReader& in) const {
    if (count_ <= 56) return split(in.little(count_));
    const std::uint64_t low = in.little(48);
    return split(Wide{low} | (Wide{in.little(count_ - 48)} << 48));
  }

private:
  template <class Number> Triple split(Number value) const {
    const Number high = value / s2_;
    const auto d2 = static_cast<std::int64_t>(value - high * s2_);
    const Number first = high / s1_;
    return {static_cast<std::int64_t>(first), static_cast<std::int64_t>(high - first * s1_), d2};
  }
  std::uint32_t s1_, s2_;
  unsigned count_{};
};

class Unpacker {
public:
  Unpacker(const XtcPacking& packing, std::string_view packed, std::span<double> out)
      : packing_(packing), in_(packed), out_(out), unit_(1.0 / static_cast<double>(packing.precision)) {}

  std::string_view run() {
    for (int k = 0; k < 3; ++k) {
      const std::int64_t size = std::int64_t{packing_.largest[k]} - packing_.smallest[k] + 1;
      if (size < 1 || size > 0xffffffff) return "the largest coordinate is below the smallest one";
      sizes_[k] = static_cast<std::uint32_t>(size);
    }
    if (!set_index(packing_.small_index)) return "the index of the size of differences is outside its table";
    return unpack();
  }

private:
  bool set_index(std::int32_t index) {
    if (index < first_size || index >= static_cast<std::int32_t>(cube_sizes.size())) return false;
    index_ = index;
    return true;
  }

  std::string_view unpack() {
    const bool apart = (sizes_[0] | sizes_[1] | sizes_[2]) > 0xffffff; // too large to share a number
    const Digits large = apart ? Digits(1, 1, 1) : Digits(sizes_[0], sizes_[1], sizes_[2]);
    unsigned run_length = 0; // values (three per atom) of the run of differences; stays until changed
    while (written_ < out_.size()) {
      Triple first = apart ? three_apart() : large.read(in_);
      for (int k = 0; k < 3; ++k) first[k] += packing_.smallest[k];
      int change = 0;
      if (in_.bits(1)) {
        const auto word = static_cast<unsigned>(in_.bits(5));
        change = static_cast<int>(word % 3) - 1;
        run_length = word - word % 3;
      }
      if (in_.overrun()) return "the packed bits end early";
      if (run_length > out_.size() - written_ - 3) return "a run of differences goes behind the last atom";
      run_length ? unpack_run(first, run_length) : put(first);
      if (change && !set_index(index_ + change))
        return "the index of the size of differences leaves its table";
    }
    return in_.overrun() ? "the packed bits end early" : "";
  }

  // Differences to the atom before; the first two atoms of a run are swapped (H O H instead of O H H).
  void unpack_run(Triple before, unsigned run_length) {
    const std::uint32_t size = cube_sizes[static_cast<std::size_t>(index_)];
    const Digits small(size, static_cast<unsigned>(index_));
    const std::int64_t half = size / 2;
    for (unsigned k = 0; k < run_length; k += 3) {
      Triple next = small.read(in_);
      for (int c = 0; c < 3; ++c) next[c] += before[c] - half;
      put(next);
      if (k == 0) put(before);
      before = next;
    }
  }

  Triple three_apart() {
    Triple out{};
    for (int k = 0; k < 3; ++k)
      out[k] = static_cast<std::int64_t>(in_.bits(static_cast<unsigned>(std::bit_width(sizes_[k]))));
    return out;
  }

  void put(const Triple& at) {
    for (const std::int64_t value : at) out_[written_++] = static_cast<double>(value) * unit_;
  }

  const XtcPacking& packing_;
  BitReader in_;
  std::span<double> out_;
  double unit_;
  std::uint32_t sizes_[3]{};
  std::int32_t index_{};
  std::size_t written_{};
};

} // namespace

std::string_view unpack_xtc(const XtcPacking& packing, std::string_view packed, std::span<double> out) {
  return Unpacker(packing, packed, out).run();
}

} // namespace mote::data
