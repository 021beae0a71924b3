// SPDX-License-Identifier: MIT
// Particle type `cylinder`: a cylinder or truncated cone, flat or open ends.
#define MAY_BE_OPEN true
#include "particles/frustum.glsl"
