#version 460
// SPDX-License-Identifier: MIT
// Expansion `point`: one vertex a particle, a square sprite around its rectangle on the image. Only for chunks whose
// particles all have their sprite inside of the image and below the device's largest size
// (passes/particles/sprites.hpp); all others are drawn by expansion `vertex`.
#extension GL_GOOGLE_include_directive : require
#include "particles/particle.glsl"

layout(location = 0) flat out vec4 v_color;
layout(location = 1) flat out uint v_id;
layout(location = 2) flat out vec4 v_payload[payload_vec4s];
layout(location = 2 + payload_vec4s) flat out vec3 v_lit;

const float sprite_margin = 1.0; // pixels: how devices round the edges of points

void main() {
  Loaded loaded = load_particle(uint(gl_VertexIndex));
  Proxy bounds = proxy(loaded.particle);
  bool shown = selected(loaded.color.a) && drawable(loaded.particle) && bounds.lo.x <= bounds.hi.x && bounds.lo.y <= bounds.hi.y;
  vec4 lo = proxy_corner(bounds, 0), hi = proxy_corner(bounds, 3);
  vec2 size = 0.5 * (hi.xy - lo.xy) * frame.viewport.xy;
  gl_Position = shown ? vec4(0.5 * (lo.xy + hi.xy), lo.z, 1.0) : outside();
  gl_PointSize = max(size.x, size.y) + sprite_margin;
  v_color = loaded.color;
  v_lit = loaded.lit;
  v_id = loaded.id;
  pack(loaded.particle, v_payload);
}
