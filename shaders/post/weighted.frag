#version 460
// SPDX-License-Identifier: MIT
// Weighted sums become a color and a coverage (McGuire & Bavoil, JCGT 2(2), 2013, eq. 6), over what is there.
#extension GL_GOOGLE_include_directive : require
#include "common/over.glsl"

layout(set = 0, binding = 1) uniform texture2D sums;     // sum of weight * alpha * (color, 1)
layout(set = 0, binding = 2) uniform texture2D revealed; // product of 1 - alpha
layout(location = 0) out vec4 o_color;

void main() {
  vec4 sum = texelFetch(sums, ivec2(gl_FragCoord.xy), 0);
  float alpha = 1.0 - texelFetch(revealed, ivec2(gl_FragCoord.xy), 0).r;
  if (!(sum.a > 0.0)) discard;
  o_color = over_there(vec4(sum.rgb / sum.a * alpha, alpha));
}
