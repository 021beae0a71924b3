#version 460
// SPDX-License-Identifier: MIT
// Expansion `geometry`, second half: the point becomes the strip of its proxy.
#extension GL_GOOGLE_include_directive : require
#include "particles/particle.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) in vec4 g_color[];
layout(location = 1) in uint g_id[];
layout(location = 2) in vec4 g_payload[][payload_vec4s];
layout(location = 2 + payload_vec4s) in vec3 g_lit[];
#ifdef ORDERED
layout(location = 3 + payload_vec4s) in uint g_batch[];
#endif

layout(location = 0) flat out vec4 v_color;
layout(location = 1) flat out uint v_id;
layout(location = 2) flat out vec4 v_payload[payload_vec4s];
layout(location = 2 + payload_vec4s) flat out vec3 v_lit;
#ifdef ORDERED
layout(location = 3 + payload_vec4s) flat out uint v_batch;
#endif

void main() {
#ifdef ORDERED
  batch_index = g_batch[0];
#endif
  Particle particle = unpack(g_payload[0]);
  Proxy bounds = proxy(particle);
  if (!selected(g_color[0].a) || !drawable(particle) || bounds.lo.x > bounds.hi.x || bounds.lo.y > bounds.hi.y) return;
  for (int i = 0; i < 4; ++i) {
    gl_Position = proxy_corner(bounds, i);
    v_color = g_color[0];
    v_lit = g_lit[0];
    v_id = g_id[0];
#ifdef ORDERED
    v_batch = g_batch[0];
#endif
    for (int k = 0; k < payload_vec4s; ++k) v_payload[k] = g_payload[0][k];
    EmitVertex();
  }
  EndPrimitive();
}
