// SPDX-License-Identifier: MIT
// What topics that draw a scene share: the scene of the user or the topic's own, a picture by some graph and expansion, and
// what a frame of it costs.
#pragma once

#include "app/charts/topic.hpp"
#include "app/library/frame_renderer.hpp"
#include "core/compare/compare.hpp"
#include "core/reference/reference.hpp"

#include <string>
#include <vector>

namespace mote::app {

struct Method {
  std::string graph{"default"};
  std::vector<std::string> settings{}; // "pass.parameter=value"
  passes::Expansion expansion{passes::Expansion::Auto};
};

class SceneTopic {
public:
  // Throws Failure for a scene that cannot be drawn.
  explicit SceneTopic(TopicContext& context);

  Job job{}; // whoever changes job.scene does it before the first picture

  // Scene-linear color and, where asked, every AOV.
  DrawnPicture picture(const Method& method, bool aovs);
  // Of a frame with the display pass, AOVs and reading left out: the least of five after two, as other work only adds.
  double milliseconds(const Method& method);
  // Fragments that pass `opaque` runs in a frame; 0: the device does not count.
  std::uint64_t fragments(const Method& method);
  [[nodiscard]] View view() const { return job.view(); }
  // "spheres:1e4:fit, 320x180"
  [[nodiscard]] std::string text() const;

private:
  FrameRenderer& renderer(const Method& method, bool linear, bool aovs);

  TopicContext& context_;
  std::unique_ptr<FrameRenderer> renderer_{};
};

// Pictures as compare takes them; both scene-linear.
compare::CompareInput input_of(const DrawnPicture& picture, bool aovs);
compare::CompareInput input_of(const ReferencePicture& picture);

} // namespace mote::app
