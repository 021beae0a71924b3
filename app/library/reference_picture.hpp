// SPDX-License-Identifier: MIT
// The same picture from the reference tracer: no device, no graph, double precision, one sample a pixel,
// then the display transform on the CPU. `mote render --reference` and `mote compare --reference`.
#pragma once

#include "app/library/frame_renderer.hpp"
#include "app/library/job.hpp"

namespace mote::app {

// Fills what the job asks for; rgba8 or, with job.graph.deep, display. Throws Failure R001..R003, C00x.
DrawnPicture draw_reference(const Job& job, const ColorConfig& config, const DisplayOptions& display);

} // namespace mote::app
