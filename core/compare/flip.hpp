// SPDX-License-Identifier: MIT
// FLIP: how strongly two pictures differ to an eye that flips between them, 0 to 1 a pixel. Colors are blurred as the eye does
// at 67 pixels a degree (0.7 m before a 0.7 m wide screen of 3840 pixels), compared with HyAB in a Hunt-adjusted L*a*b*, and
// weighted up at edges and points. Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild: FLIP: A Difference
// Evaluator for Alternating Images, PACMCGIT 3(2), 2020; written from the paper.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace mote::compare {

// Both: width * height linear Rec.709 values in [0, 1], row 0 on top.
std::vector<double> flip(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b, std::uint32_t width, std::uint32_t height);

} // namespace mote::compare
