#version 460
// SPDX-License-Identifier: MIT
// Phase `transparent`: the surface where the ray enters the particle and the one where it leaves, shaded. What
// becomes of them is MODE:
//   0  composited, the front one over the back one: one fragment a particle, drawn in order
//   1  the same, and the depth of what is nearest: tested and written by the device
//   2  weighted sums (McGuire & Bavoil, JCGT 2(2), 2013, eq. 9), in any order
//   3  kept in the pixel's list for the exact order (post/exact.frag), in any order
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "particles/particle.glsl"
#include "common/shading.glsl"
#if MODE == 3
#define LISTS_GROUP 3
#include "common/layer_lists.glsl"
#endif

layout(constant_id = 23) const bool two_surfaces = true; // each blocks 1 - sqrt(1 - alpha), so both block alpha
layout(constant_id = 24) const int depth_test = 1;       // never, less, equal, less_equal, greater, not_equal, greater_equal, always
layout(constant_id = 25) const bool has_depth = false;   // an earlier pass's depth is bound
layout(constant_id = 26) const bool straight = false;    // color is not multiplied by alpha

layout(location = 0) flat in vec4 v_color;
layout(location = 1) flat in uint v_id;
layout(location = 2) flat in vec4 v_payload[payload_vec4s];
layout(location = 2 + payload_vec4s) flat in vec3 v_lit;
layout(location = 3 + payload_vec4s) flat in uint v_batch;

layout(set = 2, binding = 0) uniform texture2D opaque_depth;

layout(push_constant) uniform PassBlock {
  float depth_scale; // MODE 2: the farthest depth of the scene becomes 200
  uint strip;        // MODE 3: which counter
  uint capacity;     // MODE 3: entries that the lists hold
  uint width;        // MODE 3: pixels in a row
} pass;

#if MODE == 2
layout(location = 0) out vec4 o_sum;
layout(location = 1) out float o_covered;
#elif MODE != 3
layout(location = 0) out vec4 o_color;
#endif
#if MODE == 1
layout(depth_less) out float gl_FragDepth;
#endif

// The nearest depth that an earlier pass left; farther than everything where there is none.
float opaque_at() {
  float there = has_depth ? texelFetch(opaque_depth, ivec2(gl_FragCoord.xy), 0).r : 0.0;
  return there > 0.0 ? frame.depth_near.x / there : 1e38;
}
// What the way within the particle absorbs, as far as it is in view: what each of `surfaces` blocks, so that all do.
float absorbed(Ray ray, Interval hit, float density, float surfaces) {
  float from = max(hit.t_in, max(frame.sample_near_far.z, 0.0)), to = min(hit.t_out, min(frame.sample_near_far.w, opaque_at()));
  return 1.0 - exp(-density * max(to - from, 0.0) * length(ray.direction) / surfaces);
}

// Is the surface at this depth in view, and does it pass the test against what an earlier pass drew?
bool shows(float t) {
  if (!(t > 0.0 && t >= frame.sample_near_far.z && t <= frame.sample_near_far.w)) return false;
#if MODE == 1
  return true;
#else
  float there = depth_test == 4 || depth_test == 6 ? 1.0 : 0.0; // encoded: the nearest, the farthest
  if (has_depth) there = texelFetch(opaque_depth, ivec2(gl_FragCoord.xy), 0).r;
  float own = encode_depth(t);
  return depth_test == 0 ? false : depth_test == 1 ? own > there : depth_test == 2 ? own == there :
         depth_test == 3 ? own >= there : depth_test == 4 ? own < there : depth_test == 5 ? own != there :
         depth_test == 6 ? own <= there : true;
#endif
}

vec3 surface_color(Ray ray, Particle particle, Interval hit, bool exit) {
  float t = exit ? hit.t_out : hit.t_in;
  vec3 outward = outward_normal(ray, particle, hit, exit);
  vec3 normal = inner_end(hit, exit) ? -normalize(ray.direction) : exit ? -outward : outward;
  if (head_light_only) return v_color.rgb + max(-normal.z, 0.0) * v_lit;
  return shade(Surface(ray.origin + t * ray.direction, normal, -normalize(ray.direction)), v_color.rgb, batch.material);
}

#if MODE == 2
float weight(float t) {
  float z = t * pass.depth_scale * 0.005;
  float z2 = z * z;
  return clamp(0.03 / (1e-5 + z2 * z2), 1e-2, 3e3);
}
#endif

void main() {
  batch_index = v_batch;
  Ray ray = pixel_ray(gl_FragCoord.xy);
  Particle particle = unpack(v_payload);
  Interval hit;
  if (!intersect(ray, particle, hit)) discard;

  bool front = cull != 1 && shows(hit.t_in), back = cull != 2 && shows(hit.t_out);
  if (!two_surfaces) { // one layer: the entry, or the inner wall where the entry is cut off
    bool inside = cull == 1 || !(hit.t_in > 0.0 && hit.t_in >= frame.sample_near_far.z);
    front = front && !inside;
    back = back && inside;
  }
  bool absorbs = v_color.a < 0.0; // then inner ends count: what lies between them absorbs
  front = front && (absorbs || !inner_end(hit, false));
  back = back && (absorbs || !inner_end(hit, true));
  if (!front && !back) discard;

  float alpha = absorbs ? absorbed(ray, hit, -v_color.a, front && back ? 2.0 : 1.0) : two_surfaces ? 1.0 - sqrt(max(1.0 - v_color.a, 0.0)) : v_color.a;
  float a_in = front ? alpha : 0.0, a_out = back ? alpha : 0.0;
  vec3 c_in = surface_color(ray, particle, hit, false), c_out = surface_color(ray, particle, hit, true);
#ifdef HAS_ALARM
  if (type_alarm) c_in = c_out = vec3(1.0, 0.0, 1.0);
#endif

#if MODE == 0 || MODE == 1
  vec4 c = vec4(c_in * a_in, a_in) + (1.0 - a_in) * vec4(c_out * a_out, a_out);
  o_color = straight ? vec4(c.rgb / max(c.a, 1e-6), c.a) : c;
#elif MODE == 2
  o_sum = a_in * weight(hit.t_in) * vec4(c_in, 1.0) + a_out * weight(hit.t_out) * vec4(c_out, 1.0);
  o_covered = 1.0 - (1.0 - a_in) * (1.0 - a_out);
#else
  uint pixel = uint(gl_FragCoord.y) * pass.width + uint(gl_FragCoord.x);
  keep_layers(pass.strip, pass.capacity, pixel, v_id, alpha, front ? hit.t_in : -1.0, c_in, back ? hit.t_out : -1.0, c_out);
#endif
#if MODE == 1
  gl_FragDepth = encode_depth(front ? hit.t_in : hit.t_out);
#endif
}
