// SPDX-License-Identifier: MIT
// Axes of a particle to 1e-11 and vectors in them, each number to its own rounding. An ellipsoid's normals err by the directions of its
// axes times the square of their ratio, so the 1e-7 that a matrix of floats has are too much. Numbers are split into a part
// on a grid so coarse that products and sums of three are exact in float32, and a small rest: no operation needs its own
// error. Used by oriented.glsl with FINE_AXES.
#ifndef MOTE_FINE_AXES_GLSL
#define MOTE_FINE_AXES_GLSL

// On the grid of 2^-11; |v| <= 1.
vec3 on_grid(vec3 v) {
  precise vec3 up = v + 6144.0;
  precise vec3 back = up - 6144.0;
  return back;
}
// On the grid of 2^-11 of the largest number's power of two.
vec3 on_own_grid(vec3 v) {
  float most = max(abs(v.x), max(abs(v.y), abs(v.z)));
  float lift = 6144.0 * uintBitsToFloat(floatBitsToUint(most) & 0x7F800000u);
  precise vec3 up = v + lift;
  precise vec3 back = up - lift;
  return back;
}

// The first two columns of a quaternion's matrix, as sums of two floats. It counts by its direction.
struct FineColumns {
  vec3 x, x_rest, y, y_rest;
};
FineColumns fine_columns(vec4 quaternion) {
  float size = dot(quaternion, quaternion);
  vec4 q = abs(size - 1.0) < 1e-5 ? quaternion : quaternion * inversesqrt(size);
  vec4 h = vec4(on_grid(q.xyz), on_grid(q.www).x);
  precise vec4 l = q - h;
  vec4 sum = q + h;
  float longer = (dot(h, h) - 1.0) + dot(l, sum); // |q|^2 - 1
  vec3 squares = h.xyz * h.xyz, square_rests = l.xyz * sum.xyz;
  vec3 products = h.yzx * h.zxy, product_rests = h.yzx * l.zxy + l.yzx * q.zxy; // yz, zx, xy
  vec3 turns = h.w * h.xyz, turn_rests = h.w * l.xyz + l.w * q.xyz;
  vec3 x = vec3(-squares.y - squares.z, products.z + turns.z, products.y - turns.y);
  vec3 y = vec3(products.z - turns.z, -squares.x - squares.z, products.x + turns.x);
  vec3 xl = vec3(-square_rests.y - square_rests.z, product_rests.z + turn_rests.z, product_rests.y - turn_rests.y);
  vec3 yl = vec3(product_rests.z - turn_rests.z, -square_rests.x - square_rests.z, product_rests.x + turn_rests.x);
  FineColumns c;
  two_sum(vec3(1.0, 0.0, 0.0) + 2.0 * x, 2.0 * (xl - longer * (x + xl)), c.x, c.x_rest);
  two_sum(vec3(0.0, 1.0, 0.0) + 2.0 * y, 2.0 * (yl - longer * (y + yl)), c.y, c.y_rest);
  return c;
}
// From a unit vector in floats to v + v_rest at length 1; right across it only.
vec3 fine_rest(vec3 v, vec3 v_rest, vec3 unit_) {
  float inverse = inversesqrt(dot(v, v)), nh = hi12(inverse), nl = inverse - nh;
  precise vec3 p = v * inverse, vh = hi12(v), vl = v - vh;
  precise vec3 e = ((vh * nh - p) + vh * nl + vl * nh) + vl * nl;
  return (p - unit_) + (e + inverse * v_rest);
}

// The columns of a rotation, each a part on the grid and a rest.
struct FineAxes {
  mat3 high, low;
};
// From the first two, which are at right angles and of length 1 to rounding, turned by a small rotation vector.
FineAxes fine_axes(vec3 x, vec3 y, vec3 turn) {
  vec3 xh = on_grid(x), yh = on_grid(y), z = cross(x, y);
  precise vec3 xl = x - xh, yl = y - yh;
  float xx = (dot(xh, xh) - 1.0) + dot(xl, x + xh), yy = (dot(yh, yh) - 1.0) + dot(yl, y + yh), xy = dot(xh, yh) + (dot(xl, y) + dot(xh, yl));
  xl += turn.z * y - turn.y * z - 0.5 * xx * x;
  yl += turn.x * z - (xy + turn.z) * x - 0.5 * yy * y;
  precise vec3 products = cross(xh, yh), zh = on_grid(products), rest = products - zh;
  return FineAxes(mat3(xh, yh, zh), mat3(xl, yl, rest + (cross(xh, yl) + cross(xl, y))));
}
// v + v_rest in these axes.
vec3 in_axes(vec3 v, vec3 v_rest, FineAxes axes) {
  vec3 high = on_own_grid(v);
  precise vec3 low = (v - high) + v_rest;
  return high * axes.high + (low * (axes.high + axes.low) + high * axes.low);
}

#endif
