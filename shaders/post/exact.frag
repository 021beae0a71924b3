#version 460
// SPDX-License-Identifier: MIT
// The surfaces of a pixel's list in the order of their depth, composited front to back, over what is there.
// Lists may be of any length: each sweep over the list finds the next few surfaces in a small sorted window of
// registers, until none is left or nothing behind can be seen. No array is indexed by a variable, so that lanes
// of a CPU device stay together; depth and id order surfaces, whatever the order of the list.
#extension GL_GOOGLE_include_directive : require
#include "common/over.glsl"
#define LISTS_GROUP 1
#include "common/layer_lists.glsl"

layout(location = 0) out vec4 o_color;
layout(push_constant) uniform ResolveBlock { uint width; } resolve;

// The window, spelled out: the index is a constant in every line.
const int window = 8;
#define EACH(step) step(0) step(1) step(2) step(3) step(4) step(5) step(6) step(7)
const float opaque_enough = 1.0 / 2048.0; // light from behind that is left out at most

bool before(uvec2 a, uvec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

void main() {
  uint head = heads[uint(gl_FragCoord.y) * resolve.width + uint(gl_FragCoord.x)];
  if (head == 0u) discard;
  vec3 light = vec3(0.0);
  float through = 1.0;
  uvec2 last = uvec2(0u); // depth bits and id of the last surface composited
  bool more = head != 0u;
  do {
    uvec2 keys[window];
    uint places[window]; // entry * 2 + (exit ? 1 : 0)
#define CLEAR(j) keys[j] = uvec2(no_surface); places[j] = 0u;
    EACH(CLEAR)
    uint at = head;
    do {
      uint entry = max(at, 1u) - 1u;
      uvec4 surfaces = entries[2u * entry];
      uvec2 key = uvec2(surfaces.z, surfaces.y);
      uint place = entry * 2u;
      // Insertion: the later of the two moves on.
#define INSERT(j) { bool first = before(key, keys[j]); uvec2 k = first ? keys[j] : key; uint p = first ? places[j] : place; \
                    keys[j] = first ? key : keys[j]; places[j] = first ? place : places[j]; key = k; place = p; }
      if (at == 0u || !before(last, key)) key = uvec2(no_surface);
      EACH(INSERT)
      key = uvec2(surfaces.w, surfaces.y);
      place = entry * 2u + 1u;
      if (at == 0u || !before(last, key)) key = uvec2(no_surface);
      EACH(INSERT)
      at = at == 0u ? 0u : surfaces.x;
    } while (at != 0u);
#define COMPOSITE(j) { bool valid = more && keys[j].x != no_surface; uvec4 colors = entries[2u * (places[j] >> 1) + 1u]; \
                       uvec2 packed_color = (places[j] & 1u) == 0u ? colors.xy : colors.zw; \
                       vec2 rg = unpackHalf2x16(packed_color.x), ba = unpackHalf2x16(packed_color.y); \
                       float alpha = valid ? ba.y : 0.0; light += through * alpha * vec3(rg, ba.x); \
                       through *= 1.0 - alpha; last = valid ? keys[j] : last; }
    EACH(COMPOSITE)
    more = more && keys[window - 1].x != no_surface && through > opaque_enough;
  } while (more);
  o_color = over_there(vec4(light, 1.0 - through));
}
