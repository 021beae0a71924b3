#version 460
// SPDX-License-Identifier: MIT
// Analytic edges by tiles: lists the pixels that have a neighbor of another particle, of none or, if they are empty, of any.
// A workgroup, one subgroup, looks at blocks of 64 pixels, LANES a row, one below the other.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "particles/tiles/work.glsl"
#include "particles/tiles/winners.glsl"

layout(local_size_x = LANES) in;
const int rows = 64 / LANES;
const int blocks = 8; // as in tile_edges.cpp

layout(std430, set = 1, binding = 0) readonly buffer Names { uint names[]; };
layout(std430, set = 1, binding = 5) writeonly buffer Listed { uint listed[]; };
layout(std430, set = 1, binding = 6) buffer Arguments { uint arguments[]; }; // of edges.comp: workgroups in x, y, z; pixels listed

// A pixel of a row and those beside it. Beyond the picture is what stands at its edge.
struct Three {
  uint left, own, right;
};
Three row_of(int y, ivec2 last, uint width, uint x, uint beside) {
  uint start = uint(clamp(y, 0, last.y)) * width, lane = gl_LocalInvocationID.x;
  uint own = names[start + x], side = names[start + beside];
  uint left = subgroupShuffle(own, max(lane, 1u) - 1u), right = subgroupShuffle(own, min(lane + 1u, uint(LANES - 1)));
  return Three(lane == 0u ? side : left, own, lane == uint(LANES - 1) ? side : right);
}
uint differences(Three row, uint own) { return (row.left ^ own) | (row.own ^ own) | (row.right ^ own); }

// Appends the pixels of a block; bit row * LANES + lane.
void list(uvec2 bits, uvec2 base) {
  uint lane = gl_LocalInvocationID.x, count = uint(bitCount(bits.x) + bitCount(bits.y)), at = 0u;
  if (count != 0u && lane == 0u) {
    at = atomicAdd(arguments[3], count);
    atomicMax(arguments[1], (at + count + edge_groups * uint(LANES) - 1u) / (edge_groups * uint(LANES)));
  }
  at = subgroupShuffle(at, 0u);
  do { // row by row of those with any
    bool low = bits.x != 0u;
    uint row = uint(max(low ? findLSB(bits.x) : 32 + findLSB(bits.y), 0)) / uint(LANES), shift = (row * uint(LANES)) & 31u;
    uint all = 0xFFFFFFFFu >> (32 - LANES), mine = ((low ? bits.x : bits.y) >> shift) & all;
    if ((mine >> lane & 1u) != 0u)
      listed[at + uint(bitCount(mine & ((1u << lane) - 1u)))] = pack_pixel(base + uvec2(lane, row));
    at += uint(bitCount(mine));
    bits = low ? uvec2(bits.x & ~(all << shift), bits.y) : uvec2(0u, bits.y & ~(all << shift));
  } while ((bits.x | bits.y) != 0u);
}

void main() {
  uint width = step.width;
  ivec2 last = ivec2(int(width), int(step.height)) - 1, base = ivec2(gl_WorkGroupID.xy) * ivec2(LANES, rows * blocks);
  int lane = int(gl_LocalInvocationID.x), x = base.x + lane, end = min(base.y + rows * blocks, last.y + 1);
  uint own_x = uint(min(x, last.x)), beside = uint(clamp(lane < LANES / 2 ? base.x - 1 : base.x + LANES, 0, last.x));
  Three above = row_of(base.y - 1, last, width, own_x, beside), here = row_of(base.y, last, width, own_x, beside);
  do {
    uvec2 bits = uvec2(0u);
    uint shift = 0u;
    do {
      Three below = row_of(base.y + int(shift) / LANES + 1, last, width, own_x, beside);
      bool at_outline = (differences(above, here.own) | differences(here, here.own) | differences(below, here.own)) != 0u;
      uint ballot = subgroupBallot(at_outline && x <= last.x && base.y + int(shift) / LANES <= last.y).x;
      bits.x |= shift < 32u ? ballot << shift : 0u;
      bits.y |= shift < 32u ? 0u : ballot << (shift & 31u);
      above = here;
      here = below;
      shift += uint(LANES);
    } while (shift < 64u);
    list(bits, uvec2(base));
    base.y += rows;
  } while (base.y < end);
}
