// SPDX-License-Identifier: MIT
// Topic `depth`: encodings of distance and the formats they are stored in, near 0.1, far 1e6 where an encoding has one. The
// encoding runs on this device; rounding to 16 and 24 bits is done here, since mote's passes have depth32float only.
#include "app/charts/errors.hpp"
#include "app/charts/kernel.hpp"
#include "app/charts/random.hpp"
#include "app/charts/topic.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace mote::app {
namespace {

constexpr double near_plane = 0.1, far_plane = 1e6;
constexpr std::array decades{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}; // powers of ten of z / near
constexpr double timed_decade = 4.0;
constexpr std::uint32_t samples = 20000;

struct Way {
  const char* name;
  int encoding; // of shaders/charts/depth.comp
  int bits;     // of an integer format; 0: float32
  bool baseline;
};
constexpr std::array ways{Way{"reverse, infinite far, D32F (mote)", 1, 0, false}, Way{"standard D32F", 0, 0, true}, Way{"standard D24", 0, 24, true},
                          Way{"standard D16", 0, 16, true},   Way{"reverse D24", 1, 24, true}, Way{"reverse D16", 1, 16, true},
                          Way{"linear D32F", 2, 0, false},    Way{"linear, reversed, D32F", 3, 0, true}, Way{"logarithmic D32F", 4, 0, false},
                          Way{"logarithmic D24", 4, 24, true}};

// The distance that a stored depth means, in double.
double decode(int encoding, double d) {
  const double n = near_plane, f = far_plane;
  switch (encoding) {
  case 0: return f * n / (f - d * (f - n));
  case 1: return n / d;
  case 2: return n + d * (f - n);
  case 3: return n + (1.0 - d) * (f - n);
  default: return n * std::pow(f / n, d);
  }
}

std::vector<float> distances(double decade) {
  Random random(31);
  std::vector<float> given;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const double z = near_plane * std::pow(10.0, decade) * random.uniform(0.7, 1.4);
    for (const double v : {z, near_plane, far_plane, 0.0}) given.push_back(static_cast<float>(v));
  }
  return given;
}

double p99(int encoding, int bits, const std::vector<float>& given, const std::vector<float>& made) {
  std::vector<double> errors;
  const double levels = std::exp2(bits) - 1.0;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const double z = given[4 * i], d = made[4 * i], stored = bits ? std::round(d * levels) / levels : d;
    const double found = decode(encoding, stored);
    errors.push_back(std::isfinite(found) ? std::abs(found - z) / z : 1.0);
  }
  return chart::percentile(std::move(errors), 0.99);
}

Kernel kernel_of(DrawingDevice& device, int encoding) {
  const std::array<gpu::ShaderDefine, 1> defines{{{"ENCODING", std::to_string(encoding)}}};
  return Kernel(device, "charts/depth.comp", defines);
}

} // namespace

double depth_error(DrawingDevice& device, int encoding, int bits, double decade) {
  const std::vector<float> given = distances(decade);
  return p99(encoding, bits, given, kernel_of(device, encoding).run(given, samples, 1));
}

chart::Chart chart_depth(TopicContext& context) {
  chart::Chart c{.topic = "depth", .title = "Depth: encodings and formats"};
  c.panels = {{"Distance read back from the stored depth", {"distance / near plane", "", true}, {"relative error, p99", "", true}, false, {}},
              {"Where two surfaces meet, at 1e4 times the near plane", {"time to encode", "ns", true}, {"displacement of the curve", "px", true}, true, {}}};
  for (const Way& way : ways) {
    Kernel kernel = kernel_of(context.device, way.encoding);
    chart::Series over_distance{way.name, way.baseline, {}}, over_time = over_distance;
    for (const double decade : decades) {
      const std::vector<float> given = distances(decade);
      const double error = p99(way.encoding, way.bits, given, kernel.run(given, samples, 1));
      over_distance.points.push_back({fmt::format("z / near = 1e{:g}", decade), std::pow(10.0, decade), error});
      // Slopes of depth that differ by 0.1, 1000 pixels of focal length (method book, section 5).
      if (decade == timed_decade) over_time.points.push_back({"", kernel.nanoseconds(given, samples, 1), error * 1000.0 / 0.1});
    }
    c.panels[0].series.push_back(std::move(over_distance));
    c.panels[1].series.push_back(std::move(over_time));
    context.say(way.name);
  }
  c.notes.push_back("Near 0.1, far 1e6. Encoded on the device; 16 and 24 bits rounded on the processor: mote has depth32float only.");
  c.notes.push_back("Displacement: slopes of depth that differ by 0.1, 1000 pixels of focal length.");
  return c;
}

} // namespace mote::app
