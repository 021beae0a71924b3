#version 460
// SPDX-License-Identifier: MIT
// Expansion `geometry` with boxes, first half: one point a particle, placed in view space, and its box in clip space.
#extension GL_GOOGLE_include_directive : require
#include "particles/particle.glsl"
#include "particles/expand/box.glsl"

layout(location = 0) out vec4 g_color;
layout(location = 1) out uint g_id;
layout(location = 2) out vec4 g_payload[payload_vec4s];
layout(location = 2 + payload_vec4s) out vec3 g_lit;
layout(location = 3 + payload_vec4s) out mat4 g_box;

void main() {
  Loaded loaded = load_particle(uint(gl_VertexIndex));
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
  g_color = loaded.color;
  g_lit = loaded.lit;
  g_id = loaded.id;
  g_box = clip_box(loaded.particle);
  pack(loaded.particle, g_payload);
}
