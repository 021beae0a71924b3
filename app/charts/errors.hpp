// SPDX-License-Identifier: MIT
// What single methods of the topics `sphere`, `placement` and `depth` err on a device: the numbers behind the charts, asked for
// one by one by tests/stability. Defined beside their topics.
#pragma once

#include "app/library/device.hpp"

#include <cstdint>

namespace mote::app {

struct SphereErrors {
  double normal{}, ulps{}, missed{}; // p99 in rad, p99 in float32 spacings at t, percent of the rays that hit
};
// `form`: FORM of shaders/charts/sphere_forms.glsl; 10 needs shaderFloat64. `kappa`: distance / radius.
SphereErrors sphere_errors(DrawingDevice& device, int form, double kappa, bool grazing);

// p99 error of a center in radii, `offset` radii from the world's origin. `method`: METHOD of shaders/charts/placement.comp.
double placement_error(DrawingDevice& device, int method, double offset);

// p99 relative error of a distance of near * 10^decade read back. `encoding`: of shaders/charts/depth.comp; `bits` 0: float32.
double depth_error(DrawingDevice& device, int encoding, int bits, double decade);

} // namespace mote::app
