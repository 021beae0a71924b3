#version 460
// SPDX-License-Identifier: MIT
// Tessellated spheres, the unit mesh placed at each: what impostors are charted against. No normals of its own: the unit
// sphere's vertices are its normals.
layout(set = 0, binding = 0, std430) readonly buffer Spheres { vec4 spheres[]; };   // view-space center, radius
layout(set = 0, binding = 1, std430) readonly buffer Corners { vec4 corners[]; };   // of the unit mesh
layout(push_constant) uniform Push { vec4 scale_near; };                             // 2 focal / width, 2 focal / height, near
layout(location = 0) out vec3 normal;
layout(location = 1) flat out uint id;

void main() {
  vec4 sphere = spheres[gl_InstanceIndex];
  vec3 n = corners[gl_VertexIndex].xyz, p = sphere.xyz + sphere.w * n;
  normal = n;
  id = uint(gl_InstanceIndex);
  gl_Position = vec4(p.xy * scale_near.xy, scale_near.z, p.z);
}
