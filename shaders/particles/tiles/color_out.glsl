// SPDX-License-Identifier: MIT
// Colors of pixels as tiles write them: by the pixel map that would come next, in the target's format. COLOR_BINDING and
// COLOR_PAIRS_BINDING: bindings of set 1.
#ifndef MOTE_TILES_COLOR_OUT_GLSL
#define MOTE_TILES_COLOR_OUT_GLSL

#ifdef PIXEL_MAP
#extension GL_EXT_samplerless_texture_functions : require
#include "pixel_map.glsl" // made at run time: vec4 map_pixel(vec4), the display transform that would come next
#else
vec4 map_pixel(vec4 color) { return color; }
#endif

layout(constant_id = 14) const uint color_words = 2u;    // of a pixel: 1 rgba8unorm, 2 rgba16float, 4 rgba32float; 0: no color
layout(std430, set = 1, binding = COLOR_BINDING) writeonly buffer OutColor { uint out_color[]; };            // rgba8unorm
layout(std430, set = 1, binding = COLOR_PAIRS_BINDING) writeonly buffer OutColorPairs { PAIR out_color_pairs[]; }; // the wider formats

void write_color(uint at, vec4 color) {
  if (color_words == 1u) {
    // The shuffle keeps the packing out of the store's loop over lanes.
    out_color[at] = subgroupShuffle(packUnorm4x8(color), gl_SubgroupInvocationID);
  } else if (color_words == 2u) {
    out_color_pairs[at] = pair(uvec2(packHalf2x16(color.rg), packHalf2x16(color.ba)));
  } else {
    out_color_pairs[2u * at] = pair(floatBitsToUint(color.rg));
    out_color_pairs[2u * at + 1u] = pair(floatBitsToUint(color.ba));
  }
}

#endif
