// SPDX-License-Identifier: MIT
// Error-free pieces for ray casting in float32: methods with a plain, unfused multiply-add, so that
// they hold on every Vulkan device (fma() need not be fused).
#ifndef MOTE_EXACT_GLSL
#define MOTE_EXACT_GLSL

// The upper 12 bits of the significand: products of two such numbers are exact in float32.
float hi12(float x) { return uintBitsToFloat(floatBitsToUint(x) & 0xFFFFF000u); }
vec3 hi12(vec3 v) { return uintBitsToFloat(floatBitsToUint(v) & uvec3(0xFFFFF000u)); }

// Point of the ray f + t d nearest to the origin, and its parameter: form N of the method book (Dekker's split,
// 1971): s has 12 bits, all four products are exact, two re-orthogonalizations take the rest out. Normals from
// `nearest` err by 3e-7 rad whatever the distance, where the plain form loses the ratio distance / radius.
void shift_to_nearest(vec3 f, vec3 d, out vec3 nearest, out float parameter) {
  float ia = 1.0 / dot(d, d);
  precise float s = hi12(-dot(f, d) * ia);
  precise vec3 dh = hi12(d);
  precise vec3 dl = d - dh;
  precise vec3 l = (dh * s + f) + dl * s;
  precise float e1 = dot(l, d) * ia;
  l = l - d * e1;
  precise float e2 = dot(l, d) * ia;
  l = l - d * e2;
  nearest = l;
  parameter = s - (e1 + e2);
}

#endif
