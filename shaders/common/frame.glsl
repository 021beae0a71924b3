// SPDX-License-Identifier: MIT
// Group 0: what every particle shader of a frame shares. Mirrors passes/frame_uniform.hpp.
// View space: x right, y down, z forward; lengths in world units; pixels with row 0 on top.
#ifndef MOTE_FRAME_GLSL
#define MOTE_FRAME_GLSL

const int max_lights = 64;

struct Light {
  vec4 position;    // xyz: view-space position (w = 1), or the unit vector TO a light at infinity (w = 0)
  vec4 axis;        // xyz: unit direction of travel, view space (spot)
  vec4 strength;    // rgb: color * intensity
  vec4 attenuation; // 1 / (x + y d + z d^2); w unused
  vec4 cone;        // x: cosine of the outer angle, y: 1 / (cos inner - cos outer)
};

layout(std140, set = 0, binding = 0) uniform FrameBlock {
  vec4 viewport;          // width, height, focal (pixels; orthographic: pixels per world unit), 1 / focal to at most 12 bits
  vec4 sample_near_far;   // xy: sample offset - where the axis meets the picture (of a panel: the whole one); z: near cut; w: far cut (huge: none)
  vec4 depth_near;        // x: n of the depth encoding n / z; y: the rest of 1 / focal
  vec4 world_from_view0;  // columns of the rotation
  vec4 world_from_view1;
  vec4 world_from_view2;
  vec4 ambient;           // rgb: color * intensity
  Light lights[max_lights];
} frame;

// Specialization constants of every particle pipeline (passes/particles/pipelines.hpp).
layout(constant_id = 0) const bool orthographic = false;
layout(constant_id = 1) const int light_count = 1;
layout(constant_id = 2) const bool local_lights = false;  // any point or spot light
layout(constant_id = 3) const int specular_model = 0;     // 0 none, 1 Phong, 2 Blinn-Phong
layout(constant_id = 4) const bool per_particle_color = false;
layout(constant_id = 5) const bool show_depth_violation = false; // tests: alarm color where FC-29 fails
layout(constant_id = 6) const bool head_light_only = false; // one head light, no specular: terms are formed once a vertex
layout(constant_id = 7) const float proxy_slack = 0.0; // pixels by which proxies are larger than their particles on each side

struct Ray {
  vec3 origin;    // view space
  vec3 direction; // z = 1: the ray parameter is the depth along the view axis
#ifdef NEAR_EYE
  vec3 rest;      // what rounding took from the direction (orthographic: from the origin)
#endif
};

// The ray through a sample of the pixel whose integer position is floor(fragment). Half-integers have few bits, so
// the first product is exact and the direction is rounded once; near the eye the rest of that rounding comes along.
// `offset`: sample offset - where the axis meets the picture; `high` and `low`: the two parts of 1 / focal.
Ray ray_through(vec2 fragment, vec2 offset, float high, float low) {
  vec2 pixel = floor(fragment) + offset;
  precise vec2 large = pixel * high, small = pixel * low;
  precise vec2 p = large + small;
#ifdef NEAR_EYE
  precise vec2 rest = small - (p - large);
  return orthographic ? Ray(vec3(p, 0.0), vec3(0.0, 0.0, 1.0), vec3(rest, 0.0)) : Ray(vec3(0.0), vec3(p, 1.0), vec3(rest, 0.0));
#else
  return orthographic ? Ray(vec3(p, 0.0), vec3(0.0, 0.0, 1.0)) : Ray(vec3(0.0), vec3(p, 1.0));
#endif
}
Ray pixel_ray(vec2 fragment) { return ray_through(fragment, frame.sample_near_far.xy, frame.viewport.w, frame.depth_near.y); }

// Reverse-Z with infinite far: depth n / z, relative precision the same at every distance.
float encode_depth(float z) { return min(frame.depth_near.x / z, 1.0); }

#endif
