#version 460
// SPDX-License-Identifier: MIT
// A type from files as its own twin: the same text compiled with double, cast on rays in the particle's axes.
#extension GL_GOOGLE_include_directive : require
#define REAL_DOUBLE
#include "particles/user/functions.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Given { double given[]; };  // 11 each: o, d, lengths, numbers
layout(std430, set = 0, binding = 1) writeonly buffer Found { double found[]; }; // 9 each: met, t_in, t_out, normals there (any length)
layout(push_constant) uniform Block { uint count, stride, rays; } block;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= block.count) return;
  uint g = 11u * i, f = 9u * i;
  dvec3 o = dvec3(given[g], given[g + 1u], given[g + 2u]), d = dvec3(given[g + 3u], given[g + 4u], given[g + 5u]);
  Shape s = shape_from(dvec3(given[g + 6u], given[g + 7u], given[g + 8u]), dvec2(given[g + 9u], given[g + 10u]));
  double t_in = 0.0LF, t_out = 0.0LF;
  bool met = hit(s, o, d, t_in, t_out) && t_in <= t_out;
  dvec3 n_in = surface(s, o + t_in * d), n_out = surface(s, o + t_out * d);
  found[f] = met ? 1.0LF : 0.0LF;
  found[f + 1u] = t_in;
  found[f + 2u] = t_out;
  for (int k = 0; k < 3; ++k) {
    found[f + 3u + uint(k)] = n_in[k];
    found[f + 6u + uint(k)] = n_out[k];
  }
}
