// SPDX-License-Identifier: MIT
// Random stacks of transparent layers blended by methods of the literature, on the processor: what the methods that mote does
// not draw with would err. Method book, section 8.1. Pure.
#pragma once

#include "core/chart/chart.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace mote::app {

struct Layer1 {
  glm::dvec3 color{};
  double alpha{}, z{};
};
using Stack = std::vector<Layer1>; // in no order

glm::dvec3 blend_exact(const Stack& stack);                     // by distance, over white, in double
glm::dvec3 blend_unsorted(const Stack& stack);                  // as they come
glm::dvec3 blend_weighted(const Stack& stack);                  // McGuire and Bavoil 2013, weights of their equation 7
glm::dvec3 blend_stochastic(const Stack& stack, int samples, std::uint64_t seed); // Enderton et al. 2010
glm::dvec3 blend_first(const Stack& stack, std::size_t k, bool tail); // nearest k layers, the rest dropped or averaged
glm::dvec3 blend_adaptive(const Stack& stack, std::size_t k);   // k nodes, the last two merged (Salvi and Vaidyanathan 2014)
glm::dvec3 blend_moments(const Stack& stack);                   // four power moments of absorbance (Muenstermann et al. 2018); z in 5..50
glm::dvec3 blend_8bit(const Stack& stack, bool back_to_front);  // by distance, rounded to 8 bits after each layer

chart::Panel stack_panel();

} // namespace mote::app
