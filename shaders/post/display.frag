#version 460
// SPDX-License-Identifier: MIT
// The display transform of one pixel. "display_transform.glsl" is made at run time from OpenColorIO's text; it
// defines vec4 mote_display(vec4 linear).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "display_transform.glsl"

layout(set = 0, binding = 0) uniform texture2D scene_color;
layout(location = 0) out vec4 o_color;

void main() { o_color = mote_display(texelFetch(scene_color, ivec2(gl_FragCoord.xy), 0)); }
