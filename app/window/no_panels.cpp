// SPDX-License-Identifier: MIT
// Of builds with -DGUI=OFF.
#include "app/window/panels.hpp"

namespace mote::window {

std::unique_ptr<Panels> make_panels(gpu::Device) { return nullptr; }

} // namespace mote::window
