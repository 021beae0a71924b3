#version 460
// SPDX-License-Identifier: MIT
// Phase `opaque`: the nearest visible surface of the particle, shaded; depth and, where asked for, AOVs.
#extension GL_GOOGLE_include_directive : require
#include "particles/particle.glsl"
#include "common/shading.glsl"

layout(location = 0) flat in vec4 v_color;
layout(location = 1) flat in uint v_id;
layout(location = 2) flat in vec4 v_payload[payload_vec4s];
layout(location = 2 + payload_vec4s) flat in vec3 v_lit;

layout(location = 0) out vec4 o_color;
// AOV is a mask: 1 depth, 2 id, 4 normal; attachments follow each other in this order.
#if (AOV & 1) != 0
layout(location = 1) out float o_depth;
#endif
#if (AOV & 2) != 0
layout(location = 1 + (AOV & 1)) out uint o_id;
#endif
#if (AOV & 4) != 0
layout(location = 1 + (AOV & 1) + ((AOV >> 1) & 1)) out vec4 o_normal;
#endif
layout(depth_less) out float gl_FragDepth; // reverse-Z: the proxy lies in front of the surface

void main() {
  Ray ray = pixel_ray(gl_FragCoord.xy);
  Particle particle = unpack(v_payload);
  Interval hit;
  if (!intersect(ray, particle, hit)) discard;

  // The entry, or the inner wall where the entry lies behind the eye or before the near plane.
  float near = frame.sample_near_far.z;
  bool inside = cull == 1 || inner_end(hit, false) || !(hit.t_in > 0.0 && hit.t_in >= near);
  if (inside && (cull == 2 || inner_end(hit, true))) discard;
  float t = inside ? hit.t_out : hit.t_in;
  vec3 outward = outward_normal(ray, particle, hit, inside);
  vec3 normal = inside ? -outward : outward;
  if (!(t > 0.0 && t >= near && t <= frame.sample_near_far.w)) discard;

  float depth = encode_depth(t);
  bool violation = show_depth_violation && depth > gl_FragCoord.z;
#ifdef HAS_ALARM
  violation = violation || type_alarm;
#endif
  gl_FragDepth = depth;

  Surface at = Surface(ray.origin + t * ray.direction, normal, -normalize(ray.direction));
  vec3 color = head_light_only ? v_color.rgb + max(-normal.z, 0.0) * v_lit : shade(at, v_color.rgb, batch.material);
  o_color = vec4(violation ? vec3(1.0, 0.0, 1.0) : color, blended && v_color.a >= 0.0 ? v_color.a : 1.0);
#if (AOV & 1) != 0
  o_depth = t;
#endif
#if (AOV & 2) != 0
  o_id = v_id;
#endif
#if (AOV & 4) != 0
  o_normal = vec4(normal.x * frame.world_from_view0.xyz + normal.y * frame.world_from_view1.xyz +
                      normal.z * frame.world_from_view2.xyz, 0.0);
#endif
}
