// SPDX-License-Identifier: MIT
#include "core/scene/palette.hpp"

#include "core/scene/chunks.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

namespace mote {
namespace {

using testing::Each;
using testing::ElementsAre;

// `different` colors that are anything but neighbors, each several times, in no order.
std::vector<std::uint32_t> mixed_colors(std::uint32_t different, std::size_t count) {
  std::vector<std::uint32_t> out(count);
  for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<std::uint32_t>(i % different) * 2654435761u;
  std::shuffle(out.begin(), out.end(), std::mt19937(5));
  return out;
}

void expect_finds_all(const Palette& palette, std::span<const std::uint32_t> colors) {
  for (const std::uint32_t color : colors) ASSERT_EQ(palette.colors()[palette.index_of(color)], color);
}

TEST(Palette, HasTheColorsInAscendingOrder) {
  const std::vector<std::uint32_t> colors{0xFF0000FFu, 7u, 7u, 0u, 0xFFFFFFFFu, 0u, 0xFF0000FFu};
  const std::optional<Palette> palette = find_palette(colors);
  ASSERT_TRUE(palette);
  EXPECT_THAT(palette->colors(), ElementsAre(0u, 7u, 0xFF0000FFu, 0xFFFFFFFFu));
  expect_finds_all(*palette, colors);
}

TEST(Palette, OfNothingIsNone) { EXPECT_FALSE(find_palette({})); }

TEST(Palette, HoldsExactly256) {
  const std::vector<std::uint32_t> most = mixed_colors(256, 3000);
  const std::optional<Palette> palette = find_palette(most);
  ASSERT_TRUE(palette);
  EXPECT_EQ(palette->colors().size(), 256u);
  EXPECT_TRUE(std::is_sorted(palette->colors().begin(), palette->colors().end()));
  expect_finds_all(*palette, most);
  EXPECT_FALSE(find_palette(mixed_colors(257, 3000)));
}

// Colors whose places in the table are all the same: 0x9E3779B1 times its inverse modulo 2^32 times a small number.
TEST(Palette, ColorsThatCollideAreToldApart) {
  constexpr std::uint32_t factor = 0x9E3779B1u;
  std::uint32_t inverse = factor;
  for (int i = 0; i < 5; ++i) inverse *= 2u - factor * inverse; // Newton
  ASSERT_EQ(factor * inverse, 1u);
  std::vector<std::uint32_t> colors;
  for (std::uint32_t i = 0; i < 256; ++i) colors.push_back((0xFFC00000u + i) * inverse); // the last place: the search goes round
  const std::optional<Palette> palette = find_palette(colors);
  ASSERT_TRUE(palette);
  expect_finds_all(*palette, colors);
}

// Enough for several threads, each of which sees no more than 256.
TEST(Palette, OfManyDoesNotDependOnWhoSawThem) {
  const std::size_t count = 3'000'000;
  std::vector<std::uint32_t> colors(count);
  for (std::size_t i = 0; i < count; ++i) colors[i] = static_cast<std::uint32_t>(i * 256 / count) * 40503u;
  const std::optional<Palette> palette = find_palette(colors);
  ASSERT_TRUE(palette);
  EXPECT_EQ(palette->colors().size(), 256u);
  std::reverse(colors.begin(), colors.end());
  EXPECT_EQ(find_palette(colors)->colors(), palette->colors());
  colors.back() = 1u;
  EXPECT_FALSE(find_palette(colors)) << "one more, at the end";
}

ChunkSet spheres_of(const std::vector<std::uint32_t>& colors) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-5, 5);
  std::vector<glm::dvec3> centers;
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i < colors.size(); ++i) {
    const double x = u(random), y = u(random), z = u(random);
    centers.emplace_back(x, y, z);
    rows.push_back(i);
  }
  return build_spheres(centers, std::vector<double>(colors.size(), 0.1), rows, colors);
}

void expect_colors(const ChunkSet& set, const std::vector<std::uint32_t>& colors) {
  std::size_t used = 0;
  for (std::uint64_t i = 0; i < set.record_count(); ++i) {
    if (set.rows[i] == no_row) continue;
    ++used;
    ASSERT_EQ(set.color_of(i), colors[set.rows[i]]);
  }
  EXPECT_EQ(used, colors.size());
}

TEST(PalettedChunks, FewColorsTakeAByteARecord) {
  for (const std::uint32_t different : {1u, 8u, 256u}) {
    const std::vector<std::uint32_t> colors = mixed_colors(different, 5000);
    const ChunkSet set = spheres_of(colors);
    EXPECT_TRUE(set.paletted());
    EXPECT_EQ(set.colors.size(), different);
    EXPECT_EQ(set.color_indices.size(), set.record_count());
    EXPECT_THAT(set.color_indices, Each(testing::Lt(different)));
    expect_colors(set, colors);
  }
}

TEST(PalettedChunks, ManyColorsTakeAWordARecord) {
  const std::vector<std::uint32_t> colors = mixed_colors(257, 5000);
  const ChunkSet set = spheres_of(colors);
  EXPECT_FALSE(set.paletted());
  EXPECT_TRUE(set.color_indices.empty());
  EXPECT_EQ(set.colors.size(), set.record_count());
  expect_colors(set, colors);
}

TEST(PalettedChunks, AlphaIsTheColors) {
  const ChunkSet few = spheres_of(std::vector<std::uint32_t>(100, 0x33FFFFFFu));
  ASSERT_TRUE(few.paletted());
  EXPECT_DOUBLE_EQ(few.alpha_of(0), 0.2);
  std::vector<std::uint32_t> colors(300);
  for (std::uint32_t i = 0; i < colors.size(); ++i) colors[i] = 0xFF000000u | i;
  const ChunkSet many = spheres_of(colors);
  ASSERT_FALSE(many.paletted());
  EXPECT_DOUBLE_EQ(many.alpha_of(0), 1.0);
  EXPECT_DOUBLE_EQ(build_spheres(std::vector{glm::dvec3(0)}, std::vector{1.0}, std::vector{0u}, {}).alpha_of(0), 1.0) << "the batch's counts";
}

} // namespace
} // namespace mote
