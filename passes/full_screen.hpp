// SPDX-License-Identifier: MIT
// Pipelines that draw one triangle over the whole picture with a shipped fragment shader. Passes that
// resolve, mask or accumulate use them; each keeps its own pipelines.
#pragma once

#include "core/gpu/gpu.hpp"

#include <span>
#include <string_view>

namespace mote::passes {

struct FullScreen {
  std::string_view label{};
  const gpu::PipelineLayout* layout{};
  std::string_view fragment{}; // key of a shipped shader (shaders/embedded.hpp)
  std::span<const gpu::SpecializationConstant> constants{};
  std::span<const gpu::ColorTargetState> targets{};
};
// Drawn with draw(3). Throws std::logic_error for a shader that is not shipped.
gpu::RenderPipeline full_screen_pipeline(gpu::Device& device, const FullScreen& descriptor);

} // namespace mote::passes
