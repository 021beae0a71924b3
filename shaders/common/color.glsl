// SPDX-License-Identifier: MIT
// The piecewise sRGB decoding (IEC 61966-2-1) of particle colors: the working space is linear Rec.709.
#ifndef MOTE_COLOR_GLSL
#define MOTE_COLOR_GLSL

vec3 srgb_decode(vec3 v) {
  return mix(v / 12.92, pow((v + 0.055) / 1.055, vec3(2.4)), greaterThan(v, vec3(0.04045)));
}

// Straight RGBA, 8 bits each, R lowest, to working-space color and alpha.
vec4 unpack_color(uint packed_rgba) {
  vec4 v = unpackUnorm4x8(packed_rgba);
  return vec4(srgb_decode(v.rgb), v.a);
}

#endif
