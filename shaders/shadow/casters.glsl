// SPDX-License-Identifier: MIT
// Shadow rays against spheres, for the masks (through the particle type) and for kernels that ask maps of spheres themselves.
#ifndef MOTE_CASTERS_GLSL
#define MOTE_CASTERS_GLSL

// Any surface of the sphere (center, radius) on origin + t direction with 0 < t < t_max; direction is a unit vector.
// The ray is moved to the point nearest to the center first, so that nothing of the size of the distance is squared.
bool sphere_blocks(vec3 origin, vec3 direction, float t_max, vec4 caster) {
  vec3 f = origin - caster.xyz;
  float middle = -dot(f, direction);
  vec3 l = f + middle * direction;
  float distance = length(l);
  float d2 = (caster.w - distance) * (caster.w + distance);
  float h = sqrt(max(d2, 0.0));
  float t_in = middle - h, t_out = middle + h;
  return d2 >= 0.0 && ((t_in > 0.0 && t_in < t_max) || (t_out > 0.0 && t_out < t_max));
}

#endif
