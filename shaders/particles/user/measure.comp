#version 460
// SPDX-License-Identifier: MIT
// What a type from files says of each particle: the box of bound(), which the chunk builder reads, and, for one of every
// `stride` particles, how often hit() gives NaN or does not agree with inside() on rays from all sides through the ball around
// that box, and whether inside() reaches beyond the box.
#extension GL_GOOGLE_include_directive : require
#include "particles/user/functions.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Records { vec4 records[]; }; // three a particle: oriented.glsl without the first
layout(std430, set = 0, binding = 1) writeonly buffer Found { vec4 found[]; };    // (half, rays), (NaN, disagreements, outside, 0)
layout(push_constant) uniform Block { uint count, stride, rays; } block;

const float golden = 0.6180339887;

// Unit vector k of a spiral over the sphere.
vec3 on_sphere(float k, float n) {
  float z = 1.0 - 2.0 * (k + 0.5) / n, turn = 6.2831853 * golden * k;
  return vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(turn), sin(turn)), z);
}

// A point before the first entry is outside, and so is one behind the last exit; where the surface is said to be, `inside` is
// much smaller than on both sides.
bool agrees_at(Shape s, real3 o, real3 d, real t, real before, real step_) {
  real there = abs(inside(s, o + t * d)), out_ = inside(s, o + (t + before * step_) * d), in_ = inside(s, o + (t - before * step_) * d);
  return out_ >= real(-1e-6) * step_ && there <= real(0.6) * max(abs(out_), abs(in_)) + real(1e-6) * step_;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= block.count) return;
  vec4 numbers = records[3u * i + 2u];
  Shape s = shape_from(real3(records[3u * i + 1u].xyz), real2(numbers.xy));
  vec3 half_ = vec3(bound(s));
  float ball = length(half_);
  bool sound = ball > 0.0 && ball < 1e30 && min(half_.x, min(half_.y, half_.z)) >= 0.0;
  int nan = 0, disagree = 0, outside = 0, rays = sound && i % block.stride == 0u ? int(block.rays) : 0;
  for (int k = 0; k < rays; ++k) {
    vec3 d = on_sphere(float(k), float(rays));
    vec3 across = on_sphere(fract(float(k) * 0.7548777) * float(rays), float(rays));
    across -= dot(across, d) * d;
    vec3 o = across * (0.98 * ball * sqrt(fract((float(k) + 0.5) * 0.5698403)) / max(length(across), 1e-6));
    real t_in = real(0.0), t_out = real(0.0);
    bool met = hit(s, real3(o), real3(d), t_in, t_out);
    bool is_nan = met && (isnan(float(t_in)) || isnan(float(t_out)));
    nan += is_nan ? 1 : 0;
    met = met && t_in <= t_out;
    bool differs = met && !(agrees_at(s, real3(o), real3(d), t_in, real(-1.0), real(1e-3 * ball)) && agrees_at(s, real3(o), real3(d), t_out, real(1.0), real(1e-3 * ball)));
    bool beyond = false;
    for (int j = 0; j < 16; ++j) {
      real t = real(ball * ((float(j) + 0.5) / 8.0 - 1.0));
      vec3 q = abs(o + float(t) * d);
      bool in_ = inside(s, real3(o) + t * real3(d)) < real(-1e-4 * ball);
      beyond = beyond || (in_ && any(greaterThan(q, half_ * 1.0001 + 1e-4 * ball)));
      differs = differs || (in_ && !is_nan && !(met && t >= t_in && t <= t_out));
    }
    disagree += differs ? 1 : 0;
    outside += beyond ? 1 : 0;
  }
  found[2u * i] = vec4(half_, float(rays));
  found[2u * i + 1u] = vec4(float(nan), float(disagree), float(outside), 0.0);
}
