// SPDX-License-Identifier: MIT
// What a map of casters holds of a particle that an affine placement makes an ellipsoid: the payload of type `ellipsoid`, as
// oriented.glsl unpacks it, so that shadow rays know no placement. Included with AFFINE by sphere and ellipsoid, which give
// pack_caster(); phase `shadow` calls that (HAS_CASTER). passes/shadow_map.cpp says the other type with it (caster_type()).
#ifndef MOTE_AFFINE_CASTER_GLSL
#define MOTE_AFFINE_CASTER_GLSL

#define HAS_CASTER
#undef CASTER_VEC4S
#define CASTER_VEC4S 4

// x and y: unit, at right angles; the third axis is their cross product. lengths: of the half axes. View space. Directions in
// floats are enough here: their rounding moves a surface by no more than that of a center as far away as the particle is long.
void pack_ellipsoid(vec3 center, vec3 x, vec3 y, vec3 lengths, out vec4 caster[CASTER_VEC4S]) {
  caster[0] = vec4(center, max(lengths.x, max(lengths.y, lengths.z)));
  caster[1] = vec4(x, lengths.x);
  caster[2] = vec4(y, lengths.y);
  caster[3] = vec4(lengths.z, 0.0, 0.0, 0.0);
}

// Turns two vectors in their plane until they are at right angles (one-sided Jacobi, Hestenes 1958); none is longer than 1.
void orthogonalize(inout vec3 a, inout vec3 b) {
  float d = dot(b, b) - dot(a, a), c = 2.0 * dot(a, b);
  float t = (d >= 0.0 ? c : -c) / max(abs(d) + length(vec2(d, c)), 1e-37);
  float cosine = inversesqrt(1.0 + t * t), sine = t * cosine;
  vec3 old = a;
  a = cosine * old - sine * b;
  b = sine * old + cosine * b;
}
// The same from any half axes, which an affine map no longer leaves at right angles. Of the directions the two longest count, as
// the third has the roundings of both. Surfaces come within 5e-7 of the longest half axis, whatever the proportions (measured).
void pack_sheared_ellipsoid(vec3 center, mat3 half_axes, out vec4 caster[CASTER_VEC4S]) {
  float size = max(length(half_axes[0]), max(length(half_axes[1]), length(half_axes[2])));
  vec3 x = half_axes[0] / size, y = half_axes[1] / size, z = half_axes[2] / size;
  int sweep = 0;
  do {
    orthogonalize(x, y);
    orthogonalize(x, z);
    orthogonalize(y, z);
  } while (++sweep < 5);
  float xx = dot(x, x), yy = dot(y, y), zz = dot(z, z);
  bool x_least = xx <= yy && xx <= zz, y_least = !x_least && yy <= zz;
  vec3 first = x_least ? y : y_least ? z : x, second = x_least ? z : y_least ? x : y, lengths = sqrt(vec3(xx, yy, zz));
  lengths = size * (x_least ? lengths.yzx : y_least ? lengths.zxy : lengths);
  if (lengths.x < lengths.y) {
    vec3 shorter = first;
    first = second, second = shorter;
    lengths = lengths.yxz;
  }
  first = normalize(first);
  pack_ellipsoid(center, first, normalize(second - dot(first, second) * first), lengths, caster);
}

#endif
