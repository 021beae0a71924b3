#version 460
// SPDX-License-Identifier: MIT
// Phase `opaque` as far as one of its steps, for teaching (passes/particles/steps.hpp). Colors only; the depth is the
// proxy's wherever the step has none of its own. NAIVE_QUADRATIC: the type is a sphere, which the quadratic formula of the
// books can be shown with.
#extension GL_GOOGLE_include_directive : require
#include "particles/particle.glsl"
#include "common/shading.glsl"

layout(location = 0) flat in vec4 v_color;
layout(location = 1) flat in uint v_id;
layout(location = 2) flat in vec4 v_payload[payload_vec4s];
layout(location = 2 + payload_vec4s) flat in vec3 v_lit;

layout(location = 0) out vec4 o_color;
layout(depth_less) out float gl_FragDepth;

layout(constant_id = 27) const uint step_shown = 0u; // order of passes::Step
const uint step_proxy = 0u, step_discard = 1u, step_shade = 2u, step_quadratic = 4u, step_points = 5u;

struct Found {
  bool hit;
  float t;
  vec3 normal; // turned to the eye
};

// What the whole thing finds (opaque.frag).
Found surface(Ray ray, Particle particle) {
  Interval hit;
  bool met = intersect(ray, particle, hit);
  float near = frame.sample_near_far.z;
  bool inside = cull == 1 || !(hit.t_in > 0.0 && hit.t_in >= near);
  float t = inside ? hit.t_out : hit.t_in;
  vec3 outward = outward_normal(ray, particle, hit, inside);
  bool visible = met && !(cull == 2 && inside) && t > 0.0 && t >= near && t <= frame.sample_near_far.w;
  return Found(visible, t, inside ? -outward : outward);
}

#ifdef NAIVE_QUADRATIC
// a t^2 + b t + c = 0 as it stands in every book, and the normal from the hit: what the shape of the formula loses is seen.
Found by_the_books(Ray ray, Particle particle) {
  vec3 f = ray.origin - particle.center, d = ray.direction;
  float a = dot(d, d), b = 2.0 * dot(d, f), c = dot(f, f) - particle.radius * particle.radius;
  float discriminant = b * b - 4.0 * a * c;
  float t = (-b - sqrt(max(discriminant, 0.0))) / (2.0 * a);
  return Found(discriminant >= 0.0 && t > 0.0, t, normalize(f + t * d));
}
#endif

void main() {
  Ray ray = pixel_ray(gl_FragCoord.xy);
  Particle particle = unpack(v_payload);
  float alpha = blended ? v_color.a : 1.0;
  if (step_shown == step_proxy || step_shown == step_discard) { // the place in the rectangle, 0..1 to the right and down
    Proxy bounds = proxy(particle);
    vec2 at = orthographic ? ray.origin.xy : ray.direction.xy;
    if (step_shown == step_discard && !surface(ray, particle).hit) discard;
    o_color = vec4(clamp((at - bounds.lo) / max(bounds.hi - bounds.lo, 1e-30), 0.0, 1.0), 0.0, alpha);
    gl_FragDepth = gl_FragCoord.z;
    return;
  }
  if (step_shown == step_points) {
    o_color = vec4(head_light_only ? v_color.rgb + v_lit : v_color.rgb, alpha);
    gl_FragDepth = gl_FragCoord.z;
    return;
  }
#ifdef NAIVE_QUADRATIC
  Found found = step_shown == step_quadratic ? by_the_books(ray, particle) : surface(ray, particle);
#else
  Found found = surface(ray, particle);
#endif
  if (!found.hit) discard;
  vec3 normal = found.normal;
  Surface at = Surface(ray.origin + found.t * ray.direction, normal, -normalize(ray.direction));
  vec3 color = head_light_only ? v_color.rgb + max(-normal.z, 0.0) * v_lit : shade(at, v_color.rgb, batch.material);
  o_color = vec4(color, alpha);
  gl_FragDepth = step_shown == step_shade ? gl_FragCoord.z : min(encode_depth(found.t), gl_FragCoord.z);
}
