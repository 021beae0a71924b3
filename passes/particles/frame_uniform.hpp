// SPDX-License-Identifier: MIT
// The uniform block of a frame: view, ambient and lights, in view space and float. Mirrors
// shaders/common/frame.glsl. Everything is formed in double on the CPU and rounded once.
#pragma once

#include "core/scene/scene.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace mote::passes {

constexpr std::uint32_t max_lights = 64;

struct LightBlock {
  glm::vec4 position{0}, axis{0}, strength{0}, attenuation{1, 0, 0, 0}, cone{-3, 1, 0, 0};
};
struct FrameBlock {
  glm::vec4 viewport{0}, sample_near_far{0}, depth_near{0};
  std::array<glm::vec4, 3> world_from_view{};
  glm::vec4 ambient{0};
  std::array<LightBlock, max_lights> lights{};
};
static_assert(sizeof(LightBlock) == 80 && sizeof(FrameBlock) == 7 * 16 + 80 * max_lights, "std140, as in frame.glsl");

// Precondition: at most max_lights lights (the pass refuses more, P003).
FrameBlock frame_block(const Scene& scene, const View& view);

} // namespace mote::passes
