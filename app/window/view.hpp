// SPDX-License-Identifier: MIT
// The whole of `mote view`: from what the command line said to a window and its end. Throws Failure.
#pragma once

#include "app/library/frame_renderer.hpp"
#include "app/library/job.hpp"

#include <functional>
#include <string>

namespace mote::window {

struct ViewRequest {
  app::JobRequest job{};
  app::DeviceOptions device{};
  app::DisplayOptions display{};
  passes::Expansion expansion{};
  std::string script{};  // a file; empty: a hand
  std::string version{}; // "mote 0.1.0"
  bool report{};         // print how long inputs waited
};

// `told` gets the diagnostics of the start, errors included, before anything opens; it does not return when there are errors.
void run_view(const ViewRequest& request, const std::function<void(const Diagnostics&)>& told);

} // namespace mote::window
