// SPDX-License-Identifier: MIT
// Lists of transparent surfaces, one a pixel, in one buffer of bounded size (after Yang, Hensley, Gruen & Thibieroz,
// "Real-Time Concurrent Linked List Construction on the GPU", EGSR 2010). An entry holds both surfaces of
// a particle. What finds no place is counted all the same: the count says what would have been needed.
// Written by particles/phase/transparent.frag, read by post/exact.frag; the group is LISTS_GROUP.
#ifndef MOTE_LAYER_LISTS_GLSL
#define MOTE_LAYER_LISTS_GLSL

layout(std430, set = LISTS_GROUP, binding = 0) buffer Heads { uint heads[]; };       // per pixel: entry + 1, 0: none
layout(std430, set = LISTS_GROUP, binding = 1) buffer Entries { uvec4 entries[]; };  // two uvec4s an entry
layout(std430, set = LISTS_GROUP, binding = 2) buffer Counters { uint counters[]; }; // per strip of the picture: entries asked for

const uint no_surface = 0xFFFFFFFFu; // farther than every depth

// Depths are positive, so their bits order as they do. Negative: there is no such surface.
void keep_layers(uint strip, uint capacity, uint pixel, uint id, float alpha, float t_in, vec3 c_in, float t_out, vec3 c_out) {
  uint place = atomicAdd(counters[strip], 1u);
  if (place < capacity) {
    uint bits_in = t_in > 0.0 ? floatBitsToUint(t_in) : no_surface;
    uint bits_out = t_out > 0.0 ? floatBitsToUint(t_out) : no_surface;
    if (bits_out != no_surface && bits_out == bits_in) bits_out += 1u; // (depth, id) names a surface
    uint next = atomicExchange(heads[pixel], place + 1u);
    entries[2u * place] = uvec4(next, id, bits_in, bits_out);
    entries[2u * place + 1u] = uvec4(packHalf2x16(c_in.rg), packHalf2x16(vec2(c_in.b, alpha)), packHalf2x16(c_out.rg),
                                     packHalf2x16(vec2(c_out.b, alpha)));
  }
}

#endif
