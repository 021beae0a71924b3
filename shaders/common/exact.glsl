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
// The parameter is x + y, x with 12 bits and y small.
void shift_in_parts(vec3 f, vec3 d, out vec3 nearest, out vec2 parameter) {
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
  parameter = vec2(s, -(e1 + e2));
}
void shift_to_nearest(vec3 f, vec3 d, out vec3 nearest, out float parameter) {
  vec2 parts;
  shift_in_parts(f, d, nearest, parts);
  parameter = parts.x + parts.y;
}

void two_sum(vec3 a, vec3 b, out vec3 sum, out vec3 rest) {
  precise vec3 s = a + b, t = s - a;
  precise vec3 e = (a - (s - t)) + (b - t);
  sum = s;
  rest = e;
}

// The same to 2^-36 of |f|, as a sum of two floats: `nearest` has its own rounding alone, whatever the distance, and `rest` is what that took. f
// comes as f + f_rest. The step that takes out what the 12 bits left has 12 bits itself, so that its products are exact, too.
void shift_in_pairs(vec3 f, vec3 f_rest, vec3 d, out vec3 nearest, out vec3 rest, out vec2 parameter) {
  float ia = 1.0 / dot(d, d);
  precise float s = hi12(-dot(f, d) * ia);
  precise vec3 dh = hi12(d);
  precise vec3 dl = d - dh;
  vec3 a, a_low, b, b_low, c, c_low;
  two_sum(dh * s, f, a, a_low);
  two_sum(a, dl * s, b, b_low);
  precise float e1 = hi12(-dot(b, d) * ia);
  two_sum(b, dh * e1, c, c_low);
  precise vec3 low = ((a_low + b_low) + (c_low + f_rest)) + dl * e1;
  precise float e2 = -dot(c + low, d) * ia;
  low = low + d * e2;
  precise vec3 rounded = c + low;
  rest = low - (rounded - c);
  nearest = rounded;
  parameter = vec2(s, e1 + e2);
}

// Numbers of twice the precision: the unevaluated sum x + y of two floats, |y| at most half an ulp of x. Products by
// Dekker's split, sums by Knuth's two-sum; each operation errs by a few 2^-46.
vec2 two_sum(float a, float b) {
  precise float s = a + b;
  precise float t = s - a;
  precise float e = (a - (s - t)) + (b - t);
  return vec2(s, e);
}
vec2 two_product(float a, float b) {
  precise float p = a * b;
  precise float ah = hi12(a), bh = hi12(b);
  precise float al = a - ah, bl = b - bh;
  precise float e = ((ah * bh - p) + ah * bl + al * bh) + al * bl;
  return vec2(p, e);
}
vec2 normal_pair(float x, float y) { // |x| >= |y|
  precise float s = x + y;
  precise float e = y - (s - x);
  return vec2(s, e);
}
vec2 times(vec2 a, vec2 b) {
  precise vec2 p = two_product(a.x, b.x);
  precise float low = p.y + (a.x * b.y + a.y * b.x);
  return normal_pair(p.x, low);
}
vec2 minus(vec2 a, vec2 b) {
  precise vec2 s = two_sum(a.x, -b.x);
  precise float low = s.y + (a.y - b.y);
  return normal_pair(s.x, low);
}
vec2 divided(vec2 a, vec2 b) {
  precise float high = a.x / b.x;
  precise vec2 back = two_product(high, b.x);
  precise float low = (((a.x - back.x) - back.y) + (a.y - high * b.y)) / b.x;
  return normal_pair(high, low);
}
// (a + a_rest) . (b + b_rest)
vec2 dot_pair(vec3 a, vec3 a_rest, vec3 b, vec3 b_rest) {
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
  precise float low = r1 + r2 + e.x + e.y + e.z + (dot(a, b_rest) + dot(a_rest, b));
  return normal_pair(s2, low);
}

// s (d + d_rest) - (m + m_rest), as a sum of two floats: products and the first difference are exact.
void along_minus(vec2 s, vec3 d, vec3 d_rest, vec3 m, vec3 m_rest, out vec3 rounded, out vec3 rest) {
  precise vec3 p = s.x * d;
  float sh = hi12(s.x);
  float sl = s.x - sh;
  precise vec3 dh = hi12(d);
  precise vec3 dl = d - dh;
  precise vec3 e = ((sh * dh - p) + sh * dl + sl * dh) + sl * dl;
  precise vec3 l = p - m;
  precise vec3 t = l - p;
  precise vec3 r = (p - (l - t)) - (m + t);
  precise vec3 low = r + e + (s.x * d_rest + s.y * d - m_rest);
  precise vec3 sum = l + low;
  rest = low - (sum - l);
  rounded = sum;
}
vec3 along_minus(vec2 s, vec3 d, vec3 d_rest, vec3 m, vec3 m_rest) { // rounded once
  vec3 rounded, rest;
  along_minus(s, d, d_rest, m, m_rest, rounded, rest);
  return rounded;
}

#endif
