// SPDX-License-Identifier: MIT
// Every reader's files packed with gzip, xz and zstd: the same particles; cut at every byte: refused, whatever is inside.
#include "core/data/source.hpp"
#include "tests/data/support.hpp"
#include "tests/fuzz/inputs.hpp"

#include <gtest/gtest.h>
#include <lzma.h>
#include <zlib.h>
#include <zstd.h>

namespace mote::fuzz {
namespace {

using data::test::failure_of;
using data::test::open_text;

std::string gzip(std::string_view content) {
  z_stream z{};
  EXPECT_EQ(deflateInit2(&z, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string out(deflateBound(&z, content.size()) + 64, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  z.avail_in = static_cast<uInt>(content.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&z, Z_FINISH), Z_STREAM_END);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}
std::string xz(std::string_view content) {
  std::string out(lzma_stream_buffer_bound(content.size()), '\0');
  std::size_t used = 0;
  EXPECT_EQ(lzma_easy_buffer_encode(1, LZMA_CHECK_CRC32, nullptr, reinterpret_cast<const std::uint8_t*>(content.data()), content.size(),
                                    reinterpret_cast<std::uint8_t*>(out.data()), &used, out.size()),
            LZMA_OK);
  out.resize(used);
  return out;
}
std::string zst(std::string_view content) {
  std::string out(ZSTD_compressBound(content.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), content.data(), content.size(), 3));
  return out;
}
struct Packing {
  const char* name;
  std::string (*pack)(std::string_view);
};
constexpr Packing packings[]{{"gzip", gzip}, {"xz", xz}, {"zstd", zst}};

class Packed : public testing::TestWithParam<std::string> {
protected:
  // Files of the format that can be read and are not packed themselves.
  static std::vector<Input> plain() {
    static const auto inputs = inputs_by_format(12000);
    std::vector<Input> out;
    for (const Input& input : inputs.at(GetParam())) {
      const auto bytes = data::Bytes::from_memory("input", input.content);
      if (!bytes->compressed() && failure_of([&] { (void)open_text(input.content, input.extension)->read(0); }).code == "none") out.push_back(input);
    }
    return out;
  }
};

TEST_P(Packed, TheSameParticles) {
  for (const Input& input : plain()) {
    const data::Frame wanted = open_text(input.content, input.extension)->read(0);
    for (const Packing& packing : packings) {
      const auto source = open_text(packing.pack(input.content), input.extension);
      EXPECT_EQ(source->format(), GetParam()) << packing.name << " of " << input.name;
      const data::Frame frame = source->read(0);
      ASSERT_EQ(frame.count, wanted.count) << packing.name << " of " << input.name;
      ASSERT_EQ(frame.columns.size(), wanted.columns.size());
      const auto &mine = std::get<std::vector<double>>(frame.find("position")->values), &theirs = std::get<std::vector<double>>(wanted.find("position")->values);
      EXPECT_EQ(std::memcmp(mine.data(), theirs.data(), mine.size() * sizeof(double)), 0) << packing.name << " of " << input.name;
    }
  }
}

TEST_P(Packed, CutAtEveryByteIsRefused) {
  const std::vector<Input> inputs = plain();
  const auto smallest = std::min_element(inputs.begin(), inputs.end(), [](const Input& a, const Input& b) { return a.content.size() < b.content.size(); });
  ASSERT_NE(smallest, inputs.end());
  for (const Packing& packing : packings) {
    const std::string packed = packing.pack(smallest->content);
    for (std::size_t length = 0; length < packed.size(); ++length) {
      const Diagnostic d = failure_of([&] { (void)open_text(packed.substr(0, length), smallest->extension)->read(0); });
      ASSERT_NE(d.code, "none") << packing.name << " of " << smallest->name << " cut at " << length << " of " << packed.size();
      ASSERT_FALSE(d.text.empty());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, Packed, testing::ValuesIn(reader_names()), [](const auto& tested) { return word_of(tested.param); });

} // namespace
} // namespace mote::fuzz
