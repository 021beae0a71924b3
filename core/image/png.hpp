// SPDX-License-Identifier: MIT
// PNG out and in. Writing is our own arrangement of zlib, because a frame is encoded while the next
// one is drawn: rows are filtered and deflated in independent strips by several threads, and a
// 1280x720 picture takes a few milliseconds. Reading goes through libpng and takes every PNG there
// is. Values are display values as they are: nothing here converts colors. Row 0 is the top one.
//
// Pixels are straight RGBA, tight, 8 or 16 bits a channel. The file says "sRGB" (perceptual intent).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mote {

using PngText = std::vector<std::pair<std::string, std::string>>; // key (1..79 printable ASCII), UTF-8 value

struct PngOptions {
  PngText text{};     // provenance, written before the pixels
  bool keep_alpha{};  // also where every pixel is opaque; default: RGB then
  unsigned threads{}; // 0: as many as the machine has, at most 4
};

// The file's bytes, the same for the same pixels and options whatever `threads`. rgba holds
// width * height * 4 values. Failure(Failed) I008 for an empty picture or a side above 2^31 - 1.
std::vector<std::byte> encode_png(std::uint32_t width, std::uint32_t height,
                                  std::span<const std::uint8_t> rgba, const PngOptions& options = {});
std::vector<std::byte> encode_png(std::uint32_t width, std::uint32_t height,
                                  std::span<const std::uint16_t> rgba, const PngOptions& options = {});
// encode_png() to a file ("-": standard output), whole or not at all. I001..I003, I008.
void write_png(const std::string& path, std::uint32_t width, std::uint32_t height,
               std::span<const std::uint8_t> rgba, const PngOptions& options = {});
void write_png(const std::string& path, std::uint32_t width, std::uint32_t height,
               std::span<const std::uint16_t> rgba, const PngOptions& options = {});

struct PngPicture {
  std::uint32_t width{}, height{};
  bool has_alpha{};                    // the file has an alpha channel or transparent colors
  std::vector<std::uint8_t> rgba8{};   // files of 1..8 bits, palettes; gray fills r, g and b
  std::vector<std::uint16_t> rgba16{}; // files of 16 bits; exactly one of the two is filled
  PngText text{};
};
// Failure(BadInput) I004, I005.
PngPicture read_png(const std::string& path);

} // namespace mote
