// SPDX-License-Identifier: MIT
// How large a point of Topology::PointList may be. WebGPU's points are one pixel; native devices have more,
// within limits of their own. A vertex stage that writes gl_PointSize asks here first.
#pragma once

namespace mote::gpu {

class Device;

// Largest gl_PointSize in pixels; 1 where the device has no large points. 0 for an empty handle.
float max_point_size(const Device& device);

} // namespace mote::gpu
