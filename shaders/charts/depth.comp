#version 460
// SPDX-License-Identifier: MIT
// Encodings of a distance z from near n to far f as a depth, one of them by ENCODING. Given: (z, n, f, 0); made: (depth, 0, 0, 0).
#include "charts/kernel.glsl"

void main() {
  uint i = item();
  if (i >= count) return;
  float n = given[i].y, f = given[i].z, sum = 0.0;
  uint k = 0u;
  do {
    float z = given[i].x + 1e-30 * float(k);
#if ENCODING == 0 // standard, as a projection matrix and the division give it
    sum += (f / (f - n) * z - f * n / (f - n)) / z;
#elif ENCODING == 1 // reverse, infinite far: mote's
    sum += n / z;
#elif ENCODING == 2 // linear
    sum += (z - n) / (f - n);
#elif ENCODING == 3 // linear, reversed
    sum += 1.0 - (z - n) / (f - n);
#elif ENCODING == 4 // logarithmic
    sum += log2(z / n) / log2(f / n);
#endif
    ++k;
  } while (k < repeats);
  made[i] = vec4(sum, 0.0, 0.0, 0.0);
}
