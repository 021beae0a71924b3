// SPDX-License-Identifier: MIT
// How much of a pixel a disc covers (method book, section 8.4): closed forms, no samples.
#ifndef MOTE_COVERAGE_GLSL
#define MOTE_COVERAGE_GLSL

// Of a unit square by the half-plane whose edge lies `inside` pixels from its center (positive: the center is covered),
// with unit normal n.
float half_plane_coverage(float inside, vec2 n) {
  vec2 m = abs(n);
  float big = max(m.x, m.y), small = max(min(m.x, m.y), 1e-4);
  float h = 0.5 * (big + small), k = 0.5 * (big - small);
  float s = clamp(inside, -h, h);
  float corner = 1.0 / (2.0 * big * small);
  return s < -k ? (s + h) * (s + h) * corner : s > k ? 1.0 - (h - s) * (h - s) * corner : 0.5 + s / big;
}

// Of a unit square by a disc of `radius` whose center lies `offset` pixels from the square's: below 0.85 pixels that
// of a square of equal area, whose overlaps are products; above, a half-plane with the outline's curvature.
float disc_coverage(vec2 offset, float radius, float inside, vec2 n) {
  float a = 0.5 * radius * 1.7724539; // half a side: sqrt(pi) / 2 radii
  vec2 overlap = clamp(min(offset + a, vec2(0.5)) - max(offset - a, vec2(-0.5)), vec2(0.0), vec2(1.0));
  return radius < 0.85 ? overlap.x * overlap.y : half_plane_coverage(inside - 1.0 / (24.0 * radius), n);
}

#endif
