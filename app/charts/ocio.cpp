// SPDX-License-Identifier: MIT
// Topic `ocio`: OpenColorIO's arithmetic as a shader, mote's baked curves, and 3-D tables of several sizes behind a logarithm, against
// OpenColorIO's own processor path, on the grid that bakes are judged on, without its colors below 0: 0 ... 64.
#include "app/charts/display_kernel.hpp"
#include "app/charts/topic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote::app {
namespace {

double largest(const std::vector<float>& a, const std::vector<float>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, 255.0 * std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  return out;
}

std::vector<float> colors_from_zero() {
  const std::vector<float> all = bake_grid();
  std::vector<float> out;
  for (std::size_t i = 0; i < all.size(); i += 4)
    if (std::min({all[i], all[i + 1], all[i + 2]}) >= 0.0f) out.insert(out.end(), all.begin() + static_cast<std::ptrdiff_t>(i), all.begin() + static_cast<std::ptrdiff_t>(i + 4));
  return out;
}

// x -> log2(x + 2^-9) between its values at 0 and 64, the axis of a table with n entries a side.
constexpr float offset = 0x1p-9f;
DisplayGlsl table(const DisplayTransform& transform, std::uint32_t n) {
  const double low = -9.0, high = std::log2(64.0 + static_cast<double>(offset));
  DisplayLut lut{.name = "table", .volume = true, .linear = true, .width = n, .height = n, .depth = n, .texture_binding = 2, .sampler_binding = 3};
  for (std::uint32_t b = 0; b < n; ++b)
    for (std::uint32_t g = 0; g < n; ++g)
      for (std::uint32_t r = 0; r < n; ++r) {
        for (const std::uint32_t i : {r, g, b}) lut.data.push_back(static_cast<float>(std::exp2(low + (high - low) * i / (n - 1.0)) - static_cast<double>(offset)));
        lut.data.push_back(1.0f);
      }
  transform.apply(lut.data);
  DisplayGlsl out;
  out.text = fmt::format("layout(set = 1, binding = 2) uniform texture3D table_texture;\nlayout(set = 1, binding = 3) uniform sampler table_sampler;\n"
                         "vec4 mote_display(vec4 c) {{\n  vec3 at = clamp((log2(max(c.rgb, vec3(0.0)) + {:.9f}) - ({:.9f})) / {:.9f}, 0.0, 1.0);\n"
                         "  return vec4(textureLod(sampler3D(table_texture, table_sampler), (at * {:.1f} + 0.5) / {:.1f}, 0.0).rgb, c.a);\n}}\n",
                         static_cast<double>(offset), low, high - low, n - 1.0, static_cast<double>(n));
  out.luts.push_back(std::move(lut));
  return out;
}

} // namespace

chart::Chart chart_ocio(TopicContext& context) {
  chart::Chart c{.topic = "ocio", .title = "Display transforms: arithmetic and tables"};
  const std::vector<float> grid = colors_from_zero();
  for (const std::string& view : context.config.views(context.config.default_display())) {
    DisplayRequest request{.view = view, .exact = true};
    const DisplayTransform exact = make_display_transform(context.config, request);
    request.exact = false;
    const DisplayTransform baked = make_display_transform(context.config, request);
    std::vector<float> truth = grid;
    exact.apply(truth);
    chart::Panel panel{view, {"time a pixel", "ns", true}, {"largest error", "steps of 255", true}, true, {}};
    auto add = [&](chart::Series& series, const std::string& parameter, const DisplayGlsl& glsl) {
      DisplayKernel kernel(context.device, glsl);
      const std::vector<float> out = kernel.run(grid);
      series.points.push_back({parameter, kernel.nanoseconds(grid), largest(out, truth)});
      context.say(view + ", " + series.method + " " + parameter);
    };
    chart::Series arithmetic{"exact arithmetic", false, {}}, curves{"baked curves (mote)", false, {}}, tables{"3-D table behind a logarithm", true, {}};
    add(arithmetic, "", exact.glsl({.set = 1, .first_binding = 2}));
    panel.series.push_back(std::move(arithmetic));
    if (baked.baked()) {
      add(curves, "", baked.glsl({.set = 1, .first_binding = 2}));
      panel.series.push_back(std::move(curves));
    } else {
      c.notes.push_back(fmt::format("'{}' is cheap or too curved to bake: it has arithmetic only.", view));
    }
    for (const std::uint32_t n : {17u, 33u, 65u}) add(tables, fmt::format("{}^3", n), table(exact, n));
    panel.series.push_back(std::move(tables));
    c.panels.push_back(std::move(panel));
  }
  return c;
}

} // namespace mote::app
