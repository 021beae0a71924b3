#version 460
// SPDX-License-Identifier: MIT
// Expansion `vertex` with squares of a fixed size around the centers (steps = "points"): what particles look like before they
// have a geometry. proxy_slack: half the edge of a square, pixels, less the margin that every proxy has.
#extension GL_GOOGLE_include_directive : require
#include "particles/particle.glsl"

layout(location = 0) flat out vec4 v_color;
layout(location = 1) flat out uint v_id;
layout(location = 2) flat out vec4 v_payload[payload_vec4s];
layout(location = 2 + payload_vec4s) flat out vec3 v_lit;

void main() {
  Loaded loaded = load_particle(uint(gl_VertexIndex) >> 2);
  vec3 center = loaded.particle.center;
  vec2 at = orthographic ? center.xy : center.xy / center.z;
  bool shown = selected(loaded.color.a) && drawable(loaded.particle) && center.z >= max(frame.sample_near_far.z, frame.depth_near.x) && center.z <= frame.sample_near_far.w;
  gl_Position = shown ? proxy_corner(Proxy(at, at, center.z), gl_VertexIndex & 3) : outside();
  v_color = loaded.color;
  v_lit = loaded.lit;
  v_id = loaded.id;
  pack(loaded.particle, v_payload);
}
