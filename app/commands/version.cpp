// SPDX-License-Identifier: MIT
// What this program is made of.
#include "app/commands/command.hpp"
#include "app/library/version.hpp"

#include <fmt/format.h>

namespace mote::app {

std::string version_text() { return fmt::format("mote {}", version_string()); }

std::string long_version_text() {
  return fmt::format("{}\ncompiled by {} ({})", version_text(), MOTE_COMPILER, MOTE_BUILD_TYPE);
}

} // namespace mote::app
