// SPDX-License-Identifier: MIT
// Particle type `cone`: a cone or truncated cone, closed.
#define MAY_BE_OPEN false
#include "particles/frustum.glsl"
