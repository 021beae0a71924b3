// SPDX-License-Identifier: MIT
#include "core/image/codes.hpp"
#include "core/image/png.hpp"
#include "tests/image/scratch.hpp"

#include <gmock/gmock.h>
#include <png.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <random>

namespace {
using namespace mote;
using mote::test::failure_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using PngTest = mote::test::Scratch;

std::vector<std::uint8_t> noise8(std::size_t pixels, bool opaque) {
  std::mt19937 random(7);
  std::vector<std::uint8_t> rgba(pixels * 4);
  for (std::size_t i = 0; i < rgba.size(); ++i)
    rgba[i] = opaque && i % 4 == 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(random());
  return rgba;
}

// A stand-in for a rendered frame: shaded discs on white.
std::vector<std::uint8_t> spheres(std::uint32_t width, std::uint32_t height) {
  std::vector<std::uint8_t> rgba(std::size_t{width} * height * 4, 255);
  std::mt19937 random(1);
  for (int n = 0; n < 4000; ++n) {
    const int cx = static_cast<int>(random() % width), cy = static_cast<int>(random() % height),
              r = 6 + static_cast<int>(random() % 14);
    const auto color = static_cast<unsigned>(random());
    for (int y = std::max(0, cy - r); y < std::min<int>(static_cast<int>(height), cy + r); ++y)
      for (int x = std::max(0, cx - r); x < std::min<int>(static_cast<int>(width), cx + r); ++x) {
        const double q = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / static_cast<double>(r * r);
        if (q >= 1) continue;
        for (unsigned k = 0; k < 3; ++k)
          rgba[(static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)) * 4 + k] =
              static_cast<std::uint8_t>(((color >> (8 * k)) & 255u) * std::sqrt(1 - q));
      }
  }
  return rgba;
}

TEST_F(PngTest, KeepsEveryValueOf8Bits) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 2u}, {257u, 63u}, {1u, 3000u}, {640u, 480u}})
    for (const bool opaque : {false, true}) {
      const auto rgba = noise8(std::size_t{width} * height, opaque);
      write_png(at("a.png"), width, height, rgba);
      const PngPicture back = read_png(at("a.png"));
      EXPECT_EQ(back.width, width);
      EXPECT_EQ(back.height, height);
      EXPECT_EQ(back.has_alpha, !opaque) << width;
      EXPECT_EQ(back.rgba8, rgba) << width;
      EXPECT_TRUE(back.rgba16.empty());
    }
}

TEST_F(PngTest, KeepsEveryValueOf16Bits) {
  std::vector<std::uint16_t> rgba(300 * 200 * 4);
  for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<std::uint16_t>(i * 40503u);
  for (const bool opaque : {false, true}) {
    if (opaque)
      for (std::size_t i = 3; i < rgba.size(); i += 4) rgba[i] = 65535;
    write_png(at("a.png"), 300, 200, rgba);
    const PngPicture back = read_png(at("a.png"));
    EXPECT_EQ(back.rgba16, rgba);
    EXPECT_EQ(back.has_alpha, !opaque);
    EXPECT_TRUE(back.rgba8.empty());
  }
  const std::vector<std::uint8_t> white(4, 255);
  write_png(at("b.png"), 1, 1, white, {.keep_alpha = true});
  EXPECT_TRUE(read_png(at("b.png")).has_alpha);
}

TEST_F(PngTest, CarriesTextAndTheSrgbMark) {
  const std::vector<std::uint8_t> pixel{1, 2, 3, 255};
  const PngText text{{"Software", "mote 0.1"}, {"Source", "W\xc3\xbcrfel\nframe 3"}, {"a bad\tkey", ""}};
  write_png(at("a.png"), 1, 1, pixel, {.text = text});
  EXPECT_THAT(read_png(at("a.png")).text, ElementsAre(Pair("Software", "mote 0.1"),
                                                      Pair("Source", text[1].second), Pair("a_bad_key", "")));
  const std::string bytes = content("a.png");
  const std::size_t srgb = bytes.find("sRGB");
  EXPECT_LT(srgb, bytes.find("IDAT"));
  EXPECT_EQ(bytes[srgb + 4], '\0');
}

// Readers forgive much; this one does not: every checksum, and the zlib stream over all IDAT chunks.
TEST_F(PngTest, IsStrictlyWellFormed) {
  const auto rgba = noise8(700 * 300, false); // several strips
  const auto file = encode_png(700, 300, rgba, {.text = {{"Software", "mote"}}});
  const auto* bytes = reinterpret_cast<const Bytef*>(file.data());
  auto word = [&](std::size_t at) {
    return bytes[at] << 24 | bytes[at + 1] << 16 | bytes[at + 2] << 8 | bytes[at + 3];
  };
  std::string order;
  std::vector<Bytef> stream;
  std::size_t at = 8;
  while (at < file.size()) {
    const auto length = static_cast<std::size_t>(word(at));
    ASSERT_LE(at + length + 12, file.size());
    EXPECT_EQ(static_cast<std::uint32_t>(word(at + 8 + length)), crc32_z(0, bytes + at + 4, length + 4));
    const std::string type(reinterpret_cast<const char*>(bytes + at + 4), 4);
    if (order.size() < 4 || order.substr(order.size() - 4) != type) order += type;
    if (type == "IDAT") stream.insert(stream.end(), bytes + at + 8, bytes + at + 8 + length);
    at += length + 12;
  }
  EXPECT_EQ(order, "IHDRsRGBtEXtIDATIEND");
  std::vector<Bytef> rows(300 * (700 * 4 + 1));
  uLongf size = rows.size();
  EXPECT_EQ(uncompress(rows.data(), &size, stream.data(), stream.size()), Z_OK);
  EXPECT_EQ(size, rows.size());
}

TEST_F(PngTest, DoesNotDependOnThreads) {
  const auto rgba = spheres(640, 400);
  const auto one = encode_png(640, 400, rgba, {.threads = 1});
  for (const unsigned threads : {2u, 3u, 64u})
    EXPECT_EQ(encode_png(640, 400, rgba, {.threads = threads}), one);
}

TEST_F(PngTest, ReadsGrayPalettesAndInterlacedFiles) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = image.height = 2;
  image.format = PNG_FORMAT_GRAY;
  const std::uint8_t gray[4] = {0, 100, 200, 255};
  ASSERT_NE(png_image_write_to_file(&image, at("gray.png").c_str(), 0, gray, 0, nullptr), 0);
  EXPECT_THAT(read_png(at("gray.png")).rgba8,
              ElementsAre(0, 0, 0, 255, 100, 100, 100, 255, 200, 200, 200, 255, 255, 255, 255, 255));
  image.format = PNG_FORMAT_RGBA_COLORMAP;
  image.colormap_entries = 2;
  const std::uint8_t map[8] = {10, 20, 30, 255, 40, 50, 60, 0}, indices[4] = {0, 1, 1, 0};
  ASSERT_NE(png_image_write_to_file(&image, at("map.png").c_str(), 0, indices, 0, map), 0);
  const PngPicture palette = read_png(at("map.png"));
  EXPECT_TRUE(palette.has_alpha);
  EXPECT_THAT(palette.rgba8, ElementsAre(10, 20, 30, 255, 40, 50, 60, 0, 40, 50, 60, 0, 10, 20, 30, 255));
}

TEST_F(PngTest, NamesWhatIsBroken) {
  write_png(at("a.png"), 64, 64, noise8(64 * 64, true));
  const std::string good = content("a.png");
  auto words = [&](const std::string& bytes) {
    put("b.png", bytes);
    const Diagnostic d = failure_of(Exit::BadInput, [&] { read_png(at("b.png")); });
    EXPECT_EQ(d.code, "I005");
    EXPECT_EQ(d.loc.file, at("b.png"));
    return d.text;
  };
  EXPECT_THAT(words("no picture"), HasSubstr("does not begin as a PNG"));
  EXPECT_THAT(words(""), HasSubstr("does not begin as a PNG"));
  for (const std::size_t n : {20ul, 60ul, good.size() / 2, good.size() - 20})
    EXPECT_THAT(words(good.substr(0, n)), HasSubstr("broken"));
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 1);
  EXPECT_THAT(words(flipped), HasSubstr("broken"));
  std::string huge = good; // 2^19 x 2^19 pixels, honest checksum aside
  huge[17] = 8, huge[21] = 8;
  words(huge);
  EXPECT_EQ(failure_of(Exit::BadInput, [&] { read_png(at("none.png")); }).code, "I004");
}

TEST_F(PngTest, RefusesImpossibleSizesAndFullDisks) {
  const std::vector<std::uint8_t> pixel(4);
  EXPECT_EQ(failure_of(Exit::Failed, [&] { write_png(at("a.png"), 0, 1, pixel); }).code, "I008");
  EXPECT_THAT(failure_of(Exit::Failed, [&] { write_png(at("a.png"), 2, 1, pixel); }).text,
              HasSubstr("2 x 1"));
  {
    const mote::test::FileSizeLimit limit(16); // a full disk
    EXPECT_EQ(failure_of(Exit::Failed, [&] { write_png(at("a"), 1, 1, pixel); }).code, "I002");
  }
  EXPECT_EQ(files(), 0u);
}

TEST(ImageCodes, AreInOrder) {
  for (std::size_t i = 1; i < image_codes.size(); ++i)
    EXPECT_LT(image_codes[i - 1].first, image_codes[i].first);
}
} // namespace
