#version 460
// SPDX-License-Identifier: MIT
// Expansion `vertex`: four vertices a particle, pulled from storage buffers; drawn as indexed quads (6 indices).
#extension GL_GOOGLE_include_directive : require
#include "particles/particle.glsl"

layout(location = 0) flat out vec4 v_color;
layout(location = 1) flat out uint v_id;
layout(location = 2) flat out vec4 v_payload[payload_vec4s];
layout(location = 2 + payload_vec4s) flat out vec3 v_lit;
#ifdef ORDERED
layout(location = 3 + payload_vec4s) flat out uint v_batch;
#endif

void main() {
  Loaded loaded = load_particle(uint(gl_VertexIndex) >> 2);
  Proxy bounds = proxy(loaded.particle);
  bool shown = selected(loaded.color.a) && drawable(loaded.particle) && bounds.lo.x <= bounds.hi.x && bounds.lo.y <= bounds.hi.y;
  gl_Position = shown ? proxy_corner(bounds, gl_VertexIndex & 3) : outside();
  v_color = loaded.color;
  v_lit = loaded.lit;
  v_id = loaded.id;
  pack(loaded.particle, v_payload);
#ifdef ORDERED
  v_batch = batch_index;
#endif
}
