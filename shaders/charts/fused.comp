#version 460
// SPDX-License-Identifier: MIT
// Whether fma() of this device rounds once: (1 + 2^-12)^2 - (1 + 2^-11) is 2^-24 then, and 0 where it multiplies and adds.
// Given: (a, b, c, 0), through a buffer, so that no compiler folds it.
#include "charts/kernel.glsl"

void main() {
  uint i = item();
  if (i >= count) return;
  made[i] = vec4(fma(given[i].x, given[i].y, given[i].z), 0.0, 0.0, 0.0);
}
