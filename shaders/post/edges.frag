#version 460
// SPDX-License-Identifier: MIT
// Analytic edges: a pixel that its particle covers in part takes the rest from the pixel beyond the outline. What it
// covers, and where that pixel is, phase `surface` wrote (variant EDGES); colors have straight alpha.
#extension GL_EXT_samplerless_texture_functions : require

layout(set = 0, binding = 0) uniform texture2D picture;
layout(set = 0, binding = 1) uniform texture2D edge; // x: coverage; yz: the pixel beyond, relative; 1 where nothing is
layout(location = 0) out vec4 o_color;

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(picture, 0) - 1;
  vec4 e = texelFetch(edge, here, 0);
  ivec2 there = clamp(here + ivec2(e.yz), ivec2(0), last);
  vec4 own = texelFetch(picture, here, 0), beyond = texelFetch(picture, there, 0);
  float a = mix(beyond.a, own.a, e.x);
  vec3 premultiplied = mix(beyond.rgb * beyond.a, own.rgb * own.a, e.x);
  o_color = a > 0.0 ? vec4(premultiplied / a, a) : vec4(0.0);
}
