#version 460
// SPDX-License-Identifier: MIT
// A finished picture on the window: as it is, stretched, or a small one at a place. Values are displayed ones, straight alpha.
#extension GL_EXT_samplerless_texture_functions : require

layout(constant_id = 0) const uint mode = 0; // 0: exact, 1: stretched, 2: a small picture, blended
layout(set = 0, binding = 0) uniform texture2D picture;
layout(set = 0, binding = 1) uniform sampler smooth_sampler;
layout(push_constant) uniform Block {
  vec2 origin; // of the picture on the target, pixels
  vec2 scale;  // stretched: 1 / size of the target
} block;
layout(location = 0) out vec4 o_color;

void main() {
  const vec2 place = gl_FragCoord.xy - block.origin;
  vec4 color;
  if (mode == 1) color = textureLod(sampler2D(picture, smooth_sampler), place * block.scale, 0.0);
  else color = texelFetch(picture, ivec2(place), 0);
  // Where the picture is not covered, the window is gray.
  o_color = mode == 2 ? color : vec4(mix(vec3(0.5), color.rgb, color.a), 1.0);
}
