// SPDX-License-Identifier: MIT
#include "core/image/npy.hpp"
#include "tests/image/scratch.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace {
using namespace mote;
using mote::test::failure_of;
using testing::ElementsAre;
using testing::HasSubstr;
using NpyTest = mote::test::Scratch;

std::string npy(const std::string& header, const std::string& data) {
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(header.size());
  out += '\0';
  return out + header + data;
}

TEST_F(NpyTest, KeepsEveryBit) {
  const std::vector<float> depth{0.0f, -1.5f, std::numeric_limits<float>::infinity(), 1e-40f, 3.0f, 7.0f};
  const std::size_t shape[] = {2, 3};
  write_npy<float>(at("d.npy"), shape, depth);
  const NpyArray back = read_npy(at("d.npy"));
  EXPECT_EQ(back.type, "<f4");
  EXPECT_THAT(back.shape, ElementsAre(2u, 3u));
  EXPECT_EQ(back.size(), 6u);
  EXPECT_EQ(back.values<float>(), depth);
  EXPECT_TRUE(back.values<std::uint32_t>().empty());

  const std::vector<std::uint32_t> id{0xffffffffu, 0u, 5u};
  const std::size_t line[] = {3};
  write_npy<std::uint32_t>(at("i.npy"), line, id);
  EXPECT_EQ(read_npy(at("i.npy")).values<std::uint32_t>(), id);
  const std::vector<double> one{2.5};
  write_npy<double>(at("s.npy"), {}, one);
  EXPECT_TRUE(read_npy(at("s.npy")).shape.empty());
}

// The header that numpy.save itself writes, byte for byte.
TEST_F(NpyTest, WritesTheHeaderThatNumpyWrites) {
  const std::vector<std::uint32_t> id(6);
  const std::size_t shape[] = {2, 3}, line[] = {6};
  write_npy<std::uint32_t>(at("i.npy"), shape, id);
  std::string header = "{'descr': '<u4', 'fortran_order': False, 'shape': (2, 3), }";
  header.resize(117, ' ');
  EXPECT_EQ(content("i.npy").substr(0, 128), npy(header + "\n", ""));
  write_npy<std::uint32_t>(at("i.npy"), line, id);
  EXPECT_THAT(content("i.npy"), HasSubstr("'shape': (6, ), }"));
  EXPECT_EQ(content("i.npy").size() % 64, 24u);
}

TEST_F(NpyTest, ReadsOtherOrders) {
  put("f.npy", npy("{'descr': '|u1', 'fortran_order': True, 'shape': (2, 3)}", std::string("\1\4\2\5\3\6")));
  EXPECT_EQ(read_npy(at("f.npy")).values<std::uint8_t>(), (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
  put("b.npy", npy("{'descr': '>u2', 'fortran_order': False, 'shape': (2,)}", std::string("\1\2\3\4")));
  const NpyArray swapped = read_npy(at("b.npy"));
  EXPECT_EQ(swapped.type, "<u2");
  EXPECT_EQ(swapped.values<std::uint16_t>(), (std::vector<std::uint16_t>{0x0102, 0x0304}));
}

TEST_F(NpyTest, NamesWhatIsBroken) {
  auto words = [&](const std::string& bytes) {
    put("x.npy", bytes);
    const Diagnostic d = failure_of(Exit::BadInput, [&] { read_npy(at("x.npy")); });
    EXPECT_EQ(d.code, "I007");
    return d.text;
  };
  EXPECT_THAT(words("PK"), HasSubstr("does not begin as a NumPy array"));
  EXPECT_THAT(words(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (3,)}", "12345678")),
              HasSubstr("promises 12 bytes of values, 8 follow"));
  EXPECT_THAT(words(npy("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (1,)}", "1234")),
              HasSubstr("[('x', '<f4')]' is no plain number"));
  EXPECT_THAT(words(npy("{'descr': '|O', 'fortran_order': False, 'shape': (1,)}", "")),
              HasSubstr("no plain number"));
  EXPECT_THAT(words(npy("{'descr': '<f4', 'fortran_order': False}", "")), HasSubstr("no 'shape'"));
  EXPECT_THAT(words(npy("{'descr': '<f4', 'shape': (-3,)}", "")), HasSubstr("no list of lengths"));
  EXPECT_THAT(words(npy("{'descr': '<f4', 'shape': (9999999999, 9999999999, 9)}", "")),
              HasSubstr("too many"));
  EXPECT_THAT(words(std::string("\x93NUMPY\x09\x00\x10\x00xxxx", 14)), HasSubstr("version '9'"));
  EXPECT_THAT(words(std::string("\x93NUMPY\x01\x00\xff\x00xxxx", 14)), HasSubstr("ends within its header"));
  EXPECT_EQ(failure_of(Exit::BadInput, [&] { read_npy(at("none.npy")); }).code, "I004");
}

TEST_F(NpyTest, RefusesBytesThatDoNotFillTheShape) {
  const std::size_t shape[] = {2, 2};
  const std::vector<float> three(3);
  const Diagnostic d = failure_of(Exit::Failed, [&] { write_npy<float>(at("a.npy"), shape, three); });
  EXPECT_EQ(d.code, "I008");
  EXPECT_THAT(d.text, HasSubstr("12 bytes are no array of the type '<f4' and the shape (2, 2)"));
  EXPECT_EQ(files(), 0u);
}
} // namespace
