// SPDX-License-Identifier: MIT
// Particle types from files, between the scene that names them and the passes that draw them: makes them known, lets a device of
// their own measure their particles, leaves out the data sets of those that are broken. Called when a scene was read and before it is
// realized; opens that device only when a type is measured.
#pragma once

#include "app/library/device.hpp"
#include "core/scene/scene_file.hpp"

namespace mote::app {

// Errors of types (P022) go to `left_out`: their data sets are taken out of the scene, the rest is drawn.
void take_types(SceneDesc& desc, const DeviceOptions& device, Diagnostics& left_out);

// The same messages where nothing ends with a status.
Diagnostics as_warnings(const Diagnostics& left_out);

} // namespace mote::app
