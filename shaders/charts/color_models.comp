#version 460
// SPDX-License-Identifier: MIT
// RGB through another color model and back, one of them by MODEL, its numbers rounded to some bits between; with WIDE in double.
// Given: (r, g, b, bits), 0 bits: no rounding. Made: (r, g, b, 0).
#include "charts/kernel.glsl"
#ifdef WIDE
#define real double
#define real3 dvec3
#define real4 dvec4
#else
#define real float
#define real3 vec3
#define real4 vec4
#endif

// BT.601 or BT.709
#if MODEL == 6 || MODEL == 7
const real kr = real(2126) / real(10000), kb = real(722) / real(10000);
#else
const real kr = real(299) / real(1000), kb = real(114) / real(1000);
#endif

real4 encode(real3 c) {
#if MODEL == 1 // CMY
  return real4(real3(1) - c, 0);
#elif MODEL == 2 // CMYK
  real k = real(1) - max(c.r, max(c.g, c.b));
  return k >= real(1) ? real4(0, 0, 0, 1) : real4((real3(1) - c - real3(k)) / (real(1) - k), k);
#elif MODEL == 3 // HSV
  real high = max(c.r, max(c.g, c.b)), range = high - min(c.r, min(c.g, c.b)), h = real(0);
  if (range > real(0)) {
    if (high == c.r) h = (c.g - c.b) / range;
    else if (high == c.g) h = (c.b - c.r) / range + real(2);
    else h = (c.r - c.g) / range + real(4);
    h = h < real(0) ? h + real(6) : h;
  }
  return real4(h / real(6), high > real(0) ? range / high : real(0), high, 0);
#else // Y'UV, Y'CbCr: differences moved to 0..1
  real y = kr * c.r + (real(1) - kr - kb) * c.g + kb * c.b;
#if MODEL == 4 // analog U = 0.492 (B - Y), V = 0.877 (R - Y)
  return real4(y, real(492) / real(1000) * (c.b - y) / (real(2) * real(436) / real(1000)) + real(0.5), real(877) / real(1000) * (c.r - y) / (real(2) * real(615) / real(1000)) + real(0.5), 0);
#else
  real4 full = real4(y, (c.b - y) / (real(2) * (real(1) - kb)) + real(0.5), (c.r - y) / (real(2) * (real(1) - kr)) + real(0.5), 0);
#if MODEL == 7 // limited range
  return real4((real(16) + real(219) * full.x) / real(255), (real(16) + real(224) * full.y) / real(255), (real(16) + real(224) * full.z) / real(255), 0);
#else
  return full;
#endif
#endif
#endif
}

real3 decode(real4 m) {
#if MODEL == 1
  return real3(1) - m.xyz;
#elif MODEL == 2
  return (real3(1) - m.xyz) * (real(1) - m.w);
#elif MODEL == 3
  real3 h = abs(real3(m.x * real(6)) - real3(3, 2, 4));
  real3 hue = clamp(real3(h.x - real(1), real(2) - h.y, real(2) - h.z), real3(0), real3(1));
  return m.z * (real3(1) + m.y * (hue - real3(1)));
#else
#if MODEL == 7
  m.x = (m.x * real(255) - real(16)) / real(219);
  m.yz = (m.yz * real(255) - real(16)) / real(224);
#endif
  m.yz -= real(0.5);
#if MODEL == 4
  real b = m.x + m.y * (real(2) * real(436) / real(1000)) / (real(492) / real(1000)), r = m.x + m.z * (real(2) * real(615) / real(1000)) / (real(877) / real(1000));
#else
  real b = m.x + m.y * (real(2) * (real(1) - kb)), r = m.x + m.z * (real(2) * (real(1) - kr));
#endif
  return real3(r, (m.x - kr * r - kb * b) / (real(1) - kr - kb), b);
#endif
}

void main() {
  uint i = item();
  if (i >= count) return;
  float bits = given[i].w;
  // Codes of full range fill all bits; those of limited range are 8-bit ones times a power of two.
#if MODEL == 7
  real steps = real(255) * real(exp2(bits - 8.0));
#else
  real steps = real(exp2(bits) - 1.0);
#endif
  vec3 sum = vec3(0.0);
  uint k = 0u;
  do {
    real4 m = encode(real3(given[i].rgb) + real3(real(1e-9) * real(k)));
    if (bits > 0.0) m = floor(clamp(m, real4(0), real4(1)) * steps + real4(0.5)) / steps;
    sum += vec3(clamp(decode(m), real3(0), real3(1)) - real3(given[i].rgb)); // the difference: it needs no more than float32
    ++k;
  } while (k < repeats);
  made[i] = vec4(sum, 0.0);
}
