// SPDX-License-Identifier: MIT
// The OpenColorIO config that mote ships, as text (profile 2.1, so OCIO 2.1 and newer read it). It
// names no file, so it works from memory and on any machine. `mote --ocio FILE` or $OCIO replace it.
#pragma once

#include <string_view>

namespace mote {

std::string_view default_color_config();

} // namespace mote
