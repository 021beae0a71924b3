#version 460
// SPDX-License-Identifier: MIT
// Ways to bring a center from the world before the eye, one of them by METHOD. Given per item: (world center, 0), (its rest
// beyond float32, 0), (center relative to the chunk's origin, 0), (that origin in view space, 0), three rows of (rotation, translation), the
// eye, its rest, the rests of the rotation's rows. Made: (view-space center, 0), (its rest, 0).
#include "charts/kernel.glsl"

void main() {
  uint i = item();
  if (i >= count) return;
  vec3 world = given[12u * i].xyz, world_low = given[12u * i + 1u].xyz, local = given[12u * i + 2u].xyz, origin = given[12u * i + 3u].xyz;
  vec4 row0 = given[12u * i + 4u], row1 = given[12u * i + 5u], row2 = given[12u * i + 6u];
  vec3 eye = given[12u * i + 7u].xyz, eye_low = given[12u * i + 8u].xyz;
  vec3 low0 = given[12u * i + 9u].xyz, low1 = given[12u * i + 10u].xyz, low2 = given[12u * i + 11u].xyz;
  vec3 high = vec3(0.0), low = vec3(0.0);
  uint k = 0u;
  do {
    vec3 nudge = vec3(0.0, 1e-9 * float(k), 0.0);
#if METHOD == 0 // one 4x4 matrix
    vec3 p = world + nudge;
    high += vec3(dot(row0.xyz, p) + row0.w, dot(row1.xyz, p) + row1.w, dot(row2.xyz, p) + row2.w);
#elif METHOD == 1 // relative to the eye, then turned
    vec3 p = (world + nudge) - eye;
    high += vec3(dot(row0.xyz, p), dot(row1.xyz, p), dot(row2.xyz, p));
#elif METHOD == 2 // relative to the chunk, whose origin came in double; as place() of shaders/particles/sphere/type.glsl
    precise vec3 p = mat3(vec3(row0.x, row1.x, row2.x), vec3(row0.y, row1.y, row2.y), vec3(row0.z, row1.z, row2.z)) * (local + nudge) + origin;
    high += p;
#elif METHOD == 3 || METHOD == 4 // two floats a coordinate; 4: written so that a compiler may reassociate
#if METHOD == 3
    precise vec3 p = (world - eye) + (world_low - eye_low);
    p += nudge;
#else
    vec3 p = (world + (world_low + nudge)) - (eye + eye_low);
#endif
    high += vec3(dot(row0.xyz, p), dot(row1.xyz, p), dot(row2.xyz, p));
#elif METHOD == 5 // double
    dvec3 p = (dvec3(world) + dvec3(world_low)) - (dvec3(eye) + dvec3(eye_low)) + dvec3(nudge);
    dvec3 v = dvec3(dot(dvec3(row0.xyz) + dvec3(low0), p), dot(dvec3(row1.xyz) + dvec3(low1), p), dot(dvec3(row2.xyz) + dvec3(low2), p));
    high += vec3(v);
    low += vec3(v - dvec3(vec3(v)));
#endif
    ++k;
  } while (k < repeats);
  made[2u * i] = vec4(high, 0.0);
  made[2u * i + 1u] = vec4(low, 0.0);
}
