#version 460
// SPDX-License-Identifier: MIT
// Expansion `geometry`, first half: one point a particle, placed in view space.
#extension GL_GOOGLE_include_directive : require
#include "particles/particle.glsl"

layout(location = 0) out vec4 g_color;
layout(location = 1) out uint g_id;
layout(location = 2) out vec4 g_payload[payload_vec4s];
layout(location = 2 + payload_vec4s) out vec3 g_lit;
#ifdef ORDERED
layout(location = 3 + payload_vec4s) out uint g_batch;
#endif

void main() {
  Loaded loaded = load_particle(uint(gl_VertexIndex));
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
  g_color = loaded.color;
  g_lit = loaded.lit;
  g_id = loaded.id;
  pack(loaded.particle, g_payload);
#ifdef ORDERED
  g_batch = batch_index;
#endif
}
