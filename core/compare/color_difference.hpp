// SPDX-License-Identifier: MIT
// Color arithmetic for comparisons: the sRGB curve, CIE L*a*b* (D65) and the CIEDE2000 difference.
// Used by core/compare only; pictures are drawn with OpenColorIO, never with this.
#pragma once

#include <glm/glm.hpp>

namespace mote::compare {

// The piecewise sRGB curve (IEC 61966-2-1), per channel; inputs are clamped to [0, 1].
double srgb_encode(double linear);
double srgb_decode(double encoded);

// sRGB-encoded [0, 1] to CIE L*a*b* with the white point of sRGB (D65).
glm::dvec3 lab_from_srgb(const glm::dvec3& encoded);

// CIEDE2000 with kL = kC = kH = 1 (Sharma, Wu, Dalal 2005).
double ciede2000(const glm::dvec3& lab1, const glm::dvec3& lab2);

} // namespace mote::compare
