// SPDX-License-Identifier: MIT
// Damaged input never crashes a reader: small files of every format are cut at every byte and changed
// in thousands of ways, always the same ones. What still reads must keep the promises of dataset.hpp.
#include "tests/data/files.hpp"
#include "tests/data/support.hpp"

#include <gtest/gtest.h>

#include <array>

namespace mote::data {
namespace {

struct Seed {
  const char* extension;
  std::string content;
  std::uint64_t frames;
};

std::string small_npy(std::string_view type, std::string_view shape, std::size_t data) {
  std::string header = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': {}, }}\n", type, shape);
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(header.size());
  out += '\0';
  return out + header + std::string(data, '\x40');
}

std::vector<Seed> seeds() {
  return {
      {"xyz", "3\nplain\nO 0.5 1 2\nH 3 4 5e-1\nH -6 7 8.25\n3\n\nO 0 1 2\nH 3 4 5\nH 6 7 8\n", 2},
      {"xyz",
       "2\nLattice=\"1 0 0 0 1 0 0 0 1\" pbc=\"T T F\" "
       "Properties=species:S:1:pos:R:3:id:I:1:orientation:R:4:on:L:1 note='a b'\n"
       "Na 1 2 3 1 0 0 0 1 T\nCl 4 5 6 2 1 0 0 0 F\n",
       1},
      {"dump", test::content_of(test::fixture("dump_xyz_with_xs_xu.dump")), 1},
      {"lammpstrj",
       "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp ff\n0 4 1\n0 4 0\n0 4 "
       "-1\n"
       "ITEM: ATOMS id type xs ys zs c_q[1] c_q[2] c_q[3] c_q[4]\n2 1 .5 .5 .5 1 0 0 0\n1 1 0 0 1 0 1 0 0\n"
       "ITEM: UNITS\nlj\nITEM: TIME\n0.5\nITEM: TIMESTEP\n10\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp "
       "pp ff\n0 4\n0 4\n0 4\nITEM: ATOMS x y z mark\n1 2 3 a\n",
       2},
      {"npy", small_npy("'<f4'", "(2, 4)", 32), 1},
      {"npy", small_npy("[('x', '<f4'), ('y', '<f8'), ('z', '<i2'), ('name', '<u8', (2,))]", "(2,)", 60), 1},
      {"csv", "# a table\nx (nm),y,z,\"na\"\"me\",radius\n1,2,3,\"a, b\",0.5\n\n4,5,NA,c,1\n", 1},
      {"txt", "1 2 3 0.5\n4 5 6 0.25\n7 8 9 1\n", 1},
      {"gz", test::content_of(test::fixture("tri_box_big.dump.gz")), 1},
  };
}

TEST(Damage, CutAtEveryByte) {
  for (const Seed& seed : seeds()) {
    std::uint64_t frames = 0;
    ASSERT_EQ(test::survives(seed.content, seed.extension, &frames), "");
    ASSERT_EQ(frames, seed.frames) << seed.content;
    for (std::size_t length = 0; length < seed.content.size(); ++length) {
      ASSERT_EQ(test::survives(seed.content.substr(0, length), seed.extension, &frames), "") << length << "\n"
                                                                                             << seed.content;
      ASSERT_LE(frames, seed.frames) << length << "\n" << seed.content;
    }
  }
}

class Mutator {
public:
  std::string change(std::string text) {
    for (std::uint64_t n = 1 + below(3); n > 0; --n) one(text);
    return text;
  }

private:
  std::uint64_t below(std::uint64_t limit) {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return (state_ >> 16) % limit;
  }
  void one(std::string& text) {
    static constexpr std::array<std::string_view, 24> words{"9223372036854775808",
                                                            "18446744073709551615",
                                                            "-1",
                                                            "nan",
                                                            "inf",
                                                            "\n",
                                                            "\r",
                                                            " ",
                                                            "1e999",
                                                            "'",
                                                            "\"",
                                                            "0",
                                                            ",",
                                                            ":",
                                                            "ITEM: ATOMS x y z\n",
                                                            "(",
                                                            "4294967296",
                                                            "Properties=",
                                                            "[",
                                                            "=",
                                                            "#",
                                                            "\t",
                                                            "id",
                                                            "x"};
    const std::uint64_t at = below(text.size() + 1);
    const std::uint64_t length = below(std::min<std::uint64_t>(text.size() - at, 24) + 1);
    switch (below(5)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(below(256));
      break;
    case 1: text.erase(at, length); break;
    case 2: text.insert(at, text.substr(below(text.size() + 1), 24)); break;
    case 3: text.insert(at, words[below(words.size())]); break;
    default: text.replace(at, length, words[below(words.size())]); break;
    }
  }
  std::uint64_t state_{88172645463325252u};
};

TEST(Damage, ThousandsOfChanges) {
  Mutator mutator;
  for (const Seed& seed : seeds())
    for (int i = 0; i < 3000; ++i) {
      const std::string text = mutator.change(seed.content);
      ASSERT_EQ(test::survives(text, seed.extension), "") << text;
    }
}

} // namespace
} // namespace mote::data
