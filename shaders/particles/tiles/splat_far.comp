#version 460
// SPDX-License-Identifier: MIT
// How far splats and what was cast reach in each tile: what lies behind is hidden. A workgroup, one subgroup, a tile.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "common/frame.glsl"
#include "particles/tiles/work.glsl"

layout(local_size_x = LANES) in;

layout(constant_id = 20) const bool splats_only = false; // nothing is cast in this frame

layout(std430, set = 1, binding = 0) readonly buffer Splats { PAIR splats[]; };
layout(std430, set = 1, binding = 1) readonly buffer Keys { float nearest[]; };
layout(std430, set = 1, binding = 2) buffer Far { float far[]; };

void main() {
  uint tile = gl_WorkGroupID.y * step.tiles_x + gl_WorkGroupID.x, width = step.width;
  uvec2 base = gl_WorkGroupID.xy * uint(tile_size);
  uvec2 end = min(base + uint(tile_size), uvec2(width, step.height));
  uint lane = gl_LocalInvocationID.x;
  float most = 0.0;
  do {
    uvec2 pixel = base + uvec2(lane & 7u, lane >> 3);
    bool inside = pixel.x < end.x && pixel.y < end.y;
    uint at = inside ? pixel.y * width + pixel.x : base.y * width + base.x;
    float key = uintBitsToFloat(words(splats[at]).y);
    if (!splats_only) key = min(key, nearest[at]);
    most = max(most, key);
    lane += uint(LANES);
  } while (lane < 64u);
  most = subgroupMax(most);
  vec2 offset = vec2(base) + frame.sample_near_far.xy;
  vec2 least = max(max(offset, -(offset + float(tile_size - 1))), vec2(0.0)) * (frame.viewport.w + frame.depth_near.y);
  float least_ray2 = orthographic ? 1.0 : 1.0 + dot(least, least);
  if (subgroupElect() && most < infinitely_far) far[tile] = min(far[tile], most / least_ray2 * (1.0 + 2e-6));
}
