// SPDX-License-Identifier: MIT
// The version, from the build's PROJECT_VERSION.
#pragma once

#include <string_view>

namespace mote::app {

constexpr std::string_view version_string() { return MOTE_VERSION; }

} // namespace mote::app
