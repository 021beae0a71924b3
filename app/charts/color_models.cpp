// SPDX-License-Identifier: MIT
// Topic `color_models`: RGB through other models and back, by the bits between, in float32 and in double on this device; tables
// of hues; chroma stored for fewer pixels than luma.
#include "app/charts/chroma.hpp"
#include "app/charts/kernel.hpp"
#include "app/charts/random.hpp"
#include "app/charts/topic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::app {
namespace {

struct Model {
  int number; // MODEL of shaders/charts/color_models.comp
  const char* name;
};
constexpr std::array models{Model{1, "CMY"}, Model{2, "CMYK"}, Model{3, "HSV"}, Model{4, "Y'UV (BT.601)"}, Model{5, "Y'CbCr BT.601, full range"},
                            Model{6, "Y'CbCr BT.709, full range"}, Model{7, "Y'CbCr BT.709, limited range"}};

// Every 17th level of each channel, and random 8-bit colors.
std::vector<float> colors(double bits) {
  std::vector<float> out;
  auto add = [&](double r, double g, double b) {
    for (const double v : {r / 255.0, g / 255.0, b / 255.0, bits}) out.push_back(static_cast<float>(v));
  };
  for (int r = 0; r < 256; r += 17)
    for (int g = 0; g < 256; g += 17)
      for (int b = 0; b < 256; b += 17) add(r, g, b);
  Random random(41);
  auto level = [&] { return std::floor(random.uniform(0.0, 256.0)); };
  for (int i = 0; i < 16384; ++i) {
    const double r = level(), g = level();
    add(r, g, level());
  }
  return out;
}

double largest(const std::vector<float>& made) {
  double out = 0.0;
  for (std::size_t i = 0; i < made.size(); ++i)
    if (i % 4 != 3) out = std::max(out, std::isfinite(made[i]) ? 255.0 * std::abs(static_cast<double>(made[i])) : 255.0);
  return out;
}

} // namespace

chart::Chart chart_color_models(TopicContext& context) {
  chart::Chart c{.topic = "color_models", .title = "Color models: to and fro"};
  const chart::Axis error{"largest error", "steps of 255", true};
  c.panels = {{"RGB to the model and back, its numbers rounded", {"bits a number", "", false}, error, false, {}},
              {"The same without rounding", {"time to and fro", "ns", true}, error, true, {}}};
  const bool wide = gpu::has(context.device.device().features(), gpu::Feature::ShaderFloat64);
  if (!wide) c.notes.push_back("Double is left out: the device lacks shaderFloat64.");
  for (const Model& model : models) {
    chart::Series rounded{model.name, false, {}};
    for (int precision = 0; precision < (wide ? 2 : 1); ++precision) {
      std::vector<gpu::ShaderDefine> defines{{"MODEL", std::to_string(model.number)}};
      if (precision == 1) defines.push_back({"WIDE", "1"});
      Kernel kernel(context.device, "charts/color_models.comp", defines);
      auto count = [](const std::vector<float>& given) { return static_cast<std::uint32_t>(given.size() / 4); };
      if (precision == 0)
        for (const int bits : {6, 8, 10, 12, 16}) {
          const std::vector<float> given = colors(bits);
          rounded.points.push_back({fmt::format("{} bits", bits), static_cast<double>(bits), largest(kernel.run(given, count(given), 1))});
        }
      const std::vector<float> given = colors(0.0);
      c.panels[1].series.push_back({fmt::format("{}, {}", model.name, precision ? "double" : "float32"), precision == 1,
                                    {{"", kernel.nanoseconds(given, count(given), 1), largest(kernel.run(given, count(given), 1))}}});
    }
    c.panels[0].series.push_back(std::move(rounded));
    context.say(model.name);
  }
  c.panels.push_back(hue_panel());
  c.panels.push_back(chroma_panel());
  return c;
}

} // namespace mote::app
