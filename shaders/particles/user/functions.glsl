// SPDX-License-Identifier: MIT
// A user's type.glsl with what it builds on. Made for each type (passes/particles/user_type.cpp):
//   "user_shape.glsl"   struct Shape { real <attributes>; };  Shape shape_from(real3 lengths, real2 numbers)
//   "user_type.glsl"    the user's text, which gives
//     real3 bound(Shape s)               half extents of a box around the particle, along its axes
//     bool hit(Shape s, real3 o, real3 d, out real t_in, out real t_out)   first entry and last exit of the line o + t d; o is its
//                                        point nearest to the center, d of any length
//     real3 surface(Shape s, real3 p)    outward direction at a point of the surface, of any length
//     real inside(Shape s, real3 p)      below 0 inside, above 0 outside, continuous: the check of the other three
// all in the particle's own axes with its center as the origin.
#ifndef MOTE_USER_FUNCTIONS_GLSL
#define MOTE_USER_FUNCTIONS_GLSL
#include "particles/user/real.glsl"
#include "user_shape.glsl"
real3 bound(Shape s);
bool hit(Shape s, real3 o, real3 d, out real t_in, out real t_out);
real3 surface(Shape s, real3 p);
real inside(Shape s, real3 p);
#include "user_type.glsl"
#endif
