#version 460
// SPDX-License-Identifier: MIT
// Letters and pictures of the panels.
layout(location = 0) in vec2 texel;
layout(location = 1) in vec4 tint;
layout(set = 0, binding = 0) uniform texture2D picture;
layout(set = 0, binding = 1) uniform sampler smooth_sampler;
layout(location = 0) out vec4 o_color;

void main() { o_color = tint * textureLod(sampler2D(picture, smooth_sampler), texel, 0.0); }
