// SPDX-License-Identifier: MIT
// What a picture says about itself, in PNG text and EXR attributes: everything that another run needs to make the
// same picture. No time, no host, and nothing of how the work was shared out, so that equal input gives
// equal files.
#pragma once

#include "app/library/job.hpp"
#include "app/library/picture.hpp"

#include <string>

namespace mote::app {

// `command`: a command line that draws this one picture; `drawn_by`: the device; `display`: the view transform.
Provenance provenance_of(const Job& job, const std::string& version, const std::string& command, const std::string& drawn_by,
                         const std::string& display);

// The camera as the picture's text "Camera" has it.
std::string camera_text(const Camera& camera);

// A word as a shell takes it: quoted where that is needed.
std::string quoted(const std::string& word);

} // namespace mote::app
