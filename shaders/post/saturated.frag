#version 460
// SPDX-License-Identifier: MIT
// Marks the pixels of a layer, drawn front to back, in which nothing behind can be seen any more: the nearest
// depth there, so that the device's depth test rejects what follows before it is shaded.
#extension GL_EXT_samplerless_texture_functions : require

layout(set = 0, binding = 1) uniform texture2D layer;

const float opaque_enough = 1.0 / 2048.0; // light from behind that is left out at most

void main() {
  if (texelFetch(layer, ivec2(gl_FragCoord.xy), 0).a < 1.0 - opaque_enough) discard;
  gl_FragDepth = 1.0;
}
