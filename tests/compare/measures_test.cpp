// SPDX-License-Identifier: MIT
// Each measure: a picture against itself, then one thing broken.
#include "core/base/diagnostic.hpp"
#include "core/compare/compare.hpp"
#include "pictures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mote::compare {
namespace {

using namespace mote::test;
using ::testing::HasSubstr;

constexpr double infinity = std::numeric_limits<double>::infinity();

Failure failure_of(const CompareInput& a, const CompareInput& b) {
  try {
    (void)compare(a, b);
  } catch (const Failure& failure) {
    return failure;
  }
  ADD_FAILURE() << "nothing failed";
  return {Exit::Done, {}};
}

TEST(Compare, APictureEqualsItself) {
  const CompareInput p = made_up();
  const CompareResult r = compare(p, p);
  EXPECT_EQ(r.pixels, all_pixels);
  EXPECT_EQ(r.ambiguous, 0u);
  ASSERT_TRUE(r.id && r.depth && r.normal && r.color && r.outline);
  EXPECT_EQ(r.id->compared, all_pixels);
  EXPECT_EQ(r.id->all(), 0u);
  EXPECT_EQ(r.depth->compared, particles);
  EXPECT_EQ(r.depth->relative.max, 0.0);
  EXPECT_EQ(r.depth->ulp.max, 0.0);
  EXPECT_EQ(r.normal->compared, particles);
  EXPECT_EQ(r.normal->angle.max, 0.0);
  EXPECT_FALSE(r.normal->beyond_bar);
  EXPECT_EQ(r.color->compared, all_pixels);
  EXPECT_EQ(r.color->rms, 0.0);
  EXPECT_EQ(r.color->de_max, 0.0);
  EXPECT_EQ(r.outline->displacement, 0.0);
}

TEST(Compare, WrongExtraAndMissingIds) {
  const CompareInput b = made_up();
  CompareInput a = b;
  a.id[on_seven] = 9;
  a.id[on_nine] = no_id;
  a.id[on_nine + 1] = no_id;
  a.id[on_nothing] = 3;
  const CompareResult r = compare(a, b);
  EXPECT_EQ(r.id->wrong, 1u);
  EXPECT_EQ(r.id->missing, 2u);
  EXPECT_EQ(r.id->extra, 1u);
  EXPECT_EQ(r.id->coverage(), 3u);
  EXPECT_EQ(r.id->all(), 4u);
  EXPECT_EQ(r.depth->compared, particles - 3) << "depths only where both show the same particle";
}

TEST(Compare, AmbiguousPixelsDoNotCount) {
  const CompareInput b = made_up();
  CompareInput a = b;
  a.id[on_seven] = 9;
  a.depth[on_seven] = 1.0;
  a.normal[on_seven] = {1, 0, 0};
  a.color[on_seven] = {1, 0, 0, 1};
  CompareInput marked = b;
  marked.ambiguous.assign(all_pixels, 0);
  marked.ambiguous[on_seven] = 1;
  const CompareResult r = compare(a, marked);
  EXPECT_EQ(r.ambiguous, 1u);
  EXPECT_EQ(r.id->compared, all_pixels - 1);
  EXPECT_EQ(r.id->all(), 0u);
  EXPECT_EQ(r.depth->compared, particles - 1);
  EXPECT_EQ(r.depth->relative.max, 0.0);
  EXPECT_EQ(r.normal->angle.max, 0.0);
  EXPECT_EQ(r.color->max, 0.0);
  a.id[on_seven] = 7; // the same particle, and still not counted
  EXPECT_EQ(compare(a, marked).depth->relative.max, 0.0);
  EXPECT_EQ(compare(a, marked).normal->angle.max, 0.0);
  EXPECT_GT(compare(a, b).depth->relative.max, 0.9);
  a.id[on_seven] = 9;
  EXPECT_EQ(compare(marked, a).id->all(), 0u) << "a mask of either picture counts";
  EXPECT_EQ(compare(a, b).id->all(), 1u) << "without a mask all pixels count";
}

TEST(Compare, CoverageFromDepthsAlone) {
  CompareInput a = made_up();
  a.id.clear();
  const CompareInput b = made_up();
  a.depth[on_seven] = infinity;
  a.depth[on_nothing] = 3.0;
  const CompareResult r = compare(a, b);
  ASSERT_TRUE(r.id);
  EXPECT_EQ(r.id->missing, 1u);
  EXPECT_EQ(r.id->extra, 1u);
  EXPECT_EQ(r.id->wrong, 0u);
  EXPECT_EQ(r.depth->compared, particles - 1);
}

TEST(Compare, DepthRelativeAndUlp) {
  const CompareInput b = made_up();
  CompareInput a = b;
  a.depth[on_seven] = b.depth[on_seven] * (1.0 + 1e-5); // 106: floats lie 2^-17 apart there
  const CompareResult r = compare(a, b);
  EXPECT_NEAR(r.depth->relative.max, 1e-5, 1e-12);
  EXPECT_NEAR(r.depth->ulp.max, 106e-5 * 0x1p17, 1e-6);
  EXPECT_EQ(r.depth->relative.median, 0.0);
  EXPECT_NEAR(r.depth->relative.p99, 1e-5, 1e-12) << "1 of 60: the nearest rank of 99 % is the largest";
  a.depth[on_seven] = std::nan("");
  EXPECT_EQ(compare(a, b).depth->relative.max, infinity) << "no number is no small error";
}

TEST(Compare, NormalAngles) {
  CompareInput b = made_up();
  CompareInput a = b;
  const double angle = 1e-4;
  a.normal[on_seven] = glm::vec3(glm::dvec3(std::sin(angle), std::cos(angle) * 0.6, std::cos(angle) * -0.8) *
                                 3.0); // any length
  EXPECT_NEAR(compare(a, b).normal->angle.max, angle, 1e-7);
  b.projected_radius.assign(all_pixels, 1.0f);
  EXPECT_EQ(compare(a, b).normal->beyond_bar, 0u);
  b.projected_radius[on_seven] = 2.0f; // the bar is 7.6e-5 rad now
  EXPECT_EQ(compare(a, b).normal->beyond_bar, 1u);
  a.normal[on_seven] = glm::vec3(std::nanf(""));
  EXPECT_EQ(compare(a, b).normal->angle.max, infinity);
  EXPECT_NEAR(normal_bar(1.5), 1.01e-4, 1e-12);
}

TEST(Compare, ColorSteps) {
  const CompareInput b = made_up();
  CompareInput a = b;
  a.color[on_nothing].g -= 10.0f / 255.0f;
  const CompareResult r = compare(a, b);
  EXPECT_NEAR(r.color->max, 10.0, 1e-4);
  EXPECT_NEAR(r.color->rms, std::sqrt(100.0 / (3.0 * all_pixels)), 1e-5);
  EXPECT_GT(r.color->de_max, 1.0);
  EXPECT_NEAR(r.color->de_mean, r.color->de_max / double(all_pixels), 1e-12);
  EXPECT_EQ(r.color->de_p95, 0.0);
  EXPECT_EQ(r.color->alpha_max, 0.0);
}

TEST(Compare, InvisibleColorsDoNotCountButAlphaDoes) {
  CompareInput b = made_up();
  b.color[on_nothing] = {1, 0, 0, 0};
  CompareInput a = b;
  a.color[on_nothing] = {0, 1, 0, 0};
  EXPECT_EQ(compare(a, b).color->max, 0.0);
  a.color[on_nothing] = {1, 0, 0, 0.2f};
  EXPECT_NEAR(compare(a, b).color->alpha_max, 51.0, 1e-4);
}

TEST(Compare, LinearColorsAreEncodedFirst) {
  CompareInput a = made_up(), b = made_up();
  a.encoding = Encoding::Linear;
  for (glm::vec4& c : a.color) c = glm::vec4(0.214041140f, 0.0f, 5.0f, 1.0f);
  for (glm::vec4& c : b.color) c = glm::vec4(0.5f, 0.0f, 1.0f, 1.0f);
  EXPECT_LT(compare(a, b).color->max, 1e-4);
  a.encoding = Encoding::Srgb;
  EXPECT_GT(compare(a, b).color->max, 50.0);
}

TEST(Compare, ColorsThatAreNoNumbers) {
  const CompareInput b = made_up();
  CompareInput a = b;
  a.color[on_seven].g = std::nanf("");
  const CompareResult r = compare(a, b);
  EXPECT_EQ(r.color->not_finite, 1u);
  EXPECT_EQ(r.color->max, 255.0);
  EXPECT_EQ(compare(a, a).color->max, 255.0) << "not even to itself";
}

TEST(Compare, IntegerColors) {
  const std::uint8_t eight[] = {255, 0, 51, 255};
  const std::uint16_t sixteen[] = {65535, 0, 13107, 65535};
  EXPECT_EQ(color_from_rgba8(eight)[0], color_from_rgba16(sixteen)[0]);
  EXPECT_EQ(color_from_rgba8(eight)[0].r, 1.0f);
  EXPECT_FLOAT_EQ(color_from_rgba8(eight)[0].b, 0.2f);
}

// A disk moved by a third of a pixel: a vertical pair of outlines moves by it, on average over directions
// 2/pi of it.
TEST(Compare, OutlinesOfAMovedDisk) {
  const auto disk = [](double shift) {
    CompareInput p;
    p.width = p.height = 400;
    for (std::uint32_t y = 0; y < 400; ++y)
      for (std::uint32_t x = 0; x < 400; ++x)
        p.id.push_back(std::hypot(x - 200.0 - shift, y - 200.0) < 150.3 ? 1u : no_id);
    return p;
  };
  const CompareResult r = compare(disk(0.5), disk(0.0));
  EXPECT_NEAR(r.outline->length, 2.0 * 3.14159265 * 150.3, 10.0);
  EXPECT_NEAR(r.outline->displacement, 0.5 * 2.0 / 3.14159265, 0.04);
  CompareInput none = disk(0.0);
  none.id.assign(none.id.size(), no_id);
  EXPECT_EQ(compare(disk(0.0), none).outline->displacement, infinity);
}

// A square one pixel to the right: its two upright sides are displaced by a pixel, the others by none. One stray pixel in
// ten thousand does not move the percentile; a particle that is not there at all does.
TEST(Compare, OutlinesAtThe999thPercentile) {
  const auto square = [](int shift) {
    CompareInput p;
    p.width = p.height = 120;
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 120; ++x) p.id.push_back(x - shift >= 20 && x - shift < 100 && y >= 20 && y < 100 ? 1u : no_id);
    return p;
  };
  EXPECT_EQ(compare(square(0), square(0)).outline->p999, 0.0);
  EXPECT_EQ(compare(square(1), square(0)).outline->p999, 1.0);
  EXPECT_EQ(compare(square(3), square(0)).outline->p999, 3.0);
  CompareInput other = square(0);
  for (std::uint32_t& id : other.id)
    if (id == 1u) id = 2u; // nothing of the square is found
  EXPECT_EQ(compare(other, square(0)).outline->p999, infinity);
}

// Known answers: nothing for equal pictures, 1 at most, and the order of what the eye notices.
TEST(Compare, FlipIsZeroForEqualAndGrowsWithWhatIsSeen) {
  const auto flat = [](float g) {
    CompareInput p;
    p.width = p.height = 32;
    p.color.assign(32 * 32, glm::vec4(g, g, g, 1));
    return p;
  };
  EXPECT_EQ(compare(flat(0.5f), flat(0.5f)).color->flip_max, 0.0);
  const double small = compare(flat(0.5f), flat(0.51f)).color->flip_mean, large = compare(flat(0.2f), flat(0.8f)).color->flip_mean;
  EXPECT_GT(small, 0.0);
  EXPECT_LT(small, 0.1);
  EXPECT_GT(large, 0.5);
  // Black against white: HyAB 100, to the power 0.7 25.1, of the largest 41.3 stretched: 0.966.
  EXPECT_NEAR(compare(flat(0.0f), flat(1.0f)).color->flip_mean, 0.966, 0.01);
  CompareInput dotted = flat(0.5f); // a pixel that the eye blurs away counts less than a patch of the same difference
  dotted.color[16 * 32 + 16] = {1, 1, 1, 1};
  CompareInput patch = flat(0.5f);
  for (std::size_t i = 0; i < 100; ++i) patch.color[(11 + i / 10) * 32 + 11 + i % 10] = {1, 1, 1, 1};
  EXPECT_LT(compare(dotted, flat(0.5f)).color->flip_max, compare(patch, flat(0.5f)).color->flip_max);
}

TEST(Compare, DifferentCamerasAreRefused) {
  CompareInput a = made_up(), b = made_up();
  a.camera = "eye = [0, 0, 1]";
  EXPECT_NO_THROW((void)compare(a, b)) << "nothing is known of b's";
  b.camera = a.camera;
  EXPECT_NO_THROW((void)compare(a, b));
  b.camera = "eye = [0, 0, 2]";
  const Failure f = failure_of(a, b);
  EXPECT_EQ(f.diagnostic().code, "K008");
  EXPECT_EQ(f.exit(), Exit::BadInput);
  EXPECT_THAT(f.what(), HasSubstr("eye = [0, 0, 2]"));
}

TEST(Compare, OnlyWhatBothHaveIsMeasured) {
  CompareInput a = made_up(), b = made_up();
  a.normal.clear();
  b.color.clear();
  CompareResult r = compare(a, b);
  EXPECT_TRUE(r.id && r.depth && !r.normal && !r.color);
  a = b = made_up();
  a.id.clear();
  a.depth.clear();
  r = compare(a, b);
  EXPECT_TRUE(!r.id && !r.depth && !r.outline && r.normal && r.color);
  EXPECT_EQ(r.normal->compared, particles);
}

TEST(Compare, DifferentSizesAreRefused) {
  CompareInput a = made_up();
  a.name = "a.png";
  std::swap(a.width, a.height);
  const Failure f = failure_of(a, made_up());
  EXPECT_EQ(f.diagnostic().code, "K004");
  EXPECT_EQ(f.exit(), Exit::BadInput);
  EXPECT_THAT(f.what(), HasSubstr("a.png"));
  EXPECT_THAT(f.what(), HasSubstr("10 x 20 pixels, but 'made_up' is 20 x 10"));
}

TEST(Compare, NothingInCommonIsRefused) {
  CompareInput a = made_up(), b = made_up();
  a.depth.clear();
  a.id.clear();
  a.normal.clear();
  b.color.clear();
  const Failure f = failure_of(a, b);
  EXPECT_EQ(f.diagnostic().code, "K005");
  EXPECT_THAT(f.what(), HasSubstr("'made_up' has depth, id, normal"));
}

TEST(Compare, ArraysMustFitTheSize) {
  CompareInput a = made_up();
  a.id.pop_back();
  const Failure f = failure_of(a, made_up());
  EXPECT_EQ(f.diagnostic().code, "K007");
  EXPECT_THAT(f.what(), HasSubstr("id has 199 values, but 20 x 10 pixels need 200"));
}

TEST(Compare, DifferencePicture) {
  const CompareInput b = made_up();
  CompareInput a = b;
  a.id[on_seven] = 9;
  a.id[on_nine] = no_id;
  a.color[on_nothing].g -= 10.0f / 255.0f;
  a.ambiguous.assign(all_pixels, 0);
  a.ambiguous[on_nine] = 1;
  std::vector<std::uint8_t> d = difference_picture(a, b, 2.0);
  ASSERT_EQ(d.size(), all_pixels * 4);
  const auto pixel = [&](std::size_t i) {
    return std::vector<int>(d.begin() + std::ptrdiff_t(4 * i), d.begin() + std::ptrdiff_t(4 * i + 4));
  };
  EXPECT_EQ(pixel(on_seven), (std::vector<int>{255, 0, 0, 255}));
  EXPECT_EQ(pixel(on_nine), (std::vector<int>{255, 220, 0, 255}));
  EXPECT_EQ(pixel(on_nothing), (std::vector<int>{20, 20, 20, 255}));
  EXPECT_EQ(pixel(on_nothing + 1), (std::vector<int>{0, 0, 0, 255}));
  a = b;
  a.color.clear();
  a.depth[on_seven] *= 1.0 + 1e-6; // the middle of the logarithmic scale
  d = difference_picture(a, b);
  EXPECT_NEAR(pixel(on_seven)[0], 128, 1);
}

} // namespace
} // namespace mote::compare
