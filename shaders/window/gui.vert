#version 460
// SPDX-License-Identifier: MIT
// Triangles of the panels: places in pixels of the window, colors as displayed.
layout(location = 0) in vec2 place;
layout(location = 1) in vec2 texel;
layout(location = 2) in vec4 tint;
layout(push_constant) uniform Block { vec2 scale; } block; // 2 / size of the window
layout(location = 0) out vec2 o_texel;
layout(location = 1) out vec4 o_tint;

void main() {
  o_texel = texel;
  o_tint = tint;
  gl_Position = vec4(place * block.scale - 1.0, 0.0, 1.0);
}
