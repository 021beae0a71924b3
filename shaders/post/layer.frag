#version 460
// SPDX-License-Identifier: MIT
// A layer of composited particles (color times alpha) over what is there.
#extension GL_GOOGLE_include_directive : require
#include "common/over.glsl"

layout(set = 0, binding = 1) uniform texture2D layer;
layout(location = 0) out vec4 o_color;

void main() {
  vec4 light = texelFetch(layer, ivec2(gl_FragCoord.xy), 0);
  if (light.a == 0.0) discard;
  o_color = over_there(light);
}
