#version 460
// SPDX-License-Identifier: MIT
layout(location = 0) in vec3 normal;
layout(location = 1) flat in uint id;
layout(location = 0) out vec4 color;
layout(location = 1) out uint shown;

void main() { // a head light
  color = vec4(vec3(0.2 + 0.8 * max(0.0, -normalize(normal).z)), 1.0);
  shown = id;
}
