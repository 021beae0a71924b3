// SPDX-License-Identifier: MIT
// PNG (W3C, third edition) chunks around a zlib stream (RFC 1950) that is put together from strips:
// each strip of rows is deflated by itself and becomes one IDAT chunk, its checksum included, on
// whatever thread is free; the Adler sums combine into a last, tiny IDAT.
#include "core/base/atomic_file.hpp"
#include "core/base/diagnostic.hpp"
#include "core/image/deflate.hpp"
#include "core/image/png.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <thread>

namespace mote {

namespace {
using Bytes = std::vector<std::byte>;
constexpr std::uint32_t strip_bytes = 1u
                                      << 18; // filtered bytes a strip; fixed, so that threads do not matter

void put32(Bytes& out, std::uint32_t v) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>(v >> shift));
}

void put_chunk(Bytes& out, std::string_view type, std::span<const std::byte> data) {
  put32(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = out.size();
  for (const char c : type) out.push_back(static_cast<std::byte>(c));
  out.insert(out.end(), data.begin(), data.end());
  const uLong crc = crc32_z(0, reinterpret_cast<const Bytef*>(&out[start]), out.size() - start);
  put32(out, static_cast<std::uint32_t>(crc));
}

void put_text(Bytes& out, const std::string& key, const std::string& value) {
  std::string data;
  for (const char c : std::string_view(key).substr(0, 79)) data += c > ' ' && c < 127 ? c : '_';
  if (data.empty()) data += '_';
  const bool ascii =
      std::all_of(value.begin(), value.end(), [](char c) { return (c >= ' ' && c < 127) || c == '\n'; });
  // tEXt is Latin-1; iTXt: no compression, no language, no translated key, UTF-8
  data += ascii ? std::string(1, '\0') : std::string(5, '\0');
  for (const char c : value)
    if (c != '\0') data += c;
  put_chunk(out, ascii ? "tEXt" : "iTXt", std::as_bytes(std::span(data)));
}

// One row as the file has it: channels dropped, 16 bits in network order. May write three bytes more.
template <class T>
void pack_row(const T* rgba, std::uint32_t width, std::uint32_t channels, std::uint8_t* out) {
  if constexpr (sizeof(T) == 1) {
    for (std::uint32_t x = 0; x < width; ++x)
      std::memcpy(out + std::size_t{x} * channels, rgba + std::size_t{x} * 4, 4);
  } else {
    for (std::uint32_t x = 0; x < width; ++x)
      for (std::uint32_t k = 0; k < channels; ++k) {
        const T v = rgba[std::size_t{x} * 4 + k];
        *out++ = static_cast<std::uint8_t>(v >> 8);
        *out++ = static_cast<std::uint8_t>(v);
      }
  }
}

template <class T> struct Encoder {
  std::uint32_t width, height, channels;
  const T* rgba;
  std::size_t row_bytes{std::size_t{width} * channels * sizeof(T)};
  std::uint32_t strip_rows{
      std::max<std::uint32_t>(1, static_cast<std::uint32_t>(strip_bytes / (row_bytes + 1)))};
  std::uint32_t strips{(height - 1) / strip_rows + 1};

  struct Strip {
    Bytes chunk{};
    uLong adler{};
    std::size_t size{};
  };

  const T* row(std::uint32_t y) const { return rgba + std::size_t{y} * width * 4; }

  // Rows as differences to the row above (filter 2), which rendered pictures like: background and
  // smooth shading become runs of zeros and small numbers. Above the top row is a row of zeros.
  std::vector<std::uint8_t> filtered(std::uint32_t first, std::uint32_t last) const {
    std::vector<std::uint8_t> out((last - first) * (row_bytes + 1)), above(row_bytes + 4),
        current(row_bytes + 4);
    if (first > 0) pack_row(row(first - 1), width, channels, above.data());
    for (std::uint32_t y = first; y < last; ++y) {
      pack_row(row(y), width, channels, current.data());
      std::uint8_t* line = &out[(y - first) * (row_bytes + 1)];
      *line++ = 2;
      for (std::size_t i = 0; i < row_bytes; ++i) line[i] = static_cast<std::uint8_t>(current[i] - above[i]);
      current.swap(above);
    }
    return out;
  }

  Strip deflate_strip(std::uint32_t index) const {
    const std::uint32_t first = index * strip_rows, last = std::min(height, first + strip_rows);
    const std::vector<std::uint8_t> raw = filtered(first, last);
    Strip strip{.adler = adler32_z(1, raw.data(), raw.size()), .size = raw.size()};
    Bytes data;
    if (index == 0) data = {std::byte{0x78}, std::byte{0x01}}; // zlib: deflate, 32 kB window, fastest
    deflate_runs(raw, index + 1 == strips, data);
    put_chunk(strip.chunk, "IDAT", data);
    return strip;
  }

  std::vector<Strip> deflate_all(unsigned threads) const {
    std::vector<Strip> out(strips);
    auto work = [&](unsigned start) {
      for (std::uint32_t i = start; i < strips; i += threads) out[i] = deflate_strip(i);
    };
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < threads; ++i) others.emplace_back(work, i);
    work(0);
    others.clear(); // joins
    return out;
  }
};

template <class T>
Bytes encode(std::uint32_t width, std::uint32_t height, std::span<const T> rgba, const PngOptions& options) {
  if (width == 0 || height == 0 || width > 0x7fffffffu / 8 || height > 0x7fffffffu ||
      rgba.size() != std::size_t{width} * height * 4)
    fail(Exit::Failed, "I008", {},
         fmt::format("a picture of {} x {} pixels cannot be stored as PNG", width, height));
  bool opaque = !options.keep_alpha;
  constexpr T full = static_cast<T>(~T{0});
  if (opaque) {
    T all = full;
    for (std::size_t i = 3; i < rgba.size(); i += 4) all = static_cast<T>(all & rgba[i]);
    opaque = all == full;
  }
  const Encoder<T> encoder{width, height, opaque ? 3u : 4u, rgba.data()};
  unsigned threads =
      options.threads != 0 ? options.threads : std::min(4u, std::thread::hardware_concurrency());
  threads = std::clamp(threads, 1u, encoder.strips);
  const auto strips = encoder.deflate_all(threads);

  Bytes out, data;
  for (const int b : {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a})
    out.push_back(static_cast<std::byte>(b));
  put32(data, width);
  put32(data, height);
  for (const std::size_t b : {sizeof(T) * 8, opaque ? std::size_t{2} : std::size_t{6}, std::size_t{0},
                              std::size_t{0}, std::size_t{0}})
    data.push_back(static_cast<std::byte>(b));
  put_chunk(out, "IHDR", data);
  put_chunk(out, "sRGB", std::array{std::byte{0}});
  for (const auto& [key, value] : options.text) put_text(out, key, value);
  uLong adler = 1;
  for (const auto& strip : strips) {
    adler = adler32_combine(adler, strip.adler, static_cast<z_off_t>(strip.size));
    out.insert(out.end(), strip.chunk.begin(), strip.chunk.end());
  }
  data.clear();
  put32(data, static_cast<std::uint32_t>(adler));
  put_chunk(out, "IDAT", data);
  put_chunk(out, "IEND", {});
  return out;
}
} // namespace

std::vector<std::byte> encode_png(std::uint32_t width, std::uint32_t height,
                                  std::span<const std::uint8_t> rgba, const PngOptions& options) {
  return encode(width, height, rgba, options);
}
std::vector<std::byte> encode_png(std::uint32_t width, std::uint32_t height,
                                  std::span<const std::uint16_t> rgba, const PngOptions& options) {
  return encode(width, height, rgba, options);
}
void write_png(const std::string& path, std::uint32_t width, std::uint32_t height,
               std::span<const std::uint8_t> rgba, const PngOptions& options) {
  write_file(path, encode_png(width, height, rgba, options));
}
void write_png(const std::string& path, std::uint32_t width, std::uint32_t height,
               std::span<const std::uint16_t> rgba, const PngOptions& options) {
  write_file(path, encode_png(width, height, rgba, options));
}

} // namespace mote
