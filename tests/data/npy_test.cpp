// SPDX-License-Identifier: MIT
// NumPy arrays: versions, element types, orders, shapes and structures; then one fault at a time.
#include "tests/data/support.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>

namespace mote::data {
namespace {

using test::failure_of_text;
using test::read_text;
using testing::ElementsAre;
using testing::HasSubstr;

std::string npy(std::string header, std::string_view data, char version = 1) {
  header += '\n';
  std::string out = std::string("\x93NUMPY") + version + '\0';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i)
    out += static_cast<char>((header.size() >> (8 * i)) & 0xff);
  return out + header + std::string(data);
}
std::string header(std::string_view type, std::string_view shape, bool fortran = false) {
  return fmt::format("{{'descr': {}, 'fortran_order': {}, 'shape': {}, }}", type, fortran ? "True" : "False",
                     shape);
}
template <class T> std::string bytes_of(std::initializer_list<double> values, bool swap = false) {
  std::string out;
  for (const double value : values) {
    const T typed = static_cast<T>(value);
    std::string raw(sizeof(T), '\0');
    std::memcpy(raw.data(), &typed, sizeof(T));
    if (swap) std::reverse(raw.begin(), raw.end());
    out += raw;
  }
  return out;
}
const std::vector<double>& reals(const Frame& frame, std::string_view name) {
  return std::get<std::vector<double>>(frame.find(name)->values);
}

TEST(Npy, FourColumnsArePositionAndRadius) {
  const std::string data = bytes_of<float>({1, 2, 3, 0.5, 4, 5, 6, 0.25});
  const auto source = test::open_text(npy(header("'<f4'", "(2, 4)"), data));
  EXPECT_EQ(source->format(), "npy");
  const Frame frame = source->read(0);
  EXPECT_EQ(test::broken_promise(frame), "");
  EXPECT_THAT(reals(frame, "position"), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(reals(frame, "radius"), ElementsAre(0.5, 0.25));
}

TEST(Npy, EveryElementTypeVersionAndByteOrder) {
  const std::initializer_list<double> v{1, 2, 3};
  const std::pair<const char*, std::string> cases[] = {
      {"'<f8'", bytes_of<double>(v)},
      {"'>f8'", bytes_of<double>(v, true)},
      {"'<f4'", bytes_of<float>(v)},
      {"'>f4'", bytes_of<float>(v, true)},
      {"'<i8'", bytes_of<std::int64_t>(v)},
      {"'<i4'", bytes_of<std::int32_t>(v)},
      {"'>i2'", bytes_of<std::int16_t>(v, true)},
      {"'|i1'", bytes_of<std::int8_t>(v)},
      {"'<u8'", bytes_of<std::uint64_t>(v)},
      {"'>u4'", bytes_of<std::uint32_t>(v, true)},
      {"'<u2'", bytes_of<std::uint16_t>(v)},
      {"'|u1'", bytes_of<std::uint8_t>(v)},
      {"'<f2'", std::string("\x00\x3c\x00\x40\x00\x42", 6)},
  };
  for (const auto& [type, data] : cases)
    for (const char version : {'\1', '\2', '\3'})
      EXPECT_THAT(reals(read_text(npy(header(type, "(1L, 3)"), data, version)), "position"),
                  ElementsAre(1, 2, 3))
          << type;
}

TEST(Npy, FortranOrder) {
  const std::string data = bytes_of<double>({1, 4, 2, 5, 3, 6});
  EXPECT_THAT(reals(read_text(npy(header("'<f8'", "(2, 3)", true), data)), "position"),
              ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(Npy, ThreeDimensionsAreFrames) {
  const auto c = test::open_text(npy(header("'<f8'", "(2, 1, 3)"), bytes_of<double>({1, 2, 3, 4, 5, 6})));
  EXPECT_EQ(c->frame_count(), 2u);
  EXPECT_THAT(reals(c->read(1), "position"), ElementsAre(4, 5, 6));
  const auto fortran =
      test::open_text(npy(header("'<f8'", "(2, 1, 3)", true), bytes_of<double>({1, 4, 2, 5, 3, 6})));
  EXPECT_THAT(reals(fortran->read(1), "position"), ElementsAre(4, 5, 6));
  EXPECT_EQ(test::failure_of([&] { (void)c->read(2); }).code, "D017");
}

TEST(Npy, Structures) {
  const std::string type = "[('id', '<i4'), ('pos', '<f4', (3,)), ('', '|V4'), ('d', '<f4')]";
  const std::string data =
      bytes_of<std::int32_t>({7}) + bytes_of<float>({1, 2, 3}) + "pad!" + bytes_of<float>({5});
  const Frame frame = read_text(npy(header(type, "(1,)"), data));
  EXPECT_THAT(reals(frame, "position"), ElementsAre(1, 2, 3));
  EXPECT_EQ(frame.find("id")->type(), ColumnType::Int);
  EXPECT_EQ(frame.find("id")->number(0), 7);
  EXPECT_EQ(frame.find("radius")->number(0), 2.5);
  EXPECT_EQ(failure_of_text(npy(header("[('id', '<i4')]", "(1,)"), "1234")).code, "D013");
}

TEST(Npy, EmptyAndTrailing) {
  EXPECT_EQ(read_text(npy(header("'<f8'", "(0, 3)"), "")).count, 0u);
  const auto source = test::open_text(npy(header("'<f4'", "(1, 3)"), bytes_of<float>({1, 2, 3, 4})));
  EXPECT_TRUE(source->warnings().has("D023"));
}

TEST(Npy, CountsThatLie) {
  const Diagnostic d = failure_of_text(npy(header("'<f8'", "(9223372036854775808, 3)"), "12345678"));
  EXPECT_EQ(d.code, "D006");
  EXPECT_THAT(d.text, HasSubstr("'(9223372036854775808, 3)' needs more than 2^64 bytes, but 8 are there"));
  EXPECT_EQ(failure_of_text(npy(header("'<f8'", "(4, 3)"), bytes_of<double>({1, 2, 3}))).code, "D006");
  EXPECT_EQ(failure_of_text(npy(header("'<f8'", "(18446744073709551616, 3)"), "")).code, "D018");
}

TEST(Npy, Refusals) {
  const std::string data(96, '\0');
  EXPECT_EQ(failure_of_text(npy(header("'<f8'", "(12,)"), data)).code, "D020");
  EXPECT_EQ(failure_of_text(npy(header("'<f8'", "()"), data)).code, "D020");
  EXPECT_EQ(failure_of_text(npy(header("'<f8'", "(6, 2)"), data)).code, "D020");
  const Diagnostic turned = failure_of_text(npy(header("'<f4'", "(3, 8)"), data));
  EXPECT_EQ(turned.code, "D020");
  EXPECT_THAT(turned.hints[1], HasSubstr("transposed"));
  for (const char* type : {"'<c16'", "'|O'", "'<U8'", "'<f16'", "'<M8[s]'", "[('a', [('b', '<f4')])]"}) {
    const Diagnostic d = failure_of_text(npy(header(type, "(4, 3)"), data));
    EXPECT_EQ(d.code, "D019") << type;
    EXPECT_THAT(d.hints[0], HasSubstr("f2 f4 f8"));
  }
  EXPECT_EQ(failure_of_text(npy("{'descr': '<f8', 'shape': (4, 3)}", data)).code, "D018");
  EXPECT_EQ(failure_of_text(npy("{'descr': '<f8' 'shape': (4, 3)}", data)).code, "D018");
  EXPECT_EQ(failure_of_text(npy("{'order': 1}", data)).code, "D018");
  EXPECT_EQ(failure_of_text(npy(header("'<f8'", "(4, 3)"), data, 4)).code, "D018");
  const Diagnostic cut = failure_of_text(std::string("\x93NUMPY\x01\x00\xff\x00{'descr'", 18));
  EXPECT_EQ(cut.code, "D018");
  EXPECT_EQ(to_string(cut.loc), "input:@18");
}

} // namespace
} // namespace mote::data
