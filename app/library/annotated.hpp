// SPDX-License-Identifier: MIT
// Legends, scale bars, times and cells over a picture that is drawn: what core/overlay draws, laid over every array
// of colors that the picture holds. Depth, id and normal stay as they are. Called once a picture, whoever drew it.
#pragma once

#include "app/library/frame_renderer.hpp"
#include "app/library/job.hpp"
#include "core/color/display_transform.hpp"

namespace mote::app {

// The transform that a picture is displayed with: what the display pass of its graph says wins over `display`.
DisplayTransform display_of(const ColorConfig& config, const DisplayOptions& display, const PassDisplay& pass);

// Nothing happens to scenes without annotations.
void annotate(DrawnPicture& picture, const Job& job, const DisplayTransform& display);

} // namespace mote::app
