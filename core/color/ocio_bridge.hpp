// SPDX-License-Identifier: MIT
// The only header that names OpenColorIO; private to core/color. It turns OCIO's exceptions into
// Failures and catches OCIO's log, which would otherwise go to stderr.
#pragma once

#include "core/color/color_config.hpp"

#include <OpenColorIO/OpenColorIO.h>

#include <string>
#include <utility>
#include <vector>

namespace mote {

namespace OCIO = OCIO_NAMESPACE;

struct ColorConfig::Inner {
  OCIO::ConstConfigRcPtr config{};
  std::string origin{}, working_space{};
  bool working_is_rec709{}; // the working space was found by name, not by the scene_linear role
  std::vector<std::string> messages{};
};

// Runs `f`, with OCIO's log caught in `log` (when given) and its exceptions turned into Failure
// `code` with the text "<what>: <OCIO's text>".
template <class F>
auto with_ocio(std::string_view code, const SourceLoc& loc, const std::string& what, F&& f);

void catch_ocio_log();                       // once per process; idempotent
std::vector<std::string> take_ocio_log();    // the lines since the last call on this thread
std::string one_line(std::string_view text); // OCIO's texts may have line ends

template <class F>
auto with_ocio(std::string_view code, const SourceLoc& loc, const std::string& what, F&& f) {
  catch_ocio_log();
  try {
    return std::forward<F>(f)();
  } catch (const OCIO::Exception& e) {
    fail(Exit::BadInput, code, loc, what + ": " + one_line(e.what()));
  }
}

} // namespace mote
