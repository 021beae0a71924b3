#version 460
// SPDX-License-Identifier: MIT
// Given per item: (center, radius), (direction, 0), (x, q.x), (y, q.y). Made: (normal, t), (their rests beyond float32);
// t = 0 for a miss.
#include "charts/kernel.glsl"
#include "charts/sphere_forms.glsl"

void main() {
  uint i = item();
  if (i >= count) return;
  vec4 a = given[4u * i], b = given[4u * i + 1u], c = given[4u * i + 2u], d = given[4u * i + 3u];
  Given g = Given(a.xyz, a.w, b.xyz, c.xyz, d.xyz, vec2(c.w, d.w));
  vec4 high = vec4(0.0), low = vec4(0.0);
  uint k = 0u;
  do {
    Given turned = g;
    turned.direction.x += 1e-9 * float(k);
    turned.q.x += 1e-9 * float(k);
    Hit h = solve(turned);
    high += h.hit ? vec4(h.normal, h.t) : vec4(0.0);
    low += h.hit ? vec4(h.normal_low, h.t_low) : vec4(0.0);
    ++k;
  } while (k < repeats);
  made[2u * i] = high;
  made[2u * i + 1u] = low;
}
