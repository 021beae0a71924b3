// SPDX-License-Identifier: MIT
// A job from a scene that is described already: the window's, whose text may differ from any file. The rest is as in job.hpp.
#pragma once

#include "app/library/job.hpp"

namespace mote::app {

// `request` gives everything but words and settings of the scene. With errors in `diagnostics` the job must not be run.
Job load_described(SceneDesc desc, const JobRequest& request, Diagnostics& diagnostics);

} // namespace mote::app
