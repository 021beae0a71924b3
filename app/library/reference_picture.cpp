// SPDX-License-Identifier: MIT
#include "app/library/reference_picture.hpp"

#include "core/color/display_transform.hpp"
#include "core/color/srgb.hpp"
#include "core/reference/reference.hpp"

#include <algorithm>

namespace mote::app {

DrawnPicture draw_reference(const Job& job, const ColorConfig& config, const DisplayOptions& display) {
  auto wanted = [&](Aov aov) { return job.graph.every_aov || std::find(job.graph.aovs.begin(), job.graph.aovs.end(), aov) != job.graph.aovs.end(); };
  ReferenceOptions options;
  options.ids = wanted(Aov::Id);
  options.normals = wanted(Aov::Normal);
  options.ambiguity = false;
  options.two_surfaces = !has_front_surfaces_only(job.graph);
  const ReferencePicture traced = render_reference(job.scene, job.view(), options);

  DrawnPicture picture;
  picture.size = traced.size;
  for (const glm::dvec4& c : traced.color)
    for (int k = 0; k < 4; ++k) picture.linear.push_back(static_cast<float>(c[k]));
  DisplayRequest request;
  request.display = display.display;
  request.view = display.view;
  request.exposure = display.exposure;
  request.exact = true;
  picture.display = picture.linear;
  make_display_transform(config, request).apply(picture.display);
  if (!job.graph.deep) {
    picture.rgba8.resize(picture.display.size());
    std::transform(picture.display.begin(), picture.display.end(), picture.rgba8.begin(), [](float v) { return to_8bit(v); });
  }
  if (wanted(Aov::Depth) || job.graph.depth_if_made) picture.depth.assign(traced.depth.begin(), traced.depth.end());
  if (wanted(Aov::Id)) picture.id = traced.id;
  if (wanted(Aov::Normal))
    for (const glm::dvec3& n : traced.normal)
      for (int k = 0; k < 3; ++k) picture.normal.push_back(static_cast<float>(n[k]));
  return picture;
}

} // namespace mote::app
