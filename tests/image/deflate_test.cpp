// SPDX-License-Identifier: MIT
#include "core/image/deflate.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>
#include <string>

namespace {
using namespace mote;
using Data = std::vector<std::uint8_t>;

// zlib is the judge.
Data inflated(const std::vector<std::byte>& in, std::size_t size) {
  Data out(size + 64);
  z_stream z{};
  EXPECT_EQ(inflateInit2(&z, -15), Z_OK);
  z.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(in.data())); // NOLINT: zlib's interface
  z.avail_in = static_cast<uInt>(in.size());
  z.next_out = out.data();
  z.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflate(&z, Z_FINISH), Z_STREAM_END) << (z.msg ? z.msg : "");
  EXPECT_EQ(z.avail_in, 0u);
  out.resize(z.total_out);
  inflateEnd(&z);
  return out;
}

void expect_round_trip(const Data& data, const std::string& what) {
  std::vector<std::byte> whole;
  deflate_runs(data, true, whole);
  EXPECT_EQ(inflated(whole, data.size()), data) << what;
  std::vector<std::byte> parts; // as png_write.cpp joins strips
  const std::size_t cut = data.size() / 3;
  deflate_runs(std::span(data).first(cut), false, parts);
  deflate_runs(std::span(data).subspan(cut), true, parts);
  EXPECT_EQ(inflated(parts, data.size()), data) << what << ", in two parts";
}

TEST(Deflate, IsReadByZlib) {
  std::mt19937 random(3);
  for (const std::size_t size :
       {0u, 1u, 2u, 7u, 8u, 9u, 10u, 257u, 258u, 259u, 266u, 267u, 131071u, 131072u, 131073u, 300000u}) {
    expect_round_trip(Data(size, 0), "zeros " + std::to_string(size));
    Data data(size);
    for (auto& v : data) v = static_cast<std::uint8_t>(random());
    expect_round_trip(data, "noise " + std::to_string(size));
    for (std::size_t i = 0; i < size;) { // runs of every length
      const std::size_t run = random() % 300;
      const auto v = static_cast<std::uint8_t>(random() % 3);
      for (std::size_t k = 0; k < run && i < size; ++k) data[i++] = v;
    }
    expect_round_trip(data, "runs " + std::to_string(size));
  }
}

// Fibonacci counts make the deepest trees: beyond 15 bits the counts must be flattened.
TEST(Deflate, LimitsTheLengthOfCodes) {
  Data data;
  std::size_t a = 1, b = 1;
  for (std::uint8_t symbol = 0; symbol < 22; ++symbol) {
    for (std::size_t k = 0; k < a; ++k)
      data.push_back(static_cast<std::uint8_t>(symbol * 2 + k % 2 * 100)), data.push_back(symbol);
    const std::size_t next = a + b;
    a = b, b = next;
  }
  std::shuffle(data.begin(), data.end(), std::mt19937(1));
  data.resize(100000);
  expect_round_trip(data, "Fibonacci");
}

TEST(Deflate, ShrinksWhatPicturesHold) {
  std::vector<std::byte> out;
  deflate_runs(Data(1'000'000, 0), true, out);
  EXPECT_LT(out.size(), 10'000u);
  Data small(1'000'000);
  std::mt19937 random(1);
  for (auto& v : small) v = static_cast<std::uint8_t>(random() % 16);
  out.clear();
  deflate_runs(small, true, out);
  EXPECT_LT(out.size(), 510'000u);
}
} // namespace
