// SPDX-License-Identifier: MIT
// The decoders of packed blocks and base64, byte by byte.
#include "core/data/blocks.hpp"
#include "tests/data_fields/support.hpp"

#include <array>

namespace mote::data::testing {
namespace {

using namespace std::string_literals;

TEST(Lz4, LiteralsAndOverlappingMatch) {
  // token 0x1c: 1 literal 'a', match of 12 + 4 = 16 at distance 1; token 0x20: 2 literals "bc"
  const std::string packed = "\x1c"s + "a" + "\x01\x00"s + "\x20" + "bc";
  std::string out(19, '?');
  ASSERT_TRUE(unpack_lz4(packed, out));
  EXPECT_EQ(out, std::string(17, 'a') + "bc");
}

TEST(Lz4, LongLengthsUseFollowingBytes) {
  // 15 + 255 + 3 literals, then the end
  const std::string packed = "\xf0\xff\x03"s + std::string(273, 'x');
  std::string out(273, '?');
  ASSERT_TRUE(unpack_lz4(packed, out));
  EXPECT_EQ(out, std::string(273, 'x'));
}

TEST(Lz4, DamageIsSeen) {
  const std::string good = "\x1c"s + "a" + "\x01\x00"s + "\x20" + "bc";
  std::string out(19, '?');
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(unpack_lz4(good.substr(0, size), out)) << size;
  std::string far = good;
  far[2] = '\x02'; // before the begin
  EXPECT_FALSE(unpack_lz4(far, out));
  far[2] = '\x00';
  EXPECT_FALSE(unpack_lz4(far, out));
  std::string small(18, '?'), large(20, '?');
  EXPECT_FALSE(unpack_lz4(good, small));
  EXPECT_FALSE(unpack_lz4(good, large));
}

TEST(Base64, PiecesWithTheirOwnPadding) {
  Base64 in("Zm9v YmE=\nYg==");
  std::string out(6, '?');
  ASSERT_TRUE(in.read(out));
  EXPECT_EQ(out, "foobab");
}

TEST(Base64, EndAndForeignCharacters) {
  std::string out(3, '?');
  Base64 early("Zm9");
  EXPECT_FALSE(early.read(out));
  EXPECT_TRUE(early.at_end());
  Base64 foreign("Zm*v");
  EXPECT_FALSE(foreign.read(out));
  EXPECT_EQ(foreign.at(), 2u);
  Base64 padding("Z=9v");
  EXPECT_FALSE(padding.read(out));
}

} // namespace
} // namespace mote::data::testing
