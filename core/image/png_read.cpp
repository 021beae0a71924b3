// SPDX-License-Identifier: MIT
#include "core/base/diagnostic.hpp"
#include "core/image/png.hpp"
#include "core/image/read_file.hpp"

#include <fmt/format.h>
#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>

namespace mote {

namespace {
struct Input {
  std::vector<std::byte> bytes{};
  std::size_t at{};
  char error[200]{}; // no std::string: libpng leaves by longjmp
};

void read_bytes(png_structp png, png_bytep out, png_size_t size) {
  auto* input = static_cast<Input*>(png_get_io_ptr(png));
  if (size > input->bytes.size() - input->at) png_error(png, "the file ends too early");
  std::memcpy(out, input->bytes.data() + input->at, size);
  input->at += size;
}
[[noreturn]] void on_error(png_structp png, png_const_charp text) {
  auto* input = static_cast<Input*>(png_get_error_ptr(png));
  std::strncpy(input->error, text, sizeof input->error - 1);
  png_longjmp(png, 1);
}
void on_warning(png_structp, png_const_charp) {} // a readable picture is enough

// Everything that libpng may leave by longjmp: no object with a destructor is created in here.
bool read_all(png_structp png, png_infop info, Input& input, PngPicture& out) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, &input, read_bytes);
  png_set_user_limits(png, 1u << 20, 1u << 20);
  png_read_info(png, info);
  out.width = png_get_image_width(png, info);
  out.height = png_get_image_height(png, info);
  const int depth = png_get_bit_depth(png, info);
  out.has_alpha = (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0 ||
                  png_get_valid(png, info, PNG_INFO_tRNS) != 0;
  png_set_expand(png); // palettes, 1..4 bits, transparent colors
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER);
  if (depth == 16 && std::endian::native == std::endian::little) png_set_swap(png);
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const std::size_t values = std::size_t{out.width} * out.height * 4, row = std::size_t{out.width} * 4;
  // a lying header must not cost gigabytes: deflate cannot expand by more than about 1032
  if (values / 2500 > input.bytes.size() * 8)
    png_error(png, "the header promises more pixels than the file can hold");
  if (depth == 16)
    out.rgba16.resize(values);
  else
    out.rgba8.resize(values);
  for (int pass = 0; pass < passes; ++pass)
    for (std::size_t y = 0; y < out.height; ++y)
      png_read_row(png, depth == 16 ? reinterpret_cast<png_bytep>(&out.rgba16[y * row]) : &out.rgba8[y * row],
                   nullptr);
  png_read_end(png, info);
  return true;
}

void read_text(png_structp png, png_infop info, PngText& out) {
  png_textp text = nullptr;
  int count = 0;
  png_get_text(png, info, &text, &count);
  for (int i = 0; i < count; ++i) out.emplace_back(text[i].key, text[i].text ? text[i].text : "");
}
} // namespace

PngPicture read_png(const std::string& path) {
  Input input{.bytes = read_whole_file(path)};
  if (input.bytes.size() < 8 || png_sig_cmp(reinterpret_cast<png_const_bytep>(input.bytes.data()), 0, 8) != 0)
    fail(Exit::BadInput, "I005", {path}, "the file does not begin as a PNG does");
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) throw std::bad_alloc();
  PngPicture picture;
  const bool good = read_all(png, info, input, picture);
  if (good) read_text(png, info, picture.text);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!good) fail(Exit::BadInput, "I005", {path}, fmt::format("the PNG is broken: {}", input.error));
  return picture;
}

} // namespace mote
