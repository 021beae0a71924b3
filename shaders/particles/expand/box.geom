#version 460
// SPDX-License-Identifier: MIT
// Expansion `geometry` with boxes, second half: the faces of the box that the eye sees, a strip each. A box that the near plane
// cuts, or that holds the eye, is drawn by its particle's rectangle.
#extension GL_GOOGLE_include_directive : require
#include "particles/particle.glsl"
#include "particles/expand/box.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 12) out;

layout(location = 0) in vec4 g_color[];
layout(location = 1) in uint g_id[];
layout(location = 2) in vec4 g_payload[][payload_vec4s];
layout(location = 2 + payload_vec4s) in vec3 g_lit[];
layout(location = 3 + payload_vec4s) in mat4 g_box[];

layout(location = 0) flat out vec4 v_color;
layout(location = 1) flat out uint v_id;
layout(location = 2) flat out vec4 v_payload[payload_vec4s];
layout(location = 2 + payload_vec4s) flat out vec3 v_lit;

void emit(vec4 position) {
  gl_Position = position;
  v_color = g_color[0];
  v_lit = g_lit[0];
  v_id = g_id[0];
  for (int k = 0; k < payload_vec4s; ++k) v_payload[k] = g_payload[0][k];
  EmitVertex();
}

// Of the two faces across each axis at most one is seen. Three strips for every particle, some of them nowhere: lanes of a CPU device
// stay together.
void main() {
  Particle particle = unpack(g_payload[0]);
  if (!selected(g_color[0].a) || !drawable(particle)) return;
  float z_min = box_depth(g_box[0]);
  bool cut = z_min < visible_from();
  Proxy bounds = proxy(particle);
  bool empty = cut && (bounds.lo.x > bounds.hi.x || bounds.lo.y > bounds.hi.y);
  float depth = encode_depth(max(z_min, visible_from()) * (1.0 - 1e-5)); // of all of it, as that of rectangles
  for (int axis = 0; axis < 3; ++axis) {
    bool low = face_seen(g_box[0], 2 * axis), high = face_seen(g_box[0], 2 * axis + 1);
    bool shown = cut ? axis == 0 && !empty : low || high;
    for (int i = 0; i < 4; ++i) {
      vec4 corner = box_corner(g_box[0], face_corner(2 * axis + (high ? 1 : 0), i));
      vec4 position = cut ? proxy_corner(bounds, i) : vec4(corner.xy, depth * corner.w, corner.w);
      emit(shown ? position : outside());
    }
    EndPrimitive();
  }
}
