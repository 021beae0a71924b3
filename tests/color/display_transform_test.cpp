// SPDX-License-Identifier: MIT
#include "core/color/curve_table.hpp"
#include "core/color/default_config.hpp"
#include "core/color/display_transform.hpp"
#include "core/color/srgb.hpp"
#include "tests/color/lut_config.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {
using namespace mote;
using testing::HasSubstr;
using testing::Not;

template <class F> Diagnostic failure_of(F&& f) {
  try {
    f();
  } catch (const Failure& failure) {
    return failure.diagnostic();
  }
  ADD_FAILURE() << "no failure";
  return {};
}

class DisplayTransformTest : public testing::Test {
protected:
  static DisplayTransform make(const std::string& view, double exposure = 0, bool exact = false) {
    return make_display_transform(ColorConfig::from_text(default_color_config(), "shipped"),
                                  {.view = view, .exposure = exposure, .exact = exact});
  }
  static std::array<float, 4> of(const DisplayTransform& transform, std::array<float, 4> pixel) {
    transform.apply(pixel);
    return pixel;
  }
};

TEST_F(DisplayTransformTest, DefaultIsThePlainSrgbCurve) {
  const DisplayTransform transform = make("");
  EXPECT_EQ(transform.display(), "sRGB");
  EXPECT_EQ(transform.view(), "Un-tone-mapped");
  EXPECT_FALSE(transform.baked());
  std::vector<float> grid = bake_grid();
  std::vector<float> out = grid;
  transform.apply(out);
  double largest = 0;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (i % 4 != 3)
      largest = std::max(largest,
                         std::fabs(std::clamp(srgb_encode(grid[i]), 0.0, 1.0) - static_cast<double>(out[i])));
  EXPECT_LE(largest, 2e-5);
}

// Values of OpenColorIO 2.1.2 and 2.1.3, read off a program of its own.
TEST_F(DisplayTransformTest, MeetsKnownValues) {
  const auto plain = of(make("Un-tone-mapped"), {0.2f, 0.5f, 0.8f, 0.25f});
  EXPECT_NEAR(plain[0], 0.484529, 2e-6);
  EXPECT_NEAR(plain[1], 0.735357, 2e-6);
  EXPECT_NEAR(plain[2], 0.906332, 2e-6);
  EXPECT_EQ(plain[3], 0.25f);
  for (const auto& [in, out] : {std::pair{0.18f, 0.355954}, {1.0f, 0.811971}, {16.0f, 0.999741}}) {
    const auto grey = of(make("ACES SDR"), {in, in, in, 1.0f});
    EXPECT_NEAR(grey[0], out, 3e-6) << in;
    EXPECT_NEAR(grey[0], grey[2], 1e-6);
  }
  EXPECT_EQ(of(make("Raw"), {0.25f, 0.5f, 0.75f, 1.0f}), (std::array<float, 4>{0.25f, 0.5f, 0.75f, 1.0f}));
}

TEST_F(DisplayTransformTest, GuardsAndCuts) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const char* view : {"Un-tone-mapped", "ACES SDR", "Raw"}) {
    const DisplayTransform transform = make(view);
    EXPECT_EQ(of(transform, {nan, 0.5f, 0.25f, 1.0f}), of(transform, {0.0f, 0.5f, 0.25f, 1.0f})) << view;
    EXPECT_EQ(of(transform, {inf, 0.5f, 0.25f, 1.0f}), of(transform, {65504.0f, 0.5f, 0.25f, 1.0f})) << view;
    EXPECT_EQ(of(transform, {-inf, 0.5f, 0.25f, 1.0f}), of(transform, {-65504.0f, 0.5f, 0.25f, 1.0f}))
        << view;
    EXPECT_EQ(of(transform, {0, 0, 0, nan})[3], 0.0f);
    EXPECT_EQ(of(transform, {0, 0, 0, 1.5f})[3], 1.0f);
    std::vector<float> out = bake_grid();
    for (float& v : out) v *= 900.0f;
    transform.apply(out);
    EXPECT_TRUE(std::all_of(out.begin(), out.end(), [](float v) { return v >= 0.0f && v <= 1.0f; })) << view;
  }
}

TEST_F(DisplayTransformTest, ExposureMultiplies) {
  const DisplayTransform transform = make("ACES SDR", 1.5);
  EXPECT_DOUBLE_EQ(transform.gain(), std::exp2(1.5));
  const float g = static_cast<float>(std::exp2(1.5));
  EXPECT_EQ(of(transform, {0.1f, 0.2f, 0.3f, 1.0f}),
            of(make("ACES SDR"), {0.1f * g, 0.2f * g, 0.3f * g, 1.0f}));
  for (const double bad : {std::nan(""), HUGE_VAL, 1000.0}) {
    const Diagnostic d = failure_of([&] { make("Raw", bad); });
    EXPECT_EQ(d.code, "C009");
    EXPECT_THAT(d.text, HasSubstr("exposure"));
  }
}

TEST_F(DisplayTransformTest, BakesTheAcesViewWithinAStep) {
  const DisplayTransform baked = make("ACES SDR");
  ASSERT_TRUE(baked.baked());
  EXPECT_GT(baked.baked_error(), 0.0);
  EXPECT_LE(baked.baked_error(), 1.0);
  EXPECT_THAT(baked.describe(), HasSubstr("sRGB / ACES SDR, baked: at most 0."));
  std::printf("%s\n", baked.describe().c_str());
  std::vector<float> a = bake_grid(), b;
  for (float& v : a) v *= 1.37f; // off the grid that the error was measured on
  b = a;
  baked.apply(a);
  baked.apply_baked(b);
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::fabs(double{a[i]} - double{b[i]}));
  EXPECT_LE(largest * 255, 1.0);
  EXPECT_FALSE(make("ACES SDR", 0, true).baked());
  EXPECT_EQ(make("ACES SDR", 0, true).baked_error(), 0.0);
}

TEST_F(DisplayTransformTest, WritesGlsl) {
  const DisplayGlsl plain = make("").glsl({.function = "show", .set = 2, .first_binding = 5});
  EXPECT_THAT(plain.text, HasSubstr("vec4 show(vec4 linear, float gain)"));
  EXPECT_THAT(plain.text, Not(HasSubstr("#version")));
  EXPECT_TRUE(plain.luts.empty());
  const DisplayGlsl aces = make("ACES SDR").glsl({.set = 2, .first_binding = 5});
  ASSERT_EQ(aces.luts.size(), 1u);
  EXPECT_EQ(aces.luts[0].texture_binding, 5u);
  EXPECT_EQ(aces.luts[0].sampler_binding, 6u);
  EXPECT_EQ(aces.luts[0].data.size(), std::size_t{CurveTable::cells} * 2);
  EXPECT_THAT(aces.text, HasSubstr("layout(set = 2, binding = 5) uniform texture2D"));
  EXPECT_THAT(aces.text, Not(HasSubstr("rgbcurve"))); // that is what was baked
  EXPECT_EQ(aces.cache_id, make("ACES SDR").glsl({.set = 2, .first_binding = 5}).cache_id);
  EXPECT_NE(aces.cache_id, make("ACES SDR", 1.0).glsl({.set = 2, .first_binding = 5}).cache_id);
  EXPECT_NE(aces.cache_id, make("ACES SDR", 0, true).glsl({.set = 2, .first_binding = 5}).cache_id);
}

TEST_F(DisplayTransformTest, TakesTablesFromAConfig) {
  const auto folder = std::filesystem::temp_directory_path() / ("mote-luts-" + std::to_string(getpid()));
  const ColorConfig config = ColorConfig::load(test::write_lut_config(folder));
  EXPECT_THAT(config.views("Test"), testing::ElementsAreArray(test::lut_views()));
  auto glsl = [&](const std::string& view) {
    return make_display_transform(config, {.view = view}).glsl({.first_binding = 7});
  };
  const DisplayGlsl curve = glsl("Curve");
  ASSERT_EQ(curve.luts.size(), 1u);
  EXPECT_FALSE(curve.luts[0].volume);
  EXPECT_TRUE(curve.luts[0].linear);
  EXPECT_EQ(curve.luts[0].width, 256u);
  EXPECT_THAT(curve.text, Not(HasSubstr("sampler1D"))); // 1-D textures are not asked for
  EXPECT_EQ(curve.luts[0].data.size(), 256u * 4u);
  EXPECT_EQ(glsl("Long curve").luts[0].height, 3u); // folded into rows of 4096
  const DisplayGlsl cube = glsl("Tetrahedral");
  EXPECT_TRUE(cube.luts[0].volume);
  EXPECT_FALSE(cube.luts[0].linear);
  EXPECT_EQ(cube.luts[0].data.size(), 9u * 9u * 9u * 4u);
  const DisplayGlsl chain = glsl("Chain");
  ASSERT_EQ(chain.luts.size(), 4u);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(chain.luts[i].texture_binding, 7 + 2 * i);
  EXPECT_THAT(chain.text, Not(HasSubstr("uniform sampler2D")));
  EXPECT_THAT(chain.text, Not(HasSubstr("uniform sampler3D")));
  const DisplayTransform splines = make_display_transform(config, {.view = "Splines"});
  EXPECT_TRUE(splines.baked());
  EXPECT_EQ(splines.glsl().luts[0].height, 3u); // three different curves
  std::printf("%s\n", splines.describe().c_str());
  const DisplayTransform steep = make_display_transform(config, {.view = "Steep"}); // a jump inside a cell
  EXPECT_FALSE(steep.baked());
  EXPECT_EQ(steep.baked_error(), 0.0);
  EXPECT_TRUE(steep.glsl().luts.empty());
  const auto out = of(make_display_transform(config, {.view = "Curve"}), {1.95f, -5.0f, 50.0f, 1.0f});
  EXPECT_NEAR(out[0], std::sqrt(0.5), 1e-4); // (1.95 + 0.1) / 4.1 = 1/2, then the square root
  EXPECT_EQ(out[1], 0.0f);
  EXPECT_EQ(out[2], 1.0f);
  std::filesystem::remove_all(folder);
}

TEST_F(DisplayTransformTest, NamesWhatDoesNotExist) {
  const ColorConfig config = ColorConfig::from_text(default_color_config(), "shipped");
  EXPECT_EQ(failure_of([&] { make_display_transform(config, {.display = "P3"}); }).code, "C003");
  EXPECT_EQ(failure_of([&] { make_display_transform(config, {.view = "Film"}); }).code, "C004");
  EXPECT_EQ(failure_of([&] { make_display_transform(config, {.source_space = "Mine"}); }).code, "C005");
  // a config may name a LUT file that is not there: found only when the view is built
  std::string text(default_color_config());
  const std::string view = "UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}";
  text.replace(text.find("!<BuiltinTransform> {style: " + view), 28 + view.size(),
               "!<FileTransform> {src: absent.cube}");
  const Diagnostic d = failure_of([&] { make_display_transform(ColorConfig::from_text(text, "t")); });
  EXPECT_EQ(d.code, "C007");
  EXPECT_THAT(d.text, HasSubstr("absent.cube"));
}

TEST(CurveTable, FollowsASmoothFunctionOfEitherSign) {
  const CurveTable table([](std::span<float> rgb) {
    for (float& v : rgb) v = std::cbrt(v) + v;
  });
  EXPECT_TRUE(table.usable());
  EXPECT_EQ(table.rows(), 1u);
  for (double x = 1e-4; x < 1e5; x *= 1.003)
    for (const double s : {x, -x})
      EXPECT_NEAR(table(1, static_cast<float>(s)) / (std::cbrt(s) + s), 1.0, 4e-5) << s;
  EXPECT_EQ(table(0, 0.0f), 0.0f);
  EXPECT_EQ(table(0, -0.0f), 0.0f);
  EXPECT_TRUE(std::isfinite(table(0, 3e38f)));
}

TEST(CurveTable, KeepsChannelsApartAndRefusesInfinity) {
  const CurveTable three([](std::span<float> rgb) {
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] *= static_cast<float>(i % 3 + 1);
  });
  EXPECT_EQ(three.rows(), 3u);
  EXPECT_NEAR(three(2, 0.7f), 2.1f, 1e-6f);
  EXPECT_FALSE(CurveTable([](std::span<float> rgb) {
                 for (float& v : rgb) v = std::log(v);
               }).usable());
}
} // namespace
