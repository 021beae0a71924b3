// SPDX-License-Identifier: MIT
// Analytic edges by tiles: what a cast keeps of each pixel's nearest particle for edges.comp. Three pairs of words a pixel:
// who it is (its payload's x mixed with the rest, and y), cleared to no_winner; behind those of all pixels the rest of its payload and the color
// that it has here, half floats, side by side.
#ifndef MOTE_TILES_WINNERS_GLSL
#define MOTE_TILES_WINNERS_GLSL

const uvec2 no_winner = uvec2(0xFFFFFFFFu);

uint mixed(uvec2 rest) { return rest.x * 0x9E3779B1u ^ (rest.y << 7 | rest.y >> 25); }
uvec2 winner_name(vec4 payload) { return uvec2(floatBitsToUint(payload.x) ^ mixed(floatBitsToUint(payload.zw)), floatBitsToUint(payload.y)); }
vec4 winner_payload(uvec2 name, uvec2 rest) { return uintBitsToFloat(uvec4(name.x ^ mixed(rest), name.y, rest)); }

#endif
