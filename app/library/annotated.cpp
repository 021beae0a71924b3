// SPDX-License-Identifier: MIT
#include "app/library/annotated.hpp"

#include "core/overlay/annotate.hpp"

namespace mote::app {

DisplayTransform display_of(const ColorConfig& config, const DisplayOptions& display, const PassDisplay& pass) {
  DisplayRequest request;
  request.display = pass.display.empty() ? display.display : pass.display;
  request.view = pass.view.empty() ? display.view : pass.view;
  request.exposure = display.exposure + pass.exposure;
  request.exact = true; // apply() is exact in any case, and baking costs time
  return make_display_transform(config, request);
}

void annotate(DrawnPicture& picture, const Job& job, const DisplayTransform& display) {
  if (job.scene.annotations.empty()) return;
  const overlay::Layer layer = overlay::draw_annotations(job.scene, job.view(), picture.depth);
  if (!picture.rgba8.empty()) overlay::lay_over_display(layer, display, std::span<std::uint8_t>(picture.rgba8));
  if (!picture.display.empty()) overlay::lay_over_display(layer, display, std::span<float>(picture.display));
  if (!picture.linear.empty()) overlay::lay_over_linear(layer, std::span<float>(picture.linear));
}

} // namespace mote::app
