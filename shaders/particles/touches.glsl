// SPDX-License-Identifier: MIT
// Whether a long particle may touch a tile: the rectangle that it is filed under has corners that it does not reach. What
// lies within `radius` of a segment, against a circle around the tile. Never false for a particle that covers a pixel.
#ifndef MOTE_TOUCHES_GLSL
#define MOTE_TOUCHES_GLSL

// `middle`, `reach`: the circle, in tangents (orthographic: world units). A ball at depth z and distance d covers at most
// r d / (z^2 - r^2) around its center's projection, which its own ellipse's center misses by up to r / z of that (method
// book, section 4.1). Segments that come near the eye touch everything.
bool segment_touches(vec3 center, vec3 h, float radius, vec2 middle, float reach) {
  vec3 a = center - h, b = center + h;
  float z = min(a.z, b.z), d = max(length(a), length(b));
  float r = radius * 1.0001;
  float round_ = orthographic ? r : r * d / ((z - r) * (z + r)) * (1.0 + r / z);
  vec2 p = orthographic ? a.xy : a.xy / a.z, q = orthographic ? b.xy : b.xy / b.z;
  vec2 along = q - p, to = middle - p;
  float t = clamp(dot(to, along) / max(dot(along, along), 1e-30), 0.0, 1.0);
  vec2 away = to - t * along;
  float rounding = 1e-6 * (abs(p.x) + abs(p.y) + abs(q.x) + abs(q.y)); // ends beside the eye lie far out
  float far_enough = (round_ + reach) * 1.001 + rounding + 1e-5 * length(middle);
  return dot(away, away) <= far_enough * far_enough || (!orthographic && z <= 2.0 * r);
}

#endif
