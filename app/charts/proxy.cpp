// SPDX-License-Identifier: MIT
// Topic `proxy`: how a particle becomes fragments. First what mote's expansions cost and whether a pixel of theirs is wrong
// (there must be none), then what simpler outlines of a sphere on the image lose or waste: those are geometry, no pictures.
#include "app/charts/outlines.hpp"
#include "app/charts/scene_topic.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::app {
namespace {

using passes::Expansion;

chart::Panel expansions(TopicContext& context, SceneTopic& topic, chart::Chart& c) {
  chart::Panel panel{"Expansions: pixels that show another particle than the reference", {"time a frame", "ms", true}, {"wrong pixels", "", true}, true, {}};
  ReferenceOptions options;
  options.normals = options.colors = false;
  const compare::CompareInput reference = input_of(render_reference(topic.job.scene, topic.view(), options));
  for (const Expansion expansion : {Expansion::Vertex, Expansion::Geometry, Expansion::Point, Expansion::Compute}) {
    const std::string name(passes::to_string(expansion));
    try {
      const Method method{.expansion = expansion};
      const compare::CompareResult result = compare::compare(input_of(topic.picture(method, true), true), reference);
      panel.series.push_back({name, false, {{"", topic.milliseconds(method), static_cast<double>(result.id->all())}}});
    } catch (const Failure& failure) { // P001: says what the device lacks
      c.notes.push_back(fmt::format("'{}' is left out: {}", name, failure.diagnostic().text));
    }
    context.say(name);
  }
  return panel;
}

// Cylinders by the rectangle around each and by the faces of the box around it that are seen.
chart::Panel cylinders(TopicContext& context, chart::Chart& c) {
  TopicContext sticks{context.device, context.config, context.request, context.say};
  sticks.request.words = {"sticks:2e3:fit"};
  sticks.request.settings.clear();
  SceneTopic topic(sticks);
  chart::Panel panel{"Cylinders: rectangle or box (" + topic.text() + ")", {"time a frame", "ms", true}, {"fragments a covered pixel", "", false}, true, {}};
  struct Named {
    std::string name;
    Method method;
  };
  const std::vector<Named> methods{{"rectangle, vertex", {.expansion = Expansion::Vertex}},
                                   {"rectangle, geometry", {.expansion = Expansion::Geometry}},
                                   {"box, geometry", {.settings = {"opaque.proxy=box"}, .expansion = Expansion::Geometry}}};
  const DrawnPicture plain = topic.picture(methods.front().method, true);
  const auto covered = std::count_if(plain.id.begin(), plain.id.end(), [](std::uint32_t id) { return id != reference_no_id; });
  for (const Named& m : methods) {
    const std::uint64_t fragments = topic.fragments(m.method);
    if (fragments == 0) {
      c.notes.push_back("the device does not count fragments: cylinders are left out");
      return panel;
    }
    const DrawnPicture picture = topic.picture(m.method, true);
    if (picture.id != plain.id) c.notes.push_back(fmt::format("'{}' shows other particles than '{}'", m.name, methods.front().name));
    panel.series.push_back({m.name, false, {{"", topic.milliseconds(m.method), double(fragments) / double(std::max<std::ptrdiff_t>(covered, 1))}}});
    context.say(m.name);
  }
  return panel;
}

} // namespace

chart::Chart chart_proxy(TopicContext& context) {
  SceneTopic topic(context);
  chart::Chart c{.topic = "proxy", .title = "How particles become fragments"};
  c.panels.push_back(expansions(context, topic, c));
  c.panels.push_back(cylinders(context, c));
  for (const double degrees : {0.0, 30.0}) c.panels.push_back(outline_panel(degrees));
  c.notes.push_back(fmt::format("{}; outlines: by counting 500 x 500 places on the image in double precision.", topic.text()));
  return c;
}

} // namespace mote::app
