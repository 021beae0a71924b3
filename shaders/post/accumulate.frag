#version 460
// SPDX-License-Identifier: MIT
// One sample's picture, weighted, with premultiplied alpha; added up by blending.
#extension GL_EXT_samplerless_texture_functions : require

layout(constant_id = 0) const float weight = 1.0;
layout(set = 0, binding = 0) uniform texture2D picture;
layout(location = 0) out vec4 o_sum;

void main() {
  vec4 c = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
  o_sum = vec4(c.rgb * c.a, c.a) * weight;
}
