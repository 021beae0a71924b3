// SPDX-License-Identifier: MIT
// Numbers of binary formats: big- and little-endian, every access checked against the end of the file.
// Readers of xtc, trr, dcd, gsd and netcdf call it; XDR (RFC 4506) is the big-endian order with blocks
// of four bytes. BinaryTrajectory is the base of formats whose frames differ in length: it remembers
// where frames begin (8 bytes each), goes no further than asked, leaves a cut last frame out.
//
// Errors name the byte: D006 (the file ends within ...), D040 (structure), D043 (impossible count).
// Nothing here allocates by a number from the file before that number is checked against its size.
#pragma once

#include "core/data/bytes.hpp"
#include "core/data/source.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>

namespace mote::data {

enum class Order : std::uint8_t { Little, Big };

// A number of type T at `from`, wherever it is aligned.
template <class T> [[nodiscard]] T load_number(const char* from, Order order) {
  static_assert(std::is_arithmetic_v<T> && sizeof(T) <= 8);
  using Word =
      std::conditional_t<sizeof(T) == 8, std::uint64_t,
                         std::conditional_t<sizeof(T) == 4, std::uint32_t,
                                            std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;
  Word word{};
  std::memcpy(&word, from, sizeof word);
  if constexpr (sizeof(T) > 1)
    if ((order == Order::Big) != (std::endian::native == std::endian::big)) {
      if constexpr (sizeof(T) == 8)
        word = __builtin_bswap64(word);
      else if constexpr (sizeof(T) == 4)
        word = __builtin_bswap32(word);
      else
        word = __builtin_bswap16(word);
    }
  return std::bit_cast<T>(word);
}

// `out.size()` numbers of type T behind `from`, times `scale`, each `stride` values apart in `out`'s row.
template <class T> void load_reals(const char* from, Order order, std::span<double> out, double scale = 1.0) {
  for (double& value : out) {
    value = static_cast<double>(load_number<T>(from, order)) * scale;
    from += sizeof(T);
  }
}

// False when the product does not fit 64 bits.
[[nodiscard]] inline bool multiply(std::uint64_t a, std::uint64_t b, std::uint64_t& product) {
  return !__builtin_mul_overflow(a, b, &product);
}

// The integer that a number read as double is; the nearest possible one outside the range, 0 for NaN.
[[nodiscard]] inline std::int64_t whole_number(double value) {
  constexpr double limit = 9223372036854775808.0; // 2^63
  if (value >= limit) return INT64_MAX;
  return value > -limit ? static_cast<std::int64_t>(value) : value <= -limit ? INT64_MIN : 0;
}

// A place in the bytes that moves forward. `what` completes "the file ends within ...".
class ByteReader {
public:
  ByteReader(const Bytes& bytes, Order order, std::uint64_t at = 0)
      : bytes_(&bytes), order_(order), at_(at) {}
  [[nodiscard]] std::uint64_t at() const { return at_; }
  [[nodiscard]] std::uint64_t size() const { return bytes_->view().size(); }
  [[nodiscard]] std::uint64_t left() const { return at_ < size() ? size() - at_ : 0; }
  [[nodiscard]] Order order() const { return order_; }
  void seek(std::uint64_t at) { at_ = at; }
  void skip(std::uint64_t count, std::string_view what) { (void)take(count, what); }
  [[nodiscard]] std::string_view take(std::uint64_t count, std::string_view what) { // D006
    if (count > left() || at_ > size()) ends(count, what);
    const std::string_view taken = bytes_->view().substr(at_, count);
    at_ += count;
    return taken;
  }
  template <class T> [[nodiscard]] T number(std::string_view what) {
    return load_number<T>(take(sizeof(T), what).data(), order_);
  }
  // `count` reals of 4 or 8 bytes into `out`, which has that many places.
  void reals(std::uint64_t width, std::span<double> out, double scale, std::string_view what) {
    const char* from = take(width * out.size(), what).data();
    width == 8 ? load_reals<double>(from, order_, out, scale) : load_reals<float>(from, order_, out, scale);
  }
  [[noreturn]] void refuse(std::string_view code, std::string text,
                           std::vector<std::string> hints = {}) const;
  [[noreturn]] void refuse_at(std::uint64_t at, std::string_view code, std::string text,
                              std::vector<std::string> hints = {}) const;

private:
  [[noreturn]] void ends(std::uint64_t count, std::string_view what) const;
  const Bytes* bytes_;
  Order order_;
  std::uint64_t at_;
};

// A source that holds its bytes and knows how to refuse a frame that is not there (D017).
class BinarySource : public Source {
public:
  void release_pages() override { bytes_->release_pages(); }

protected:
  explicit BinarySource(std::shared_ptr<Bytes> bytes);
  [[nodiscard]] ByteReader reader(Order order, std::uint64_t at = 0) const { return {*bytes_, order, at}; }
  [[nodiscard]] const Bytes& bytes() const { return *bytes_; }
  [[noreturn]] void no_such_frame(std::uint64_t frame, std::uint64_t count) const;

private:
  std::shared_ptr<Bytes> bytes_;
};

class BinaryTrajectory : public BinarySource {
public:
  std::uint64_t frame_count() override;
  Frame read(std::uint64_t frame) override;

protected:
  BinaryTrajectory(std::shared_ptr<Bytes> bytes, Order order)
      : BinarySource(std::move(bytes)), order_(order) {}
  // Moves behind the frame that begins at `in` by its header alone; false = it holds no positions and is
  // left out of the series. D006 when the file ends within it, D040 or D043 when it is none.
  virtual bool skip_frame(ByteReader& in) const = 0;
  virtual Frame read_frame(ByteReader in) const = 0;

private:
  bool look_further();
  Order order_;
  std::vector<std::uint64_t> starts_{};
  std::uint64_t next_{};    // behind the last known frame
  std::uint64_t released_{}; // up to where pages were let go of while looking
  std::uint64_t skipped_{}; // frames left out
  bool complete_{};
};

} // namespace mote::data
