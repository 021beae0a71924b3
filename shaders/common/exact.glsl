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

// a.b as if formed in twice the precision and rounded once: products by Dekker's split, sums by Knuth's two-sum.
float dot_exact(vec3 a, vec3 b) {
  precise vec3 ah = hi12(a), bh = hi12(b);
  precise vec3 al = a - ah, bl = b - bh;
  precise vec3 p = a * b;
  precise vec3 e = ((ah * bh - p) + ah * bl + al * bh) + al * bl;
  precise float s1 = p.x + p.y;
  precise float t1 = s1 - p.x;
  precise float r1 = (p.x - (s1 - t1)) + (p.y - t1);
  precise float s2 = s1 + p.z;
  precise float t2 = s2 - s1;
  precise float r2 = (s1 - (s2 - t2)) + (p.z - t2);
  return s2 + (r1 + r2 + e.x + e.y + e.z);
}

#endif
