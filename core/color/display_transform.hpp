// SPDX-License-Identifier: MIT
// The way from the working space to the display: linear RGBA in, encoded RGBA in [0,1] out. Made
// once per config, display and view; the display pass takes the GLSL function and its tables from
// here, the reference and the tests take apply(), which is OpenColorIO's own CPU arithmetic.
//
// Both ways share one frame: NaN becomes 0, the value is multiplied by 2^exposure and cut to
// +-65504, the view transform runs, NaN becomes 0 again and the result is cut to [0,1]. Alpha is
// straight, never enters the transform, and is only cut to [0,1] (NaN: 0).
//
// Baking: spline curves and chains of logarithms cost a CPU device tens of milliseconds a frame. By
// default every run of per-channel arithmetic that is costly becomes a CurveTable; the arithmetic
// that mixes channels stays. A single 3-D table instead was measured 9 to 19 eighth-bit steps wrong
// at 65^3 for the ACES view (saturated colors), whatever the shaper; this way stays far below one.
// The error is measured on a grid at creation; above one step nothing is baked. `exact` bakes nothing.
#pragma once

#include "core/color/color_config.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mote {

struct DisplayRequest {
  std::string source_space{}; // empty: the working space
  std::string display{};      // empty: the config's default
  std::string view{};         // empty: the display's default
  double exposure{};          // stops, finite
  bool exact{};
  SourceLoc loc{}; // where the names were written
};

// A table that the GLSL function samples. Upload as it is; clamp to edge on all axes.
struct DisplayLut {
  enum class Format : std::uint8_t { RG32Float, RGBA32Float };
  std::string name{}; // of the sampler in the text
  Format format{Format::RGBA32Float};
  bool volume{};                              // 3-D texture, else 2-D
  bool linear{};                              // filter; else nearest
  std::uint32_t width{}, height{1}, depth{1}; // texels
  std::uint32_t texture_binding{}, sampler_binding{};
  std::vector<float> data{}; // x fastest, then y, then z
};

struct GlslOptions {
  std::string function{"mote_display"}; // also the prefix of every other global name
  std::uint32_t set{};
  std::uint32_t first_binding{}; // lut k takes first_binding + 2 k (texture) and + 2 k + 1 (sampler)
};

struct DisplayGlsl {
  // Vulkan GLSL 4.50 without #version, declaring the bindings and two functions:
  //   vec4 <function>(vec4 linear, float gain)   gain = 2^exposure, e.g. from a uniform
  //   vec4 <function>(vec4 linear)               gain = that of the request
  std::string text{};
  std::vector<DisplayLut> luts{};
  std::string cache_id{}; // 16 hexadecimal digits over text and tables
};

class DisplayTransform {
public:
  [[nodiscard]] const std::string& display() const;
  [[nodiscard]] const std::string& view() const;
  [[nodiscard]] const std::string& source_space() const;
  [[nodiscard]] double gain() const; // 2^exposure

  // In place, straight RGBA, size a multiple of 4. OCIO's arithmetic, also when baked. Thread-safe.
  void apply(std::span<float> rgba) const;
  // The same with the tables, as the GLSL function computes. Equal to apply() when nothing is baked.
  void apply_baked(std::span<float> rgba) const;

  [[nodiscard]] bool baked() const;
  // Largest |apply_baked - apply| in steps of 1/255 over bake_grid(); 0 when nothing is baked.
  [[nodiscard]] double baked_error() const;
  // "sRGB / ACES SDR, baked: at most 0.05 of 1/255 from OpenColorIO's arithmetic"
  [[nodiscard]] std::string describe() const;

  [[nodiscard]] DisplayGlsl glsl(const GlslOptions& options = {}) const;

  struct Inner;

private:
  explicit DisplayTransform(std::shared_ptr<const Inner> inner) : inner_(std::move(inner)) {}
  friend DisplayTransform make_display_transform(const ColorConfig&, const DisplayRequest&);
  std::shared_ptr<const Inner> inner_;
};

// Throws Failure C003, C004, C005, C007, C009.
DisplayTransform make_display_transform(const ColorConfig& config, const DisplayRequest& request = {});

// The points on which a baked transform is judged, RGBA with alpha 1: 33^3 colors whose axis holds
// five values of -0.1..0 and 28 from 0.001 to 64, log-spaced; then 1000 greys over the same range.
std::vector<float> bake_grid();

} // namespace mote
