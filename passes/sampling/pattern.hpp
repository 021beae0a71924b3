// SPDX-License-Identifier: MIT
// Where in a pixel the samples of a drawing pass lie: pure. A pass draws its picture once for each
// offset and averages in scene-linear light, so all pixels share one pattern.
//
//   samples = { pattern = "jittered", n = 16 }     regular, random, jittered, poisson
//
// regular    centers of k x k cells                          n = k^2
// random     uniform, independent                            any n
// jittered   one uniform place in each of k x k cells        n = k^2   (Cook, ACM TOG 5(1), 1986)
// poisson    best candidates, distances around the edges     any n     (Mitchell, SIGGRAPH 1991)
//
// The same words always give the same offsets. Their errors on edges: docs/accuracy.md.
#pragma once

#include "render_graph/params.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mote::passes {

enum class SamplePattern : std::uint8_t { Regular, Random, Jittered, Poisson };
std::span<const std::string_view> sample_pattern_names();

constexpr std::uint32_t most_samples = 1024;

// In [0, 1)^2, the pixel's corner at (0, 0). Nothing for a number that the pattern cannot make. n = 1 is the pixel's
// center for every pattern.
std::optional<std::vector<glm::dvec2>> sample_offsets(SamplePattern pattern, std::uint32_t n);

// The parameter `samples` of a pass in declare(): the table above, or a number of jittered samples. Absent: one offset,
// the pixel's center. A number that the pattern cannot make is P007, located, with the nearest that it can.
std::vector<glm::dvec2> read_samples(rg::Params& params);

} // namespace mote::passes
