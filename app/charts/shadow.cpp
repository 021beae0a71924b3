// SPDX-License-Identifier: MIT
// Topic `shadow`: maps of casters and of depths, of several sizes. Wrong is a pixel that faces the light and shows it where the
// reference's shadow ray is blocked, or the reverse.
#include "app/charts/scene_topic.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::app {
namespace {

// Green of each pixel with the shadowing light: with its shadows, without them, and without that light.
struct Truth {
  std::vector<double> shadowed{}, lit{}, dark{};
  std::vector<bool> counts{};
};

Truth trace(const Scene& scene, const View& view) {
  auto greens = [](const ReferencePicture& p) {
    std::vector<double> out;
    for (const glm::dvec4& c : p.color) out.push_back(c.g);
    return out;
  };
  ReferenceOptions options;
  options.normals = false;
  const ReferencePicture with = render_reference(scene, view, options);
  options.ambiguity = options.shadows = false;
  Truth t{greens(with), greens(render_reference(scene, view, options)), {}, {}};
  Scene dark = scene;
  for (Light& light : dark.lights)
    if (light.shadows) light.intensity = 0.0;
  t.dark = greens(render_reference(dark, view, options));
  for (std::size_t i = 0; i < t.lit.size(); ++i) t.counts.push_back(with.id[i] != reference_no_id && !with.ambiguous[i] && t.lit[i] - t.dark[i] >= 4e-3);
  return t;
}

double percent_wrong(const Truth& t, const DrawnPicture& picture) {
  std::size_t wrong = 0, all = 0;
  for (std::size_t i = 0; i < t.lit.size(); ++i) {
    if (!t.counts[i]) continue;
    const double middle = 0.5 * (t.lit[i] + t.dark[i]);
    ++all;
    wrong += (static_cast<double>(picture.linear[4 * i + 1]) < middle) != (t.shadowed[i] < middle);
  }
  return 100.0 * static_cast<double>(wrong) / static_cast<double>(std::max<std::size_t>(all, 1));
}

struct Way {
  const char* name;
  bool baseline;
  std::vector<std::string> settings;
};

} // namespace

chart::Chart chart_shadow(TopicContext& context) {
  SceneTopic topic(context);
  auto& lights = topic.job.scene.lights;
  if (std::none_of(lights.begin(), lights.end(), [](const Light& l) { return l.shadows; }))
    lights = {{.name = "sun", .kind = LightKind::Directional, .direction = glm::normalize(glm::dvec3(1, 0.4, -0.3)), .intensity = 0.8, .shadows = true}};
  chart::Chart c{.topic = "shadow", .title = "Shadow maps against shadow rays"};
  c.panels = {{"Pixels that face the light", {"time a frame", "ms", true}, {"wrongly lit or shadowed", "%", true}, true, {}}};
  const Truth truth = trace(topic.job.scene, topic.view());
  context.say("reference");
  const std::vector<Way> ways{{"casters of 2x2 texels (mote)", false, {"shadow.method=\"ids\""}},
                              {"depths, normal offset, 3x3", false, {"shadow.method=\"depth\"", "shadow.pcf=1"}},
                              {"depths, normal offset, 1 texel", true, {"shadow.method=\"depth\"", "shadow.pcf=0"}},
                              {"depths, no offset", true, {"shadow.method=\"depth\"", "shadow.pcf=0", "shadow.normal_offset=0"}}};
  for (const Way& way : ways) {
    chart::Series series{way.name, way.baseline, {}};
    for (const int size : {256, 512, 1024, 2048}) {
      Method method{.graph = "shadowed", .settings = way.settings};
      method.settings.push_back(fmt::format("shadow.size={}", size));
      const double wrong = percent_wrong(truth, topic.picture(method, false));
      series.points.push_back({fmt::format("{}", size), topic.milliseconds(method), wrong});
    }
    c.panels[0].series.push_back(std::move(series));
    context.say(way.name);
  }
  c.notes.push_back(topic.text() + "; at the points: texels a side of the map.");
  return c;
}

} // namespace mote::app
