// SPDX-License-Identifier: MIT
// Frame of the kernels behind `mote chart` and tests/stability: one invocation an item, `given` and `made` as the topic
// says. `repeats` runs the arithmetic that often on slightly different input, to be timed; 1 where results count.
#ifndef MOTE_CHART_KERNEL_GLSL
#define MOTE_CHART_KERNEL_GLSL

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { vec4 given[]; };
layout(set = 0, binding = 1, std430) buffer Out { vec4 made[]; };
layout(push_constant) uniform Push {
  uint count;
  uint repeats;
};

uint item() { return gl_GlobalInvocationID.x; }

#endif
