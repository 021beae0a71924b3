// SPDX-License-Identifier: MIT
// The GLSL of every view transform against OpenColorIO's CPU arithmetic. Bars: 2e-5 after clamping
// where the arithmetic is OCIO's, 1/255 where it is baked.
#include "core/color/default_config.hpp"
#include "tests/color/lut_config.hpp"
#include "tests/color_gpu/compute_display.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace {
using namespace mote;
using mote::test::ComputeDisplay;

class ColorGpu : public testing::Test {
protected:
  static void SetUpTestSuite() {
    gpu::Error error;
    instance = gpu::Instance::create({.application = "color_gpu_test", .validation = true}, error);
    ASSERT_TRUE(instance) << to_string(error);
    const gpu::Adapter adapter = instance.request_adapter({}, error);
    ASSERT_TRUE(adapter) << to_string(error);
    device = adapter.request_device({}, error);
    ASSERT_TRUE(device) << to_string(error);
  }
  static void TearDownTestSuite() {
    device = {};
    instance = {};
  }
  void TearDown() override { EXPECT_THAT(instance.validation_messages(), testing::IsEmpty()); }

  static DisplayTransform shipped(const std::string& view, bool exact = false, double exposure = 0) {
    return make_display_transform(ColorConfig::from_text(default_color_config(), "shipped"),
                                  {.view = view, .exposure = exposure, .exact = exact});
  }

  // The grid, what a picture may hold besides, and what no picture should.
  static std::vector<float> colors() {
    std::vector<float> rgba = bake_grid();
    for (const float v : {65504.0f, -65504.0f, 1e30f, -1e30f, 1e-30f, -1e-30f, -0.0f, HUGE_VALF, -HUGE_VALF,
                          std::numeric_limits<float>::quiet_NaN()}) {
      rgba.insert(rgba.end(), {v, 0.5f, 0.25f, 0.5f});
      rgba.insert(rgba.end(), {0.5f, v, v, 1.0f});
      rgba.insert(rgba.end(), {v, v, v, v});
    }
    return rgba;
  }

  // Largest difference, one axis of RGBA at a time so that a message can say where.
  static double largest_difference(const DisplayTransform& transform, const std::string& what,
                                   const std::string& call = "mote_display(c)") {
    const std::vector<float> in = colors();
    std::vector<float> expected = in;
    transform.apply(expected);
    const std::vector<float> got = ComputeDisplay(device, transform, call)(in);
    double largest = 0;
    std::size_t where = 0, different = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
      if (!(got[i] >= 0.0f && got[i] <= 1.0f)) {
        ADD_FAILURE() << what << ": value " << got[i] << " for " << in[i / 4 * 4];
        return 1;
      }
      const double d = std::fabs(double{got[i]} - double{expected[i]});
      different += std::lround(got[i] * 255.0f) != std::lround(expected[i] * 255.0f);
      if (d > largest) largest = d, where = i / 4 * 4;
    }
    fmt::print(
        "{}: largest difference {:.2e} ({:.4f} of 1/255) at ({}, {}, {}); {} of {} eight-bit values differ\n",
        what, largest, largest * 255, in[where], in[where + 1], in[where + 2], different, in.size());
    return largest;
  }

  static inline gpu::Instance instance;
  static inline gpu::Device device;
};

TEST_F(ColorGpu, ShippedViewsEqualTheCpu) {
  EXPECT_LE(largest_difference(shipped("Un-tone-mapped"), "Un-tone-mapped"), 2e-5);
  EXPECT_LE(largest_difference(shipped("Raw"), "Raw"), 2e-5);
  EXPECT_LE(largest_difference(shipped("ACES SDR", true), "ACES SDR, exact"), 2e-5);
}

TEST_F(ColorGpu, BakedViewIsWithinAStep) {
  const DisplayTransform transform = shipped("ACES SDR");
  ASSERT_TRUE(transform.baked());
  EXPECT_LE(largest_difference(transform, transform.describe()), 1 / 255.0);
}

// apply_baked() computes what the shader computes: the error that it measured is the picture's.
TEST_F(ColorGpu, TablesEqualTheirCpuTwin) {
  const DisplayTransform transform = shipped("ACES SDR");
  const std::vector<float> in = colors();
  std::vector<float> expected = in;
  transform.apply_baked(expected);
  const std::vector<float> got = ComputeDisplay(device, transform)(in);
  for (std::size_t i = 0; i < in.size(); ++i) ASSERT_NEAR(got[i], expected[i], 2e-5) << in[i / 4 * 4];
}

TEST_F(ColorGpu, ExposureIsTheRequestsOrTheCallers) {
  const DisplayTransform brighter = shipped("Un-tone-mapped", false, 1.25);
  EXPECT_LE(largest_difference(brighter, "exposure 1.25"), 2e-5);
  EXPECT_LE(largest_difference(brighter, "exposure 1.25 by the caller", "mote_display(c, exp2(1.25))"), 2e-5);
}

TEST_F(ColorGpu, TablesOfAConfigEqualTheCpu) {
  const auto folder = std::filesystem::temp_directory_path() / ("mote-luts-gpu-" + std::to_string(getpid()));
  const ColorConfig config = ColorConfig::load(test::write_lut_config(folder));
  for (const std::string& view : test::lut_views()) {
    const DisplayTransform exact = make_display_transform(config, {.view = view, .exact = true});
    EXPECT_LE(largest_difference(exact, view), 2e-5);
    const DisplayTransform baked = make_display_transform(config, {.view = view});
    EXPECT_LE(largest_difference(baked, baked.describe()), baked.baked() ? 1 / 255.0 : 2e-5);
  }
  std::filesystem::remove_all(folder);
}

// Prints what docs/performance.md quotes; fails only when something is badly wrong.
TEST_F(ColorGpu, TakesAFewMillisecondsAFrame) {
  std::vector<float> frame(1920 * 1080 * 4);
  for (std::size_t i = 0; i < frame.size(); ++i)
    frame[i] = 0.5f + 0.5f * std::sin(static_cast<float>(i / 4) * 0.003f + static_cast<float>(i % 4));
  auto best = [&](const DisplayTransform& transform) {
    ComputeDisplay run(device, transform);
    double least = 1e9;
    for (int i = 0; i < 5; ++i) {
      (void)run(frame);
      least = std::min(least, run.milliseconds);
    }
    fmt::print("1920x1080 {}: {:.1f} ms of processor time\n", transform.describe(), least);
    return least;
  };
  best(shipped("Raw"));
  best(shipped("Un-tone-mapped"));
  const double baked = best(shipped("ACES SDR")), exact = best(shipped("ACES SDR", true));
  EXPECT_LT(baked, exact);
}
} // namespace
