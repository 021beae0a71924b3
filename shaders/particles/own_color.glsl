// SPDX-License-Identifier: MIT
// The color that a particle has of its own: a word of the buffer COLORS_BINDING of set 1, found by the particle's slot or,
// with a palette, by a byte of the buffer COLOR_INDICES_BINDING, four a word (ChunkSet::color_of).
#ifndef MOTE_OWN_COLOR_GLSL
#define MOTE_OWN_COLOR_GLSL

layout(std430, set = 1, binding = COLORS_BINDING) readonly buffer OwnColors { uint own_colors[]; };

#ifdef COLOR_INDICES_BINDING
layout(std430, set = 1, binding = COLOR_INDICES_BINDING) readonly buffer ColorIndices { uint color_indices[]; };
layout(constant_id = 9) const bool paletted = false;
uint color_place(uint slot) {
  if (paletted) slot = (color_indices[slot >> 2] >> (8u * (slot & 3u))) & 0xFFu;
  return slot;
}
#else
uint color_place(uint slot) { return slot; }
#endif

// Working space, straight alpha.
vec4 own_color(uint slot) { return unpack_color(own_colors[color_place(slot)]); }

#endif
