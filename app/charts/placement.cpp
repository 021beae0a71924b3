// SPDX-License-Identifier: MIT
// Topic `placement`: a sphere of radius 1, 100 units before the eye, both W units from the world's origin. What its center in view
// space errs, in radii, on this device; with 1000 pixels of focal length a tenth of a radius is a pixel.
#include "app/charts/errors.hpp"
#include "app/charts/kernel.hpp"
#include "app/charts/random.hpp"
#include "app/charts/topic.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace mote::app {
namespace {

struct Way {
  int number; // METHOD of shaders/charts/placement.comp
  const char* name;
  bool baseline, wide;
};
constexpr std::array ways{Way{0, "world float32, 4x4 matrix", true, false},       Way{1, "world float32, minus the eye", true, false},
                          Way{2, "relative to the chunk (mote)", false, false},   Way{3, "two floats a coordinate", false, false},
                          Way{4, "two floats, not marked precise", true, false},  Way{5, "double", false, true}};
constexpr std::array offsets{1.0, 1e3, 1e4, 1e5, 1e6, 1e7};
constexpr double timed_offset = 1e6;
constexpr std::uint32_t particles = 20000;

// What float32 leaves over. Volatile, because g++ 12 at -O2 forgets the rounding where it makes two such conversions at once.
double rest(double value) {
  volatile float rounded = static_cast<float>(value);
  return value - static_cast<double>(rounded);
}
glm::dvec3 rest(const glm::dvec3& v) { return {rest(v.x), rest(v.y), rest(v.z)}; }

struct Cases {
  std::vector<float> given{};
  std::vector<glm::dvec3> exact{};
};

Cases make_cases(double offset) {
  Cases out;
  Random random(23);
  for (std::uint32_t i = 0; i < particles; ++i) {
    const glm::dvec3 origin = offset * random.direction(); // of the chunk
    const glm::vec3 local(4.0 * random.direction());
    const glm::dvec3 world = origin + glm::dvec3(local), to = random.direction(), eye = world - 100.0 * to;
    const glm::dvec3 right = glm::normalize(glm::cross(to, random.direction()));
    const std::array<glm::dvec3, 3> rows{right, glm::cross(to, right), to};
    glm::dvec3 exact(0), placed(0);
    for (int k = 0; k < 3; ++k) {
      exact[k] = glm::dot(rows[k], world - eye);
      placed[k] = glm::dot(rows[k], origin - eye);
    }
    auto add = [&](const glm::dvec3& v, double w = 0.0) {
      for (const double x : {v.x, v.y, v.z, w}) out.given.push_back(static_cast<float>(x));
    };
    add(world), add(rest(world)), add(glm::dvec3(local)), add(placed);
    for (const glm::dvec3& row : rows) add(row, -glm::dot(row, eye));
    add(eye), add(rest(eye));
    for (const glm::dvec3& row : rows) add(rest(row));
    out.exact.push_back(exact);
  }
  return out;
}

double p99(const Cases& cases, const std::vector<float>& made) {
  std::vector<double> errors;
  for (std::uint32_t i = 0; i < particles; ++i) {
    const float* v = &made[std::size_t{8} * i];
    errors.push_back(glm::length(glm::dvec3(v[0], v[1], v[2]) + glm::dvec3(v[4], v[5], v[6]) - cases.exact[i]));
  }
  return chart::percentile(std::move(errors), 0.99);
}

Kernel kernel_of(DrawingDevice& device, int method) {
  const std::array<gpu::ShaderDefine, 1> defines{{{"METHOD", std::to_string(method)}}};
  return Kernel(device, "charts/placement.comp", defines);
}

} // namespace

double placement_error(DrawingDevice& device, int method, double offset) {
  const Cases cases = make_cases(offset);
  return p99(cases, kernel_of(device, method).run(cases.given, particles, 2));
}

chart::Chart chart_placement(TopicContext& context) {
  chart::Chart c{.topic = "placement", .title = "Centers far from the origin of the world"};
  const chart::Axis error{"error of the center, p99", "radii", true};
  c.panels = {{"A sphere of radius 1 at distance 100", {"distance from the world's origin", "radii", true}, error, false, {}},
              {"What it costs, a million radii from the origin", {"time a particle", "ns", true}, error, true, {}}};
  std::vector<Cases> cases;
  for (const double offset : offsets) cases.push_back(make_cases(offset));
  for (const Way& way : ways) {
    if (way.wide && !gpu::has(context.device.device().features(), gpu::Feature::ShaderFloat64)) {
      c.notes.push_back(fmt::format("'{}' is left out: the device lacks shaderFloat64.", way.name));
      continue;
    }
    Kernel kernel = kernel_of(context.device, way.number);
    chart::Series over_offset{way.name, way.baseline, {}}, over_time = over_offset;
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      const double error_at = p99(cases[k], kernel.run(cases[k].given, particles, 2));
      over_offset.points.push_back({fmt::format("W = {:g}", offsets[k]), offsets[k], error_at});
      if (offsets[k] == timed_offset) over_time.points.push_back({"", kernel.nanoseconds(cases[k].given, particles, 2), error_at});
    }
    c.panels[0].series.push_back(std::move(over_offset));
    c.panels[1].series.push_back(std::move(over_time));
    context.say(way.name);
  }
  c.notes.push_back(fmt::format("{} particles a point; 0.1 radii are one pixel at 1000 pixels of focal length.", particles));
  return c;
}

} // namespace mote::app
