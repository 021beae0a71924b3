// SPDX-License-Identifier: MIT
// The oriented box around a cylinder or cone as one 4x4 matrix (exercise "Particle", OOBB tessellation): columns are the ends of
// the axis and two vectors across it, in clip space, so that all corners are sums of columns: [0 or 1] +- [2] +- [3]. Rows: x, y, the
// depth along the view axis, w (points have 1 or that depth, vectors 0 or theirs). Faces that look away are left out: at
// most three are left, which cover each pixel once.
#ifndef MOTE_BOX_GLSL
#define MOTE_BOX_GLSL

vec4 to_clip(vec3 v, float one) {
  float w = orthographic ? one : v.z;
  vec2 shift = 0.5 - (frame.sample_near_far.xy + 0.5 * frame.viewport.xy); // as proxy_corner()
  return vec4(2.0 * (v.xy * frame.viewport.zz + shift * w) / frame.viewport.xy, v.z, w);
}

mat4 clip_box(Particle p) {
  vec3 t = axis_of(p.h).u;
  vec3 u = normalize(cross(t, t.x * t.x + t.y * t.y > 1e-4 ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0)));
  vec3 a = from_own(p.h), b = from_own(max(p.radius, p.radius_end) * u), c = from_own(max(p.radius, p.radius_end) * cross(t, u));
  // grown by the pixels that rectangles are grown by
  float z = orthographic ? 1.0 : p.center.z + abs(a.z) + abs(b.z) + abs(c.z);
#ifdef AFFINE
  float e = 8.0 * (proxy_margin + proxy_slack) * z / frame.viewport.z; // edges are not at right angles
#else
  float e = 2.0 * (proxy_margin + proxy_slack) * z / frame.viewport.z;
#endif
  a *= 1.0 + proxy_growth + e / length(a);
  b *= 1.0 + proxy_growth + e / length(b);
  c *= 1.0 + proxy_growth + e / length(c);
  return mat4(to_clip(p.center - a, 1.0), to_clip(p.center + a, 1.0), to_clip(b, 0.0), to_clip(c, 0.0));
}

vec4 box_corner(mat4 box, int i) { return box[i & 1] + ((i & 2) != 0 ? box[2] : -box[2]) + ((i & 4) != 0 ? box[3] : -box[3]); }
float box_depth(mat4 box) { return min(box[0].z, box[1].z) - abs(box[2].z) - abs(box[3].z); } // the least

// Four corners of face k (0..5) as a strip: bit `axis` fixed, the other two running.
int face_corner(int k, int i) {
  int axis = k >> 1, side = k & 1, one = (axis + 1) % 3, two = (axis + 2) % 3;
  return (side << axis) | ((i & 1) << one) | ((i >> 1) << two);
}
// Does the eye lie on the face's outer side? Rows x, y, z are the view's but for their scale, which keeps signs.
bool face_seen(mat4 box, int k) {
  vec3 a = box_corner(box, face_corner(k, 0)).xyz, b = box_corner(box, face_corner(k, 1)).xyz, c = box_corner(box, face_corner(k, 2)).xyz;
  vec3 n = cross(b - a, c - a), middle = 0.5 * (box[0].xyz + box[1].xyz);
  float eye = orthographic ? n.z : dot(a, n);
  return eye * dot(middle - a, n) > 0.0;
}

#endif
