// SPDX-License-Identifier: MIT
// Topic `sampling`: places of samples in the pixel, and outlines blended in closed form, against the average over the pixel.
#include "app/charts/scene_topic.hpp"

#include <fmt/format.h>

namespace mote::app {
namespace {

constexpr unsigned reference_side = 10; // squared samples a pixel

} // namespace

chart::Chart chart_sampling(TopicContext& context) {
  SceneTopic topic(context);
  chart::Chart c{.topic = "sampling", .title = "Samples a pixel against the average over the pixel"};
  c.panels = {{"Color of all pixels", {"time a frame", "ms", true}, {"color error, RMS", "steps of 255", true}, true, {}}};
  const reference::World world = reference::build_world(topic.job.scene);
  compare::CompareInput reference;
  reference.width = topic.job.size.width;
  reference.height = topic.job.size.height;
  reference.encoding = compare::Encoding::Linear;
  for (const glm::dvec4& color : render_reference_area(world, topic.view(), reference_side, {.shadows = false})) reference.color.emplace_back(color);
  context.say("reference");
  auto add = [&](chart::Series& series, const std::string& parameter, const std::vector<std::string>& settings) {
    const Method method{.settings = settings};
    const compare::CompareResult result = compare::compare(input_of(topic.picture(method, false), false), reference);
    series.points.push_back({parameter, topic.milliseconds(method), result.color->rms});
    context.say(series.method + " " + parameter);
  };
  for (const char* pattern : {"regular", "jittered", "poisson", "random"}) {
    chart::Series series{pattern, std::string_view(pattern) == "random", {}};
    for (const int n : {1, 4, 9, 16})
      add(series, fmt::format("n = {}", n), {fmt::format("opaque.samples={{ pattern = \"{}\", n = {} }}", pattern, n)});
    c.panels[0].series.push_back(std::move(series));
  }
  chart::Series analytic{"analytic edges", false, {}};
  add(analytic, "", {"opaque.edges=\"analytic\""});
  c.panels[0].series.push_back(std::move(analytic));
  c.notes.push_back(fmt::format("{}; reference: {} samples a pixel in double precision.", topic.text(), reference_side * reference_side));
  return c;
}

} // namespace mote::app
