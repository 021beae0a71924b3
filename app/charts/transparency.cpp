// SPDX-License-Identifier: MIT
// Topic `transparency`: orders and order-independent sums against every surface in its place. The first panel draws a scene of
// particles of alpha 0.5; the second blends random stacks of layers on the processor, for methods that no pass of mote has.
#include "app/charts/scene_topic.hpp"
#include "app/charts/stacks.hpp"

#include <fmt/format.h>

namespace mote::app {

chart::Chart chart_transparency(TopicContext& context) {
  SceneTopic topic(context);
  for (Batch& batch : topic.job.scene.batches) batch.alpha = std::min(batch.alpha, 0.5);
  topic.job.scene.background = glm::dvec4(1);
  chart::Chart c{.topic = "transparency", .title = "Transparent particles against every surface in its place"};
  chart::Panel panel{"A scene of particles of alpha 0.5", {"time a frame", "ms", true}, {"color error, RMS", "steps of 255", true}, true, {}};
  ReferenceOptions options;
  options.normals = false;
  const compare::CompareInput reference = input_of(render_reference(topic.job.scene, topic.view(), options));
  context.say("reference");
  struct Way {
    const char* name;
    bool baseline;
    const char* setting;
  };
  for (const Way& way : {Way{"exact lists (mote)", false, "glyphs.oit=\"exact\""}, Way{"one order, back to front (mote)", false, "glyphs.order=\"back_to_front\""},
                         Way{"one order, front to back", false, "glyphs.order=\"front_to_back\""}, Way{"weighted sums", true, "glyphs.oit=\"weighted\""},
                         Way{"order of the file", true, "glyphs.order=\"file\""}}) {
    const Method method{.graph = "transparent", .settings = {way.setting}};
    compare::CompareInput drawn = input_of(topic.picture(method, false), false);
    const compare::CompareResult result = compare::compare(drawn, reference);
    panel.series.push_back({way.name, way.baseline, {{"", topic.milliseconds(method), result.color->rms}}});
    context.say(way.name);
  }
  c.panels.push_back(std::move(panel));
  c.panels.push_back(stack_panel());
  c.notes.push_back(topic.text() + "; stacks: 400 of each kind, saturated colors over white; times of one processor core.");
  return c;
}

} // namespace mote::app
