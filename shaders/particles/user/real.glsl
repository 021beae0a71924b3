// SPDX-License-Identifier: MIT
// The scalar of particle types from files: float, or double where REAL_DOUBLE is defined. What both need: + - * /, comparisons, sqrt,
// inversesqrt, abs, sign, min, max, clamp, mix, floor, fract, mod, dot, cross, length, normalize. GLSL has no double pow or sin.
#ifndef MOTE_REAL_GLSL
#define MOTE_REAL_GLSL
#ifdef REAL_DOUBLE
#define real double
#define real2 dvec2
#define real3 dvec3
#else
#define real float
#define real2 vec2
#define real3 vec3
#endif
#endif
