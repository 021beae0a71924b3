// SPDX-License-Identifier: MIT
// The last step of a transparent pass: its light and coverage over what is there. Where everything there is
// opaque the device blends; else the color there, which is straight, has been copied and is read here.
#ifndef MOTE_OVER_GLSL
#define MOTE_OVER_GLSL
#extension GL_EXT_samplerless_texture_functions : require

layout(constant_id = 0) const bool over_copy = false;
layout(set = 0, binding = 0) uniform texture2D there;

// `light` is multiplied by its alpha. Result: as it is, for the device to blend, or the straight color of both.
vec4 over_there(vec4 light) {
  if (!over_copy) return light;
  vec4 below = texelFetch(there, ivec2(gl_FragCoord.xy), 0);
  float alpha = light.a + (1.0 - light.a) * below.a;
  vec3 rgb = light.rgb + (1.0 - light.a) * below.a * below.rgb;
  return alpha > 0.0 ? vec4(rgb / alpha, alpha) : below;
}

#endif
