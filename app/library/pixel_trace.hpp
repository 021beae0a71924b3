// SPDX-License-Identifier: MIT
// One pixel followed through everything: every particle whose rectangle covers it from the data set's space to the window, and
// every fragment in the order of drawing with its depth test and its blending. Computed in double by the reference, not read
// back from a device, so that it can be checked by hand and is compared with the picture (tests/app/course_test.cpp).
// The sample is the pixel's center. What it can follow: opaque_impostors with any states, sorted_glyphs in an order or exact,
// shadows; what it cannot is refused (A060) or named in `notes`.
#pragma once

#include "app/library/frame_renderer.hpp"
#include "app/library/job.hpp"

#include <array>
#include <string>
#include <vector>

namespace mote::app {

// A particle's center through the spaces, and where its ray is inside.
struct TracedParticle {
  std::uint64_t id{};
  std::uint32_t row{};
  std::string file{}, type{};
  double radius{};              // of its bounding ball, world
  glm::dvec3 object{0}, world{0}, eye{0};
  glm::dvec4 clip{0};           // (2 f x / w, 2 f y / h, n, z); orthographic (2 f x / w, 2 f y / h, n / z, 1)
  glm::dvec3 ndc{0}, window{0}; // window: pixels and depth
  glm::dvec2 lo{0}, hi{0};      // the rectangle around its ball, pixels; infinite where the eye is too near
  bool hit{};
  double enters{}, leaves{};    // depths along the view axis, if hit
};

struct TracedFragment {
  std::size_t particle{}; // of the pass's
  bool exit{};            // the far side
  double z{};             // along the view axis
  double depth{};         // n / z
  float depth32{};        // the same in float32, as a shader has it
  glm::dvec3 normal{0};   // world, turned to the eye
  glm::dvec3 color{0};    // lit, scene-linear
  double alpha{};
  double there{};         // what the depth test compares z with; inf: nothing is there
  bool passes{};
  glm::dvec4 before{0}, after{0}; // the pixel's color, straight alpha
};

struct TracedPass {
  std::string name{}, kind{};
  std::string states{}; // in words
  std::vector<TracedParticle> particles{};
  std::vector<TracedFragment> fragments{}; // in the order of drawing
  std::string blending{};                  // the formula
  glm::dvec4 color{0};                     // after the pass
};

struct PixelTrace {
  std::uint32_t x{}, y{};
  Size2d size{};
  glm::dvec3 ray_origin{0}, ray_direction{0}; // eye space
  std::vector<TracedPass> passes{};
  glm::dvec4 linear{0};                  // scene-linear, straight alpha
  std::array<std::uint8_t, 4> display{}; // by the color config
  std::string display_name{};
  std::vector<std::string> notes{};
};

// Throws Failure A060, R00x, C00x.
PixelTrace trace_pixel(const Job& job, const ReadyGraph& graph, std::uint32_t x, std::uint32_t y, const ColorConfig& config, const DisplayOptions& display);

} // namespace mote::app
