#version 460
// SPDX-License-Identifier: MIT
// Premultiplied color as straight color.
#extension GL_EXT_samplerless_texture_functions : require

layout(set = 0, binding = 0) uniform texture2D picture;
layout(location = 0) out vec4 o_color;

void main() {
  vec4 c = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
  o_color = c.a > 0.0 ? vec4(c.rgb / c.a, c.a) : vec4(0.0);
}
